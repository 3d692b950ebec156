#include <algorithm>
#include <cmath>

#include "compile/distance_samples.h"
#include "compile/generate.h"

namespace shoal {

namespace {

constexpr double leastAxis = 1e-9;  // m: ends of a capsule that are nearer coincide

// A unit vector across an axis of any length.
glm::dvec3 across(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    const glm::dvec3 out = glm::cross(axis / std::max({size.x, size.y, size.z, 1e-300}), other);
    return glm::length(out) > 0 ? glm::normalize(out) : glm::dvec3(0, 1, 0);
}

class Emitter {
  public:
    explicit Emitter(std::vector<glm::vec4>& samples) : samples_(&samples) {}

    GeneratedColliders result;
    std::string clearance;  // statements of the function of that name

    std::string slot(const glm::dvec3& v, double w = 0) {
        result.parameters.push_back(glm::vec4(glm::vec3(v), float(w)));
        return concat("colliderParameters[", result.parameters.size() - 1, "]");
    }

    void collider(const Collider& collider) {
        result.materials.push_back(result.parameters.size());
        const std::string material = slot({collider.restitution, collider.friction, collider.thickness});
        const std::string surface =
            std::visit([this](const auto& shape) { return emit(shape); }, collider.shape);
        const std::string comment =
            concat("    // ", kindName(collider.shape), " ", inComment(collider.name), "\n");
        clearance += concat(comment, "    surface = ", surface, ";\n    least = min(least, surface.w - ",
                            material, ".z);\n");
        result.source += concat(comment, "    surface = ", surface,
                                ";\n    c = respond(c.position, c.velocity, surface.w - ", material,
                                ".z, surface.xyz, gravity, ", material, ".x, ", material, ".y, drift);\n");
    }

  private:
    // Each returns text of a vec4: unit normal, signed distance (negative inside).
    std::string emit(const PlaneCollider& plane) {
        const std::string point = slot(plane.point), normal = slot(glm::normalize(plane.normal));
        return concat("planeSurface(anchor - ", point, ".xyz, c.position, ", normal, ".xyz)");
    }

    std::string emit(const SphereCollider& sphere) {
        const std::string center = slot(sphere.center, sphere.radius);
        return concat("sphereSurface((anchor - ", center, ".xyz) + c.position, ", center, ".w)");
    }

    std::string emit(const BoxCollider& box) {
        const std::string center = slot(box.center), half = slot(box.size / 2.0);
        const std::string x = concat("(anchor - ", center, ".xyz) + c.position");
        if (box.rotation == glm::dquat(1, 0, 0, 0)) return concat("boxSurface(", x, ", ", half, ".xyz)");
        const std::string turn = slot({box.rotation.x, box.rotation.y, box.rotation.z}, box.rotation.w);
        return concat("turnedSurface(", turn, ", boxSurface(turnedBack(", turn, ", ", x, "), ", half,
                      ".xyz))");
    }

    std::string emit(const CapsuleCollider& capsule) {
        glm::dvec3 axis = capsule.to - capsule.from;
        if (glm::length(axis) < leastAxis) axis = {};
        const double squared = glm::dot(axis, axis);
        const std::string from = slot(capsule.from, capsule.radius);
        const std::string along = slot(axis, squared > 0 ? 1 / squared : 0), aside = slot(across(axis));
        return concat("capsuleSurface((anchor - ", from, ".xyz) + c.position, ", along, ".xyz, ", along,
                      ".w, ", aside, ".xyz, ", from, ".w)");
    }

    std::string emit(const HeightFieldCollider& field) {
        const size_t base = samples_->size();
        const glm::dvec2 cell = (field.high - field.low) / glm::dvec2(field.columns - 1, field.rows - 1);
        appendSamples(field, cell);
        const std::string low = slot({field.low.x, 0, field.low.y});
        const std::string cells = slot({1 / cell.x, cell.x, cell.y}, 1 / cell.y);
        return concat(field.sampledNormals ? "heightSurfaceSampled" : "heightSurfaceStored", "((anchor - ",
                      low, ".xyz) + c.position, ", cells, ", ivec2(", field.columns, ", ", field.rows, "), ",
                      base, ")");
    }

    std::string emit(const DistanceFieldCollider& collider) {
        const DistanceField& field = collider.field;
        const size_t base = appendDistances(field, *samples_);
        const std::string low = slot(field.grid.low, field.grid.cell);
        const std::string last = slot(glm::dvec3(field.grid.size - 1), field.outside);
        return concat("distanceSurface((anchor - ", low, ".xyz) + c.position, ", low, ".w, ", last,
                      ", ivec2(", field.grid.size.x, ", ", field.grid.size.z, "), ", base, ")");
    }

    // One texel a sample: unit normal by central differences, and height.
    void appendSamples(const HeightFieldCollider& field, glm::dvec2 cell) {
        const auto height = [&](int x, int z) {
            x = std::clamp(x, 0, field.columns - 1);
            z = std::clamp(z, 0, field.rows - 1);
            return double(field.heights[size_t(z) * size_t(field.columns) + size_t(x)]);
        };
        samples_->reserve(samples_->size() + field.heights.size());
        for (int z = 0; z < field.rows; ++z) {
            for (int x = 0; x < field.columns; ++x) {
                const double spanX = cell.x * (std::min(x + 1, field.columns - 1) - std::max(x - 1, 0));
                const double spanZ = cell.y * (std::min(z + 1, field.rows - 1) - std::max(z - 1, 0));
                const glm::dvec3 normal =
                    glm::normalize(glm::dvec3((height(x - 1, z) - height(x + 1, z)) / spanX, 1,
                                              (height(x, z - 1) - height(x, z + 1)) / spanZ));
                samples_->emplace_back(glm::vec3(normal), float(height(x, z)));
            }
        }
    }

    std::vector<glm::vec4>* samples_;
};

}  // namespace

GeneratedColliders generateColliders(const std::vector<Collider>& colliders,
                                     std::vector<glm::vec4>& samples) {
    Emitter emitter(samples);
    for (const Collider& collider : colliders)
        emitter.collider(collider);
    GeneratedColliders out = std::move(emitter.result);
    out.source = concat(
        "#include \"physics/collide.glsl\"\n#include \"lib/surfaces.glsl\"\n",
        parameterArray("colliderParameters", out.parameters.size()),
        "Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, vec3 gravity, Drift drift)\n{\n",
        "    Contact c = Contact(position, velocity);\n    vec4 surface;\n", out.source,
        "    return c;\n}\n\n// m: from the nearest surface, less its thickness; negative inside.\n",
        "float clearance(vec3 anchor, vec3 position)\n{\n    Contact c = Contact(position, vec3(0.0));\n",
        "    vec4 surface;\n    float least = 1e30;\n", emitter.clearance, "    return least;\n}\n");
    return out;
}

const char* kindName(const ColliderShape& shape) {
    static constexpr const char* names[] = {"plane", "sphere",  "heightField",
                                            "box",   "capsule", "distanceField"};
    return names[shape.index()];
}

}  // namespace shoal
