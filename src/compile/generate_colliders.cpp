// A scene with a single plane or height field that stands still asks for it at the end of every substep. Any
// other has contact with all at once (shaders/step/joint_contact.glsl).
#include <algorithm>
#include <map>
#include <tuple>

#include "compile/call_writer.h"
#include "compile/collider_table.h"
#include "compile/generate.h"
#include "compile/pack.h"
#include "scene/known_colliders.h"

namespace shoal {

namespace {

bool isSwept(const Collider& collider) {
    return reachOf(*collider.shape).has_value();
}

// Holds the GLSL of a collider: statements before, its surface, its material and its velocity.
struct Text {
    std::string before, surface, material, velocity;
    bool swept = false;
    std::string cell = {};  // of a distance field, m: a way shorter than this passes through nothing
};

class ColliderWriter {
  public:
    ColliderWriter(std::vector<glm::vec4>& samples, const glm::dvec3& near)
        : samples_(&samples), near_(near) {}

    GeneratedColliders result;

    std::string slot(const glm::dvec3& v, double w = 0) {
        result.parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
        return concat("colliderParameters[", result.parameters.size() - 1, "]");
    }

    Text text(const Collider& collider, size_t index) {
        Text out;
        out.swept = isSwept(collider);
        out.velocity = "vec3(0.0)";
        result.materials[index] = result.parameters.size();
        out.material = slot({collider.restitution, collider.friction, collider.thickness});
        GlslCall call = callNear(collider);
        CallFrame frame{.position = "c.position"};
        if (collider.path) place(collider, index, call.origin(), frame, out);
        writeSurface(call, std::move(frame), out);
        if (collider.path && collider.path->turns())
            out.surface = concat("turnedSurface(turn", index, ", ", out.surface, ")");
        return out;
    }

  private:
    // Of a plane that stands still far from its point, the point next to `near_` stands for it: the normal is
    // a float, which leads astray over a long way.
    GlslCall callNear(const Collider& collider) const {
        constexpr double far = 1024;  // m
        const PlaneCollider* plane = kindOf<PlaneCollider>(*collider.shape);
        if (!plane || collider.path || glm::distance(plane->point, near_) <= far)
            return callOf(*collider.shape);
        const glm::dvec3 normal = glm::normalize(plane->normal);
        return PlaneCollider{near_ - normal * glm::dot(near_ - plane->point, normal), plane->normal}.call();
    }

    // Into the frame that moves. `own`: a point of the shape's own frame that is on it or near it.
    void place(const Collider& collider, size_t index, const glm::dvec3& own, CallFrame& frame, Text& out) {
        const bool turns = collider.path->turns();
        ColliderPath path = *collider.path;
        if (!turns) {
            // A shape far from the origin of its own frame gets a frame with an origin near it.
            const glm::dvec3 size = glm::abs(own);
            constexpr double near = 32;  // m
            if (std::max({size.x, size.y, size.z}) > near)
                frame.origin = glm::dvec3(glm::vec3(latticePoint(own)));
            for (ColliderPath::Keyframe& keyframe : path.keyframes)
                keyframe.pose.position += frame.origin;
        }
        const double reach = out.swept ? collider.thickness + *reachOf(*collider.shape) : 0;
        result.moving.push_back({std::move(path), result.parameters.size(), turns, out.swept, reach});
        const std::string lattice = slot({}), position = slot({}), rate = slot({});
        out.before = concat("    vec3 arm", index, " = ((anchor - ", lattice, ".xyz) - ", position,
                            ".xyz) + (c.position - ", rate, ".xyz * time);\n");
        out.velocity = rate + ".xyz";
        frame.anchor = "vec3(0.0)", frame.position = concat("arm", index);
        if (!turns) return;
        const std::string from = slot({}), to = slot({}), spin = slot({});
        out.before +=
            concat("    vec4 turn", index, " = turnAt(", from, ", ", to, ", time * ", spin,
                   ".w);\n    vec3 local", index, " = turnedBack(turn", index, ", arm", index, ");\n");
        out.velocity += concat(" + cross(", spin, ".xyz, arm", index, ")");
        frame.position = concat("local", index);
    }

    void writeSurface(GlslCall& call, CallFrame frame, Text& out) {
        const SplitPoint split = splitPoint(call.origin() - frame.origin);
        if (split.isFar()) {
            frame.anchor = concat("(", frame.anchor, " - ", slot(split.lattice), ".xyz)");
            frame.origin += split.lattice;
        }
        if (call.rotation() == glm::dquat(1, 0, 0, 0)) call.turned({});
        CallWriter writer("colliderParameters[#]", result.parameters.size(), samples_, std::move(frame));
        out.surface = writer.text(call, false);
        out.cell = writer.cell;
        result.parameters.insert(result.parameters.end(), writer.parameters.begin(), writer.parameters.end());
    }

    std::vector<glm::vec4>* samples_;
    glm::dvec3 near_;
};

std::string truth(const char* name, bool value) {
    return concat("const bool ", name, value ? " = true;\n" : " = false;\n");
}

std::string sourceOfOne(const Text& text) {
    return concat(
        "// xyz unit normal, w m from the surface, less its thickness; negative inside.\n",
        "vec4 surfaceAt(vec3 anchor, vec3 position)\n{\n    Contact c = Contact(position, vec3(0.0));\n",
        "    vec4 surface = ", text.surface, ";\n    return vec4(surface.xyz, surface.w - max(",
        text.material,
        ".z, contactRadius));\n}\n\n// surface: surfaceAt the position.\nContact answerTo(vec4 surface, vec3 "
        "position, vec3 ",
        "velocity, Drift drift)\n{\n    struckLast = vec4(surface.xyz, ", "surface.w < 0.0 ? ", text.material,
        ".y : -1.0);\n    struckVelocity = vec3(0.0);\n    return ",
        "answer(false, position, velocity, surface.w, surface.xyz, ", text.material, ".x, ", text.material,
        ".y, drift);\n}\n\nContact collideAll(vec3 anchor, vec3 position, vec3 velocity, "
        "Drift ",
        "drift)\n{\n    return answerTo(surfaceAt(anchor, position), position, velocity, "
        "drift);\n}\n\n",
        "float clearance(vec3 anchor, vec3 position, float time)\n{\n    return surfaceAt(anchor, "
        "position).w;\n}\n\nvec4 footing(vec3 anchor, vec3 position, float time)\n{\n    vec4 surface = "
        "surfaceAt(anchor, position);\n    return vec4(surface.xyz, abs(surface.w) < restingSlack ? ",
        text.material, ".y : -1.0);\n}\n\n#include \"step/one_contact.glsl\"\n");
}

class Joint {
  public:
    Joint(const std::vector<Collider>& colliders, std::vector<glm::vec4>& samples, const glm::dvec3& near)
        : colliders_(&colliders), samples_(&samples), writer_(samples, near), table_(colliders) {
        writer_.result.materials.resize(colliders.size());
    }

    GeneratedColliders generate() {
        size_t slots = 0;
        for (const Collider& collider : *colliders_)
            slots += slotsOf(collider);
        for (size_t i = 0; i < colliders_->size(); ++i) {
            const Collider& collider = (*colliders_)[i];
            swept_ = swept_ || isSwept(collider);
            if (slots > maxParameters && ColliderTable::holds(collider)) {
                writer_.result.materials[i] = tabledMaterial(collider);
                table_.add(collider, i, writer_.result.materials[i]);
            } else {
                write(writer_.text(collider, i), i);
            }
        }
        const ColliderTable::Loops loops = table_.write(*samples_);
        writer_.result.turns = table_.turns();
        clearances_ += loops.clearances;
        survey_ += loops.survey;
        nearest_ += loops.nearest;
        gather_ = loops.gather;
        std::string fastest = "0.0";
        if (swept_ && !writer_.result.moving.empty()) {
            writer_.result.fastestSlot = writer_.result.parameters.size();
            fastest = writer_.slot({}) + ".x";
        }
        GeneratedColliders out = std::move(writer_.result);
        out.source = source(out, fastest);
        return out;
    }

  private:
    // As many uniforms as a collider takes at most.
    static size_t slotsOf(const Collider& collider) {
        const size_t lattice = splitPoint(callOf(*collider.shape).origin()).isFar() ? 1 : 0;
        return 4 + lattice + (collider.path ? (collider.path->turns() ? 6 : 3) : 0);
    }

    // Colliders of the same surface share the uniform of their material, since they share it for every group.
    size_t tabledMaterial(const Collider& collider) {
        const auto key = std::make_tuple(collider.surface, collider.restitution, collider.friction);
        const auto [found, isNew] = materials_.try_emplace(key, writer_.result.parameters.size());
        if (isNew) writer_.slot({collider.restitution, collider.friction, 0});
        return found->second;
    }

    void write(const Text& t, size_t number) {
        const std::string head = concat(t.before, "    surface = ", t.surface, ";\n");
        const char *part = t.swept ? "least.y" : "least.x", *slower = t.cell.empty() ? "" : "slower";
        clearances_ += concat(head, "    ", part, " = min(", part, ", ", slower, "(surface.w - max(",
                              t.material, ".z, contactRadius)));\n");
        const auto touch = [&](const char* distance) {
            return concat("(s, Touch(surface.xyz, ", distance, "(surface.w - max(", t.material,
                          ".z, contactRadius)), ", t.material, ".xy, ", t.velocity, ", ", number, "), ");
        };
        nearest_ += concat(head, nearest_.empty() ? "    firstNearest" : "    meetNearest", touch(slower),
                           !t.cell.empty() ? concat("isShort(", t.cell, "), false")
                           : t.swept       ? "false, false"
                                           : "true, true",
                           ");\n");
        survey_ += head;
        if (!t.cell.empty())
            survey_ += concat("    if (isShort(", t.cell, ")) meetShort", touch(""),
                              "velocity, skip);\n    else meetSwept", touch(slower), "skip);\n");
        else
            survey_ += concat("    ", t.swept ? "meetSwept" : "meetSolid", touch(""),
                              t.swept ? "" : "velocity, ", "skip);\n");
    }

    std::string source(const GeneratedColliders& out, const std::string& fastest) const {
        return concat(
            truth("areSwept", swept_), truth("nearestIsEnough", nearestIsEnough()),
            truth("areBounded", isBounded()),
            "#include \"physics/collide.glsl\"\n#include \"step/surfaces.glsl\"\n",
            "#include \"step/survey.glsl\"\n", parameterArray("colliderParameters", out.parameters.size()),
            truth("collidersMove", !out.moving.empty()), truth("alone", colliders_->size() == 1), "\n",
            "// Restitution and friction.\nvec2 materialOf(Touch t)\n{\n",
            table_.empty() ? ""
                           : "    // of a collider in the table: -1 - the uniform's index\n"
                             "    int index = int(-0.5 - t.material.x);\n#ifdef FUSED\n"
                             "    if (t.material.x < 0.0) return givenColliderParameters[index].xy;\n#else\n"
                             "    if (t.material.x < 0.0) return colliderParameters[index].xy;\n#endif\n",
            "    return t.material;\n}\n\n",
            "// m/s: no surface that is looked for on the way moves faster.\nfloat fastestSurface()\n{\n",
            "    return ", fastest, ";\n}\n\n",
            "// m: x from the nearest surface of all, y of those that are looked for on the way, less the\n",
            "// thickness; negative inside. time: s since the frame's start.\n",
            "vec2 clearances(vec3 anchor, vec3 position, float time)\n{\n",
            "    Contact c = Contact(position, vec3(0.0));\n    vec4 surface;\n    vec2 least = "
            "vec2(1e30);\n",
            clearances_, "    return vec2(min(least.x, least.y), least.y);\n}\n\n",
            "float clearance(vec3 anchor, vec3 position, float time)\n{\n    return clearances(anchor, "
            "position, time).x;\n}\n\n",
            table_.empty() ? "#include \"step/no_table.glsl\"\n" : gather_,
            "// Nearest and first: of all but those whose numbers are skip.xy.\n",
            "Survey survey(vec3 anchor, vec3 position, vec3 velocity, float time, ivec3 skip)\n{\n",
            "    Contact c = Contact(position, velocity);\n    vec4 surface;\n    Survey s = noSurvey();\n",
            survey_, "    return s;\n}\n\n",
            "// What is nearest of all.\nNearest nearest(vec3 anchor, vec3 position, float time)\n{\n",
            "    Contact c = Contact(position, vec3(0.0));\n    vec4 surface;\n",
            "    Nearest s = Nearest(noTouch(), true, true, 1e30);\n", nearest_, "    return s;\n}\n\n",
            "#include \"step/joint_contact.glsl\"\n");
    }

    bool still() const {
        return std::none_of(colliders_->begin(), colliders_->end(),
                            [](const Collider& collider) { return collider.path.has_value(); });
    }
    bool any(auto&& holds) const { return std::any_of(colliders_->begin(), colliders_->end(), holds); }

    // Fields are dear to look up, and answered at the end of a short way.
    static bool isField(const Collider& collider) { return isKind<DistanceFieldCollider>(collider); }

    bool nearestIsEnough() const {
        constexpr size_t few = 8;
        return still() && any(isField) && table_.empty() && colliders_->size() <= few;
    }

    // Whether looking is dear, and no distance changes faster than the place: a height field's does.
    bool isBounded() const {
        return still() && (any(isField) || !table_.empty()) && !any(isKind<HeightFieldCollider>);
    }

    const std::vector<Collider>* colliders_;
    std::vector<glm::vec4>* samples_;
    ColliderWriter writer_;
    ColliderTable table_;
    std::map<std::tuple<std::string, double, double>, size_t> materials_;
    std::string clearances_, survey_, nearest_;  // statements
    std::string gather_;                         // a function
    bool swept_ = false;
};

}  // namespace

bool respondTogether(const std::vector<Collider>& colliders) {
    return colliders.size() > 1 || (!colliders.empty() && (colliders[0].path || isSwept(colliders[0])));
}

GeneratedColliders generateColliders(const std::vector<Collider>& colliders, std::vector<glm::vec4>& samples,
                                     const glm::dvec3& near) {
    if (respondTogether(colliders)) return Joint(colliders, samples, near).generate();
    ColliderWriter writer(samples, near);
    writer.result.materials.resize(colliders.size());
    const size_t before = samples.size();
    const std::string body = colliders.empty() ? "" : sourceOfOne(writer.text(colliders[0], 0));
    GeneratedColliders out = std::move(writer.result);
    const bool dear = samples.size() > before;  // what reads samples
    out.source = concat(truth("keepsSurface", dear), "#include \"physics/collide.glsl\"\n",
                        "#include \"step/surfaces.glsl\"\n",
                        parameterArray("colliderParameters", out.parameters.size()), body);
    return out;
}

}  // namespace shoal
