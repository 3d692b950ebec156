#include "compile/generate_emitters.h"

#include <cmath>

#include "compile/generate.h"
#include "compile/glsl_text.h"
#include "compile/pack.h"
#include "scene/selection.h"

namespace shoal {

namespace {

// 4-vectors of an emitter:
//   0  xyz the lattice point nearest to its middle, m; w 1 - cos(spread)
//   1  xyz the middle from there, m;                   w inherit
//   2  xyz direction, unit;                            w radius, m
//   3  x least, y most speed, m/s; z hollow
//   4  xyz a line's way, or half a box's size, m
//   5  xyz velocity of the middle, m/s
//   6  xyz spin, rad/s
//   7  rotation, xyzw
constexpr size_t slots = 8;

using From = Emitter::From;
using Along = Emitter::Along;

// The part of a shape's size that is not its radius.
glm::dvec3 extentOf(const Emitter& emitter) {
    if (emitter.from == From::line) return emitter.lineTo - emitter.lineFrom;
    if (emitter.from == From::box) return 0.5 * (emitter.box.high - emitter.box.low);
    return glm::dvec3(0);
}

glm::vec4 four(const glm::dvec3& v, double w = 0) {
    return {glm::vec3(v), float(w)};
}

// Triangles by three texels: a corner from the middle's lattice point and the area up to this triangle's end
// as a share of all; the two edges from that corner.
size_t addSurface(const Scene& scene, const Emitter& emitter, std::vector<glm::vec4>& samples, int& count) {
    const Mesh& mesh = scene.models[size_t(emitter.model)].mesh;
    const glm::dvec3 origin = latticePoint(placeOf(emitter, scene.models).middle);
    const size_t base = samples.size();
    const double all = selectedArea(mesh, emitter.select);
    double area = 0;
    count = 0;
    for (const int t : select(mesh, emitter.select).triangles) {
        const auto corner = [&](int i) { return mesh.positions[size_t(mesh.triangles[size_t(t)][i])]; };
        const glm::dvec3 first = corner(1) - corner(0), second = corner(2) - corner(0);
        const double own = 0.5 * glm::length(glm::cross(first, second));
        if (!(own > 0)) continue;
        area += own;
        samples.push_back(four(corner(0) - origin, area / all));
        samples.push_back(four(first));
        samples.push_back(four(second));
        ++count;
    }
    samples[samples.size() - 3].w = 1;
    return base;
}

// The text of one emitter's place: sets `place` (from the lattice point `lattice`, m) and `outward`.
class EmitterText {
  public:
    EmitterText(const Scene& scene, const Emitter& emitter, size_t index, const BufferLayout& layout,
                std::vector<glm::vec4>& samples)
        : scene_(&scene), emitter_(&emitter), index_(index), layout_(layout), samples_(&samples) {}

    std::string text() {
        std::string out = concat("    if (emitter == ", index_, ") {\n");
        out += emitter_->from == From::death ? fromDeath() : fromPlace();
        const bool outward = emitter_->along == Along::outward;
        out += concat("        vec3 axis = ", outward ? "outward" : turned(slot(2) + ".xyz"), ";\n",
                      "        start.velocity = coneDirection(axis, ", slot(0),
                      ".w, drawn(seed, bornDirection), ", "drawn(seed, bornDirection + 1u)) * mix(", slot(3),
                      ".x, ", slot(3), ".y, drawn(seed, bornSpeed)) + carried * ", slot(1), ".w;\n");
        return out + "    }\n";
    }

  private:
    std::string slot(size_t i) const { return concat("emitterParameters[", slots * index_ + i, "]"); }
    std::string turned(const std::string& v) const {
        return emitter_->path ? concat("turned(", slot(7), ", ", v, ")") : v;
    }

    // A shape without a middle has no outward direction: any direction is as good.
    const char* anyOutward() const {
        return emitter_->along == Along::outward ? "        vec3 outward = anyDirection(drawn(seed, "
                                                   "bornOutward), drawn(seed, bornOutward + 1u));\n"
                                                 : "";
    }

    std::string fromPlace() {
        std::string out = offsetText();
        out += "        vec3 carried = vec3(0.0);\n";
        if (emitter_->path)
            out += concat("        carried = ", slot(5), ".xyz + cross(", slot(6), ".xyz, offset);\n",
                          "        offset += carried * time;\n");
        return out + concat("        start.lattice = ", slot(0), ".xyz;\n        start.place = ", slot(1),
                            ".xyz + offset;\n");
    }

    std::string offsetText() {
        const std::string random =
            "        vec3 dice = vec3(drawn(seed, bornPlace), drawn(seed, bornPlace + 1u), "
            "drawn(seed, bornPlace + 2u));\n";
        switch (emitter_->from) {
        case From::line:
            return random + concat("        vec3 offset = ", turned(slot(4) + ".xyz"), " * dice.x;\n");
        case From::box:
            return random + concat("        vec3 offset = ",
                                   turned(concat("(", slot(4), ".xyz * (2.0 * dice - 1.0))")), ";\n");
        case From::disc:
            return random +
                   concat("        vec3 a, b;\n        frameOf(", turned(slot(2) + ".xyz"),
                          ", a, b);\n        float angle = 6.2831853 * dice.y;\n        vec3 outward = a * "
                          "cos(angle) + b * sin(angle);\n        vec3 offset = outward * discRadius(",
                          slot(2), ".w, ", slot(3), ".z, dice.x);\n");
        case From::sphere:
            return random + concat(
                                "        vec3 outward = anyDirection(dice.y, dice.z);\n        vec3 offset = "
                                "outward * ballRadius(",
                                slot(2), ".w, ", slot(3), ".z, dice.x);\n");
        case From::surface:
            return random + surfaceText();
        case From::point:
        case From::death:
            break;
        }
        return concat(anyOutward(), "        vec3 offset = vec3(0.0);\n");
    }

    std::string surfaceText() {
        int count = 0;
        const size_t base = addSurface(*scene_, *emitter_, *samples_, count);
        // the place is from the lattice point: what slot 1 adds is taken off
        return concat(
            "        int triangle = ", base, " + 3 * triangleAt(", base, ", ", count, ", dice.x);\n",
            "        vec3 edge = sampleAt(triangle + 1).xyz, otherEdge = sampleAt(triangle + 2).xyz;\n",
            "        float root = sqrt(dice.y);\n",
            "        vec3 outward = normalize(cross(edge, otherEdge));\n",
            "        vec3 offset = (sampleAt(triangle).xyz - ", slot(1),
            ".xyz) + edge * (root * (1.0 - dice.z)) + otherEdge * (root * dice.z);\n");
    }

    // Where its first vertex was at that moment.
    std::string fromDeath() {
        const int elements = layout_.stateElements(), positions = layout_.positionElements();
        const std::string states = concat("sourceStates", index_), records = concat("sourceRecords", index_);
        // back from the frame's end to its death, as gravity had it
        return concat("        int first = firstElement(source.molecule, ", elements, ");\n",
                      "        vec3 carried = element(", states, ", first, ", positions,
                      ").xyz - gravity * source.since;\n", "        start.lattice = valueOf(", records,
                      ", source.molecule).xyz;\n", "        start.place = element(", states,
                      ", first, 0).xyz - (carried + gravity * (0.5 * source.since)) * source.since;\n",
                      anyOutward());
    }

    const Scene* scene_;
    const Emitter* emitter_;
    size_t index_;
    BufferLayout layout_;
    std::vector<glm::vec4>* samples_;
};

const char* rotationText(Placement::Turn turn) {
    switch (turn) {
    case Placement::Turn::any:
        return "    return anyRotation(drawn(seed, bornTurn), drawn(seed, bornTurn + 1u),\n"
               "                       drawn(seed, bornTurn + 2u));\n";
    case Placement::Turn::yaw:
        return "    float angle = 3.14159265 * drawn(seed, bornTurn);\n"
               "    return vec4(0.0, sin(angle), 0.0, cos(angle));\n";
    case Placement::Turn::none:
        break;
    }
    return "    return vec4(0.0, 0.0, 0.0, 1.0);\n";
}

}  // namespace

std::string generateEmitters(const Scene& scene, const Lifecycle& life,
                             const std::vector<BufferLayout>& layouts, std::vector<glm::vec4>& samples) {
    std::string body, sources, lengths;
    for (size_t i = 0; i < life.emitters.size(); ++i) {
        const Emitter& emitter = life.emitters[i];
        body += EmitterText(scene, emitter, i, layouts[i], samples).text();
        if (emitter.from != From::death) continue;
        sources += concat("uniform VALUES sourceStates", i, ";\nuniform VALUES sourceRecords", i, ";\n");
        const BufferLayout& layout = layouts[i];
        const int life4 = layout.lifeApart() ? layout.stateElements() - 1 : layout.positionElements() - 1;
        lengths +=
            concat("    if (emitter == ", i, ") {\n        seed = valueOf(sourceRecords", i,
                   ", molecule).w;\n        since = element(sourceStates", i, ", firstElement(molecule, ",
                   layout.stateElements(), "), ", life4, ").", layout.lifeApart() ? "x" : "w", ";\n    }\n");
    }
    return concat(
        "uniform vec4 emitterParameters[", slots * life.emitters.size(), "];\n", sources,
        "\n// Of what died: its record's w, and how long before the frame's end, s.\n"
        "void readDeath(int emitter, int molecule, out float seed, out float since)\n{\n    seed = 0.0;\n    "
        "since "
        "= 0.0;\n",
        lengths,
        "}\n\nvoid emitFrom(int emitter, uint seed, float time, Source source, out Start start)\n{\n",
        "    start = Start(vec3(0.0), vec3(0.0), vec3(0.0));\n", body, "}\n\nvec4 newbornRotation()\n{\n",
        rotationText(life.turn), "}\n");
}

std::vector<glm::dvec3> emitterMiddles(const Scene& scene, const Lifecycle& life) {
    std::vector<glm::dvec3> out;
    for (const Emitter& emitter : life.emitters)
        out.push_back(placeOf(emitter, scene.models).middle);
    return out;
}

std::vector<glm::vec4> emitterParameters(const Lifecycle& life, const std::vector<glm::dvec3>& middles,
                                         double time, double duration) {
    std::vector<glm::vec4> out;
    for (size_t i = 0; i < life.emitters.size(); ++i) {
        const Emitter& emitter = life.emitters[i];
        glm::dvec3 middle = middles[i];
        Motion motion;
        glm::dquat rotation(1, 0, 0, 0);
        if (emitter.path) {
            const Pose from = poseAt(*emitter.path, time), to = poseAt(*emitter.path, time + duration);
            motion = motionBetween(from, to, duration);
            const Pose half = poseAt(*emitter.path, time + 0.5 * duration);
            rotation = half.rotation;
            const glm::dvec3 arm = rotation * middle;
            middle = half.position + arm;
            motion.velocity += glm::cross(motion.spin, arm);
        }
        const glm::dvec3 lattice = latticePoint(middle);
        const double half = std::sin(0.5 * emitter.spread);
        out.push_back(four(lattice, 2 * half * half));
        out.push_back(four(middle - lattice, emitter.inherit));
        out.push_back(four(emitter.direction, emitter.radius));
        out.push_back(glm::vec4(float(emitter.speed.x), float(emitter.speed.y), float(emitter.hollow), 0));
        out.push_back(four(extentOf(emitter)));
        out.push_back(four(motion.velocity));
        out.push_back(four(motion.spin));
        out.push_back(glm::vec4(glm::dvec4(rotation.x, rotation.y, rotation.z, rotation.w)));
    }
    return out;
}

bool sameText(const Emitter& a, const Emitter& b) {
    return a.from == b.from && a.along == b.along && a.model == b.model && a.group == b.group &&
           a.path.has_value() == b.path.has_value() && (a.from != From::surface || a.select == b.select) &&
           a.bursts.size() == b.bursts.size();
}

}  // namespace shoal
