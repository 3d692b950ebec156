#include "compile/collider_table.h"

#include <algorithm>

#include "compile/glsl_text.h"
#include "compile/pack.h"

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

// `from`: text of the anchor's place, as the table's points are given.
std::string loopOver(const Kind& kind, size_t base, size_t count, const std::string& from,
                     const std::string& body, bool numbers) {
    std::string out =
        concat("    // ", count, " ", kind.name, "\n    for (int n = 0; n < ", count, "; ++n) {\n");
    for (size_t i = 0; i < kind.texels; ++i) {
        const bool last = i + 1 == kind.texels;
        if (last && !numbers && kind.texels > sphereTexels) continue;
        out += concat("        vec4 t", i, " = sampleAt(", base + i, " + n * ", kind.texels, ");\n");
    }
    std::string surface = kind.surface;
    surface.replace(surface.find("anchor"), std::string("anchor").size(), from);
    return concat(out, "        surface = ", surface, ";\n        ", body, "\n    }\n");
}

}  // namespace

ColliderTable::ColliderTable(const std::vector<Collider>& colliders) {
    glm::dvec3 low(1e300), high(-1e300);
    bool far = false;
    for (const Collider& collider : colliders) {
        if (!holds(collider)) continue;
        const glm::dvec3 place = placeOf(collider.shape);
        low = glm::min(low, place);
        high = glm::max(high, place);
        far = far || splitPoint(place).isFar();
    }
    if (far) middle_ = glm::dvec3(glm::vec3(latticePoint(0.5 * (low + high))));
}

bool ColliderTable::holds(const Collider& collider) {
    const ColliderShape& shape = collider.shape;
    return !collider.path &&
           (std::holds_alternative<SphereCollider>(shape) || std::holds_alternative<BoxCollider>(shape) ||
            std::holds_alternative<CapsuleCollider>(shape));
}

void ColliderTable::add(const Collider& collider, size_t number, size_t material) {
    const auto last = [&](double x) { return glm::vec4(float(x), 0, float(number), float(material)); };
    if (const auto* sphere = std::get_if<SphereCollider>(&collider.shape)) {
        spheres_.push_back(texel(sphere->center - middle_, sphere->radius));
        spheres_.push_back(last(collider.thickness));
    } else if (const auto* box = std::get_if<BoxCollider>(&collider.shape)) {
        const glm::dquat& q = box->rotation;
        boxes_.push_back(texel(box->center - middle_, collider.thickness));
        boxes_.push_back(texel(box->size / 2.0, 0));
        boxes_.push_back(texel({q.x, q.y, q.z}, q.w));
        boxes_.push_back(last(0));
    } else if (const auto* capsule = std::get_if<CapsuleCollider>(&collider.shape)) {
        const CapsuleAxis axis = axisOf(*capsule);
        capsules_.push_back(texel(capsule->from - middle_, capsule->radius));
        capsules_.push_back(texel(axis.along, axis.perLength));
        capsules_.push_back(texel(axis.aside, collider.thickness));
        capsules_.push_back(last(0));
    }
}

ColliderTable::Loops ColliderTable::write(std::vector<glm::vec4>& samples) const {
    Loops out;
    std::string from = "anchor";
    if (middle_ != glm::dvec3(0))
        from = concat("(anchor - vec3(", glslLiteral(middle_.x), ", ", glslLiteral(middle_.y), ", ",
                      glslLiteral(middle_.z), "))");
    const std::vector<glm::vec4>* texels[] = {&spheres_, &boxes_, &capsules_};
    for (size_t k = 0; k < 3; ++k) {
        if (texels[k]->empty()) continue;
        const Kind& kind = kinds[k];
        const size_t base = samples.size(), count = texels[k]->size() / kind.texels;
        samples.insert(samples.end(), texels[k]->begin(), texels[k]->end());
        out.clearances +=
            loopOver(kind, base, count, from,
                     concat("least.y = min(least.y, surface.w - ", kind.thickness, ");"), false);
        const std::string last = concat("t", kind.texels - 1);
        out.survey +=
            loopOver(kind, base, count, from,
                     concat("meetSwept(s, Touch(surface.xyz, surface.w - ", kind.thickness, ", vec2(-1.0 - ",
                            last, ".w, 0.0), vec3(0.0), int(", last, ".z)), skip);"),
                     true);
    }
    return out;
}

}  // namespace shoal
