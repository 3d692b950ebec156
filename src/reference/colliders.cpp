#include "reference/colliders.h"

#include <algorithm>
#include <cmath>

#include "scene/collider_kinds.h"

namespace shoal::reference {

namespace {

// m: half the way over which the slopes of a height field are measured. Its heights are bilinear, so that
// only rounding (1e-16 / 1e-6 of a height) and the normal's curvature (1e-12 of it) are lost.
constexpr double nudge = 1e-6;

// Each kind has two functions: its surface at x, where `beyond` is the cells by which a height field reaches
// past its border; and the facts about it, where `thickness` is the collider's.
Surface surface(const PlaneCollider& plane, const glm::dvec3& x, double) {
    const glm::dvec3 n = glm::normalize(plane.normal);
    return {n, glm::dot(x - plane.point, n)};
}

Surface surface(const SphereCollider& sphere, const glm::dvec3& x, double) {
    const glm::dvec3 d = x - sphere.center;
    const double r = glm::length(d);
    return {r > 0 ? d / r : glm::dvec3(0, 1, 0), r - sphere.radius};
}

Surface surface(const BoxCollider& box, const glm::dvec3& x, double) {
    const glm::dvec3 local = glm::conjugate(box.rotation) * (x - box.center),
                     q = glm::abs(local) - box.size / 2.0;
    glm::dvec3 n = glm::max(q, 0.0);
    double distance = glm::length(n);
    if (distance > 0) {
        n /= distance;
    } else {  // inside: the nearest face
        const int axis = q.x >= q.y && q.x >= q.z ? 0 : q.y >= q.z ? 1 : 2;
        n[axis] = 1;
        distance = q[axis];
    }
    for (int i = 0; i < 3; ++i)
        if (local[i] < 0) n[i] = -n[i];
    return {box.rotation * n, distance};
}

Surface surface(const CapsuleCollider& capsule, const glm::dvec3& x, double) {
    const glm::dvec3 axis = capsule.to - capsule.from, off = x - capsule.from;
    const double squared = glm::dot(axis, axis);
    const double share = squared > 0 ? std::clamp(glm::dot(off, axis) / squared, 0.0, 1.0) : 0;
    const glm::dvec3 d = off - share * axis;
    const double r = glm::length(d);
    if (r > 0) return {d / r, r - capsule.radius};
    const glm::dvec3 other = std::abs(axis.x) <= std::abs(axis.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 n = glm::cross(axis, other);
    return {glm::length(n) > 0 ? glm::normalize(n) : glm::dvec3(0, 1, 0), -capsule.radius};
}

// Between the values value(x, z) of the four samples around p, in units of cells.
template <typename Value>
auto bilinear(const HeightFieldCollider& field, const glm::dvec2& p, Value&& value) {
    const int x = std::clamp(int(p.x), 0, field.columns - 2), z = std::clamp(int(p.y), 0, field.rows - 2);
    const glm::dvec2 f = p - glm::dvec2(x, z);
    return (value(x, z) * (1 - f.x) + value(x + 1, z) * f.x) * (1 - f.y) +
           (value(x, z + 1) * (1 - f.x) + value(x + 1, z + 1) * f.x) * f.y;
}

// A height field in units of its cells, with the sizes of a cell in m.
class Heights {
  public:
    explicit Heights(const HeightFieldCollider& field)
        : field_(&field), cell_((field.high - field.low) / glm::dvec2(field.columns - 1, field.rows - 1)) {}

    glm::dvec2 cell() const { return cell_; }
    glm::dvec2 place(const glm::dvec3& x) const { return (glm::dvec2(x.x, x.z) - field_->low) / cell_; }
    bool holds(const glm::dvec2& p, double beyond) const {
        return p.x >= -beyond && p.y >= -beyond && p.x <= field_->columns - 1 + beyond &&
               p.y <= field_->rows - 1 + beyond;
    }

    double height(const glm::dvec2& p) const {
        return bilinear(*field_, p, [this](int x, int z) { return sample(x, z); });
    }

    // Between the samples' normals, which are central differences.
    glm::dvec3 storedNormal(const glm::dvec2& p) const {
        return glm::normalize(bilinear(*field_, p, [this](int x, int z) { return sampleNormal(x, z); }));
    }

    // From the heights a cell away, towards the inside at the far border [Latta 2004, section 3.4.2].
    glm::dvec3 threeSampleNormal(const glm::dvec2& p) const {
        const double x = p.x + 1 <= field_->columns - 1 ? 1 : -1, z = p.y + 1 <= field_->rows - 1 ? 1 : -1;
        const double here = height(p);
        return glm::normalize(glm::dvec3((here - height(p + glm::dvec2(x, 0))) * x / cell_.x, 1,
                                         (here - height(p + glm::dvec2(0, z))) * z / cell_.y));
    }

  private:
    double sample(int x, int z) const {
        return field_->level + double(field_->heights[size_t(z) * size_t(field_->columns) + size_t(x)]);
    }

    glm::dvec3 sampleNormal(int x, int z) const {
        const int left = std::max(x - 1, 0), right = std::min(x + 1, field_->columns - 1);
        const int back = std::max(z - 1, 0), front = std::min(z + 1, field_->rows - 1);
        return glm::normalize(glm::dvec3((sample(left, z) - sample(right, z)) / (cell_.x * (right - left)), 1,
                                         (sample(x, back) - sample(x, front)) / (cell_.y * (front - back))));
    }

    const HeightFieldCollider* field_;
    glm::dvec2 cell_;  // m
};

Surface surface(const HeightFieldCollider& field, const glm::dvec3& x, double beyond) {
    const Heights heights(field);
    const glm::dvec2 p = heights.place(x);
    if (!heights.holds(p, beyond)) return {};
    const glm::dvec3 n = field.sampledNormals ? heights.threeSampleNormal(p) : heights.storedNormal(p);
    return {n, (x.y - heights.height(p)) * n.y};
}

// The least y of a unit normal: a slope is at most the steepest step between neighbours, along both axes.
double leastUp(const HeightFieldCollider& field, const glm::dvec2& cell) {
    double steepX = 0, steepZ = 0;
    const auto height = [&](int x, int z) {
        return double(field.heights[size_t(z) * size_t(field.columns) + size_t(x)]);
    };
    for (int z = 0; z < field.rows; ++z) {
        for (int x = 0; x < field.columns; ++x) {
            if (x > 0) steepX = std::max(steepX, std::abs(height(x, z) - height(x - 1, z)) / cell.x);
            if (z > 0) steepZ = std::max(steepZ, std::abs(height(x, z) - height(x, z - 1)) / cell.y);
        }
    }
    return 1 / std::sqrt(1 + steepX * steepX + steepZ * steepZ);
}

Surface surface(const DistanceFieldCollider& collider, const glm::dvec3& x, double) {
    const FieldValue value = valueAt(collider.field, x);
    return {glm::normalize(value.gradient), value.distance};
}

struct FactsOf {
    double thickness;  // m, of the collider

    SurfaceFacts operator()(const PlaneCollider&) const { return {}; }
    SurfaceFacts operator()(const SphereCollider& sphere) const { return {.feature = sphere.radius / 2}; }
    SurfaceFacts operator()(const CapsuleCollider& capsule) const { return {.feature = capsule.radius / 2}; }
    SurfaceFacts operator()(const BoxCollider& box) const {
        return {.feature = std::min({box.size.x, box.size.y, box.size.z}) / 4};
    }
    SurfaceFacts operator()(const HeightFieldCollider& field) const {
        const glm::dvec2 cell = Heights(field).cell();
        const double highest =
            field.level + double(*std::max_element(field.heights.begin(), field.heights.end()));
        const double top = highest + thickness / leastUp(field, cell);
        return {.feature = std::min(cell.x, cell.y), .top = top, .steepest = 0, .exact = false};
    }
    SurfaceFacts operator()(const DistanceFieldCollider& collider) const {
        // a trilinear function between distances
        return {.feature = collider.field.grid.cell, .steepest = std::sqrt(3.0), .exact = false};
    }
};

}  // namespace

Surface surfaceAt(const ColliderShape& shape, const glm::dvec3& x) {
    return std::visit([&](const auto& kind) { return surface(kind, x, 0); }, shape);
}

RestSurfaces::RestSurfaces(const std::vector<Collider>& colliders) : colliders_(&colliders) {
    for (const Collider& collider : colliders)
        facts_.push_back(std::visit(FactsOf{collider.thickness}, *collider.shape));
}

Surface RestSurfaces::surfaceOf(size_t i, const glm::dvec3& x) const {
    Surface out = surfaceAt(*collider(i).shape, x);
    out.distance -= collider(i).thickness;
    return out;
}

Surface RestSurfaces::under(size_t i, const glm::dvec3& x) const {
    Surface out = std::visit([&](const auto& kind) { return surface(kind, x, 0.5); }, *collider(i).shape);
    out.distance -= collider(i).thickness;
    return out;
}

bool RestSurfaces::clear(size_t i, const glm::dvec3& x, double reach) const {
    if (x.y - reach > facts_[i].top) return true;
    return facts_[i].steepest > 0 && surfaceOf(i, x).distance > reach * facts_[i].steepest;
}

RestSurfaces::Following RestSurfaces::following(size_t i, const Surface& surface, const glm::dvec3& x,
                                                const glm::dvec3& v) const {
    if (std::holds_alternative<PlaneCollider>(*collider(i).shape)) return {};
    const double speed = glm::length(v);
    if (!(speed > 0)) return {};
    if (const auto* sphere = std::get_if<SphereCollider>(&*collider(i).shape)) {
        // v . dn/dt = v_t^2 / r, from the centre
        const double r = surface.distance + collider(i).thickness + sphere->radius;
        const double along = glm::dot(v, surface.normal);
        return {0, (speed * speed - along * along) / r};
    }
    if (exact(i)) {
        const double time = nudge / speed;
        const glm::dvec3 turn = surfaceOf(i, x + v * time).normal - surfaceOf(i, x - v * time).normal;
        return {0, glm::dot(v, turn) / (2 * time)};
    }
    const double shift = shiftAlong(i, surface, x, v);
    const glm::dvec3 rate = v + shift * surface.normal;
    const double time = nudge / glm::length(rate);
    const Surface ahead = under(i, x + rate * time), behind = under(i, x - rate * time);
    return {shift, glm::dot(v, ahead.normal - behind.normal) / (2 * time)};
}

// Keeps the distance: v . grad d + shift (n . grad d) = 0.
double RestSurfaces::shiftAlong(size_t i, const Surface& surface, const glm::dvec3& x,
                                const glm::dvec3& v) const {
    const double time = nudge / glm::length(v);
    const glm::dvec3 lift = surface.normal * nudge;
    const Surface ahead = under(i, x + v * time), behind = under(i, x - v * time);
    const double steep = (under(i, x + lift).distance - under(i, x - lift).distance) / (2 * nudge);
    return steep > 0 ? -(ahead.distance - behind.distance) / (2 * time) / steep : 0;
}

}  // namespace shoal::reference
