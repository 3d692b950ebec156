#include "compile/collider_table.h"

#include "compile/call_writer.h"
#include "compile/pack.h"
#include "scene/collider_kinds.h"

namespace shoal {

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
    Kind& kind = kinds_[collider.shape->index()];
    kind.name = kindName(*collider.shape);
    kind.name += kind.name.ends_with("x") ? "es" : "s";
    kind.surface = writer.text(callOf(*collider.shape), false);
    kind.thickness = writer.number(collider.thickness);
    kind.read = writer.parameters.size();
    if (!kind.thickness.ends_with(".x")) writer.slot({});
    writer.parameters.back().z = float(number);
    writer.parameters.back().w = float(material);
    kind.texels.insert(kind.texels.end(), writer.parameters.begin(), writer.parameters.end());
    ++kind.count;
}

std::string ColliderTable::loopOver(const Kind& kind, size_t base, size_t read, const std::string& body) {
    std::string out =
        concat("    // ", kind.count, " ", kind.name, "\n    for (int n = 0; n < ", kind.count, "; ++n) {\n");
    for (size_t i = 0; i < read; ++i)
        out += concat("        vec4 t", i, " = sampleAt(", base + i, " + n * ", kind.texelsOfOne(), ");\n");
    return concat(out, "        surface = ", kind.surface, ";\n        ", body, "\n    }\n");
}

ColliderTable::Loops ColliderTable::write(std::vector<glm::vec4>& samples) const {
    Loops out;
    if (isFar() && !empty()) {
        // Not a constant of the text, which NVIDIA's compiler would add to what is near, where it loses that.
        const std::string middle = concat("    vec3 middle = sampleAt(", samples.size(), ").xyz;\n");
        samples.emplace_back(glm::vec3(middle_), 0);
        out = {middle, middle, middle};
    }
    for (const auto& [index, kind] : kinds_) {
        const size_t base = samples.size(), all = kind.texelsOfOne();
        samples.insert(samples.end(), kind.texels.begin(), kind.texels.end());
        out.clearances += loopOver(kind, base, kind.read,
                                   concat("least.y = min(least.y, surface.w - ", kind.thickness, ");"));
        const std::string last = concat("t", all - 1);
        const std::string touch = concat("Touch(surface.xyz, surface.w - ", kind.thickness, ", vec2(-1.0 - ",
                                         last, ".w, 0.0), vec3(0.0), int(", last, ".z))");
        out.survey += loopOver(kind, base, all, concat("meetSwept(s, ", touch, ", skip);"));
        out.nearest += loopOver(kind, base, all, concat("meetNearest(s, ", touch, ", false, false);"));
    }
    return out;
}

}  // namespace shoal
