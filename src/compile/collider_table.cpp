#include "compile/collider_table.h"

#include <algorithm>
#include <utility>

#include "compile/call_writer.h"
#include "compile/pack.h"
#include "scene/known_colliders.h"

namespace shoal {

namespace {

// Halves the members at the middle of their longest extent, and so on, so that those of a cluster lie
// together.
void arrange(std::span<ColliderTable::Member> members, size_t most) {
    if (members.size() <= most) return;
    glm::dvec3 low(1e300), high(-1e300);
    for (const ColliderTable::Member& member : members)
        low = glm::min(low, member.place), high = glm::max(high, member.place);
    const glm::dvec3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    // the first part in whole clusters
    const size_t half = ((members.size() + most - 1) / most + 1) / 2 * most;
    std::nth_element(members.begin(), members.begin() + ptrdiff_t(half), members.end(),
                     [axis](const auto& a, const auto& b) {
                         return std::pair(a.place[axis], a.number) < std::pair(b.place[axis], b.number);
                     });
    arrange(members.first(half), most);
    arrange(members.subspan(half), most);
}

// xyz the middle of a ball around all, m; w its radius, m, somewhat more than it is, for rounding.
glm::vec4 around(std::span<const ColliderTable::Member> members) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const ColliderTable::Member& member : members)
        low = glm::min(low, member.place - member.reach), high = glm::max(high, member.place + member.reach);
    const glm::dvec3 middle(glm::vec3(0.5 * (low + high)));
    double radius = 0;
    for (const ColliderTable::Member& member : members)
        radius = std::max(radius, glm::distance(middle, member.place) + member.reach);
    return {glm::vec3(middle), float(radius * (1 + 1e-6) + 1e-6 * glm::length(middle) + 1e-5)};
}

size_t clusters(size_t members) {
    return (members + ColliderTable::clusterSize - 1) / ColliderTable::clusterSize;
}

}  // namespace

ColliderTable::ColliderTable(const std::vector<Collider>& colliders) {
    glm::dvec3 low(1e300), high(-1e300);
    bool far = false;
    for (const Collider& collider : colliders) {
        if (!holds(collider)) continue;
        const glm::dvec3 place = callOf(*collider.shape).origin();
        low = glm::min(low, place);
        high = glm::max(high, place);
        far = far || splitPoint(place).isFar();
    }
    if (far) middle_ = glm::dvec3(glm::vec3(latticePoint(0.5 * (low + high))));
}

bool ColliderTable::holds(const Collider& collider) {
    return !collider.path && reachOf(*collider.shape) && !callOf(*collider.shape).readsSamples();
}

void ColliderTable::add(const Collider& collider, size_t number, size_t material) {
    CallFrame frame{.origin = middle_};
    if (isFar()) frame.anchor = "(anchor - middle)";
    CallWriter writer("t#", 0, nullptr, std::move(frame));
    Kind& kind = kinds_[kindIndex(*collider.shape)];
    kind.surface = writer.text(callOf(*collider.shape), false);
    kind.thickness = writer.number(collider.thickness);
    kind.read = writer.parameters.size();
    if (!kind.thickness.ends_with(".x")) writer.slot({});
    writer.parameters.back().z = float(number);
    writer.parameters.back().w = float(material);
    const glm::dvec3 place = callOf(*collider.shape).origin();
    const double reach = collider.thickness + *reachOf(*collider.shape, place);
    kind.members.push_back({place - middle_, reach, number, std::move(writer.parameters)});
}

std::string ColliderTable::memberText(const Kind& kind, size_t first, size_t read, const std::string& use) {
    std::string out = "{\n";
    for (size_t i = 0; i < read; ++i)
        out +=
            concat("            vec4 t", i, " = sampleAt(", first + i, " + n * ", kind.texelsOfOne(), ");\n");
    return concat(out, "            surface = ", kind.surface, ";\n            ", use, "\n        }\n");
}

std::string ColliderTable::loopOver(const Kind& kind, size_t base, size_t read, const std::string& limit,
                                    const std::string& use) const {
    const size_t count = kind.members.size();
    return concat("    for (int m = 0; m < ", clusters(count), "; ++m) {\n        vec4 around = sampleAt(",
                  base, " + m);\n        if (length(", isFar() ? "(anchor - middle)" : "anchor",
                  " + position - around.xyz) * 0.999999 - around.w - contactRadius < ", limit,
                  ")\n        for (int n = ", clusterSize, " * m; n < min(", clusterSize, " * m + ",
                  clusterSize, ", ", count, "); ++n) ", memberText(kind, base + clusters(count), read, use),
                  "    }\n");
}

ColliderTable::Loops ColliderTable::write(std::vector<glm::vec4>& samples) const {
    Loops out;
    if (empty()) return out;
    std::string middle, full, listed, gather;
    if (isFar()) {
        // This is not a constant in the text: NVIDIA's compiler would add it to small distances, which would
        // lose their digits.
        middle = concat("    vec3 middle = sampleAt(", samples.size(), ").xyz;\n");
        samples.emplace_back(glm::vec3(middle_), 0);
    }
    out.clearances = out.nearest = middle;
    size_t number = 0;
    for (const auto& [index, kind] : kinds_) {
        const size_t base = samples.size(), all = kind.texelsOfOne();
        std::vector<Member> members = kind.members;
        arrange(members, clusterSize);
        for (size_t c = 0; c < clusters(members.size()); ++c)
            samples.push_back(around(std::span(members).subspan(
                c * clusterSize, std::min(clusterSize, members.size() - c * clusterSize))));
        for (const Member& member : members)
            samples.insert(samples.end(), member.texels.begin(), member.texels.end());
        const std::string distance = concat("surface.w - max(", kind.thickness, ", contactRadius)"),
                          last = concat("t", all - 1),
                          touch = concat("Touch(surface.xyz, ", distance, ", vec2(-1.0 - ", last,
                                         ".w, 0.0), vec3(0.0), int(", last, ".z))"),
                          meet = concat("meetSwept(s, ", touch, ", skip);");
        out.clearances +=
            loopOver(kind, base, kind.read, "least.y", concat("least.y = min(least.y, ", distance, ");"));
        out.nearest +=
            loopOver(kind, base, all, "s.others", concat("meetNearest(s, ", touch, ", false, false);"));
        full += loopOver(kind, base, all, "max(s.swept.distance, 0.0)", concat("++turns; ", meet)) +
                concat("    turns += ", clusters(members.size()), ";\n");
        listed += concat("    for (int k = ", number == 0 ? "0" : concat("nearEnds[", number - 1, "]"),
                         "; k < nearEnds[", number, "]; ++k) {\n        int n = nearOnes[k];\n        ",
                         memberText(kind, base + clusters(members.size()), all, meet), "    }\n");
        gather += loopOver(kind, base, kind.read, "reach",
                           concat("if (", distance, " < reach) {\n                if (count < ", mostNear,
                                  ") nearOnes[count] = n;\n                ++count;\n            }")) +
                  concat("    nearEnds[", number, "] = count;\n");
        ++number;
    }
    out.survey = concat(middle, "    if (nearKnown) {\n", listed, "    } else {\n", full, "    }\n");
    out.gather = concat(
        "const bool areTabled = true;\n\nint turns = 0;  // of the loops over all, on the ways of this "
        "molecule\n#ifdef "
        "FUSED\nconst int "
        "mostTurns = ",
        mostTurns, ";\n#else\nconst int mostTurns = ", mostTurnsOfPass,
        ";\n#endif\n\n// Which colliders of the table are near: of each kind up to its end, where they "
        "are known.\n",
        "int nearOnes[", mostNear, "];\nint nearEnds[", number,
        "];\nbool nearKnown = false;\nvec3 nearPlace;  // m, where they were looked for, within "
        "nearReach\nfloat nearReach;\n\n",
        "// Looks for those that are less than `reach`, m, from a place.\n",
        "void gatherNear(vec3 anchor, vec3 position, float reach)\n{\n    vec4 surface;\n    int count = "
        "0;\n",
        middle, gather, "    nearKnown = count <= ", mostNear,
        ";\n    nearPlace = position;\n    nearReach = reach;\n}\n\n");
    return out;
}

size_t ColliderTable::turns() const {
    size_t out = 0;
    for (const auto& [index, kind] : kinds_) {
        const size_t count = kind.members.size(), near = 8 * clusterSize;
        out += 2 * clusters(count) + std::min(count, near);
    }
    return out;
}

}  // namespace shoal
