#include "compile/collider_table.h"

#include "core/error.h"

namespace shoal {

namespace {

constexpr size_t sphereTexels = 2, boxTexels = 4, capsuleTexels = 4;

glm::vec4 texel(const glm::dvec3& v, double w) {
    return {glm::vec3(v), float(w)};
}

struct Kind {
    const char* name;
    size_t texels;
    const char* surface;    // text: from t[0] ...
    const char* thickness;  // text
};

constexpr Kind kinds[] = {
    {"spheres", sphereTexels, "sphereSurface((anchor - t0.xyz) + position, t0.w)", "t1.x"},
    {"boxes", boxTexels,
     "turnedSurface(t2, boxSurface(turnedBack(t2, (anchor - t0.xyz) + position), t1.xyz))", "t0.w"},
    {"capsules", capsuleTexels, "capsuleSurface((anchor - t0.xyz) + position, t1.xyz, t1.w, t2.xyz, t0.w)",
     "t2.w"}};

std::string loopOver(const Kind& kind, size_t base, size_t count, const std::string& body, bool numbers) {
    std::string out =
        concat("    // ", count, " ", kind.name, "\n    for (int n = 0; n < ", count, "; ++n) {\n");
    for (size_t i = 0; i < kind.texels; ++i) {
        const bool last = i + 1 == kind.texels;
        if (last && !numbers && kind.texels > sphereTexels) continue;
        out += concat("        vec4 t", i, " = sampleAt(", base + i, " + n * ", kind.texels, ");\n");
    }
    return concat(out, "        surface = ", kind.surface, ";\n        ", body, "\n    }\n");
}

}  // namespace

bool ColliderTable::holds(const Collider& collider) {
    const ColliderShape& shape = collider.shape;
    return !collider.path &&
           (std::holds_alternative<SphereCollider>(shape) || std::holds_alternative<BoxCollider>(shape) ||
            std::holds_alternative<CapsuleCollider>(shape));
}

void ColliderTable::add(const Collider& collider, size_t number, size_t material) {
    const auto last = [&](double x) { return glm::vec4(float(x), 0, float(number), float(material)); };
    if (const auto* sphere = std::get_if<SphereCollider>(&collider.shape)) {
        spheres_.push_back(texel(sphere->center, sphere->radius));
        spheres_.push_back(last(collider.thickness));
    } else if (const auto* box = std::get_if<BoxCollider>(&collider.shape)) {
        const glm::dquat& q = box->rotation;
        boxes_.push_back(texel(box->center, collider.thickness));
        boxes_.push_back(texel(box->size / 2.0, 0));
        boxes_.push_back(texel({q.x, q.y, q.z}, q.w));
        boxes_.push_back(last(0));
    } else if (const auto* capsule = std::get_if<CapsuleCollider>(&collider.shape)) {
        const CapsuleAxis axis = axisOf(*capsule);
        capsules_.push_back(texel(capsule->from, capsule->radius));
        capsules_.push_back(texel(axis.along, axis.perLength));
        capsules_.push_back(texel(axis.aside, collider.thickness));
        capsules_.push_back(last(0));
    }
}

ColliderTable::Loops ColliderTable::write(std::vector<glm::vec4>& samples) const {
    Loops out;
    const std::vector<glm::vec4>* texels[] = {&spheres_, &boxes_, &capsules_};
    for (size_t k = 0; k < 3; ++k) {
        if (texels[k]->empty()) continue;
        const Kind& kind = kinds[k];
        const size_t base = samples.size(), count = texels[k]->size() / kind.texels;
        samples.insert(samples.end(), texels[k]->begin(), texels[k]->end());
        out.clearances += loopOver(
            kind, base, count, concat("least.y = min(least.y, surface.w - ", kind.thickness, ");"), false);
        const std::string last = concat("t", kind.texels - 1);
        out.survey +=
            loopOver(kind, base, count,
                     concat("meetSwept(s, Touch(surface.xyz, surface.w - ", kind.thickness, ", vec2(-1.0 - ",
                            last, ".w, 0.0), vec3(0.0), int(", last, ".z)), skip);"),
                     true);
    }
    return out;
}

}  // namespace shoal
