// Everything inside is in the hierarchy's units.
#include "geometry/closest_point.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/embree.h"

namespace shoal {

namespace {

// Triangles are as near as one another within this.
constexpr double alike = 1e-12;

struct Corners {
    glm::dvec3 a, b, c;
};

glm::dvec3 closestOnSegment(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& x) {
    const glm::dvec3 along = b - a;
    const double squared = glm::dot(along, along);
    if (!(squared > 0)) return a;
    return a + along * std::clamp(glm::dot(x - a, along) / squared, 0.0, 1.0);
}

// Inside the triangle's prism the foot of the perpendicular, else on one of its edges. A triangle without an
// area is its edges.
glm::dvec3 closestOnTriangle(const Corners& t, const glm::dvec3& x) {
    const glm::dvec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double squared = glm::dot(normal, normal);
    if (squared > 0) {
        const auto within = [&](const glm::dvec3& p, const glm::dvec3& q) {
            return glm::dot(glm::cross(q - p, x - p), normal) >= 0;
        };
        if (within(t.a, t.b) && within(t.b, t.c) && within(t.c, t.a))
            return x - normal * (glm::dot(x - t.a, normal) / squared);
    }
    glm::dvec3 best(0);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [p, q] : {std::pair(t.a, t.b), std::pair(t.b, t.c), std::pair(t.c, t.a)}) {
        const glm::dvec3 point = closestOnSegment(p, q, x);
        const double distance = glm::dot(point - x, point - x);
        if (distance < least) least = distance, best = point;
    }
    return best;
}

float above(double distance) {
    return std::nextafter(float(distance * (1 + looseness) + looseness), 2e30f);
}

}  // namespace

struct ClosestPoints::Tree : Hierarchy {
    using Hierarchy::Hierarchy;
    std::vector<Corners> triangles;
    std::vector<glm::dvec3> normals;  // unit, or 0 without an area
};

namespace {

// A query that goes through Embree.
struct Query {
    const std::vector<Corners>* triangles = nullptr;
    const std::vector<glm::dvec3>* normals = nullptr;
    glm::dvec3 x{0};
    ClosestPoint best;
    double facing = 0;  // cosine between the best triangle's normal and the way to x

    // True when the best is nearer now.
    bool consider(int t) {
        const glm::dvec3 point = closestOnTriangle((*triangles)[size_t(t)], x);
        const double distance = glm::distance(point, x);
        if (distance > best.distance + alike) return false;
        const double along = distance > 0 ? glm::dot((*normals)[size_t(t)], x - point) / distance : 0;
        const bool nearer = distance < best.distance - alike;
        if (!nearer && std::abs(along) <= std::abs(facing)) return false;
        best = {std::min(distance, best.distance), point, t, along >= 0};
        facing = along;
        return nearer;
    }
};

bool considerTriangle(RTCPointQueryFunctionArguments* found) {
    Query& query = *static_cast<Query*>(found->userPtr);
    if (!query.consider(int(found->primID))) return false;
    found->query->radius = above(query.best.distance);
    return true;
}

}  // namespace

ClosestPoints::ClosestPoints(const Mesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {
    Tree& tree = *tree_;
    RTCGeometry geometry = rtcNewGeometry(tree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners =
        static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                    3 * sizeof(float), mesh.weldedPositions.size()));
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
    if (!corners || !indices) {
        rtcReleaseGeometry(geometry);
        throw tree.noMemory();
    }
    for (const glm::dvec3& p : mesh.weldedPositions)
        for (int i = 0; i < 3; ++i)
            *corners++ = float(tree.toUnits(p)[i]);
    for (const glm::ivec3& t : mesh.triangles) {
        glm::dvec3 p[3];
        for (int i = 0; i < 3; ++i) {
            const size_t vertex = size_t(mesh.weld[size_t(t[i])]);
            *indices++ = unsigned(vertex);
            p[i] = tree.toUnits(mesh.weldedPositions[vertex]);
        }
        tree.triangles.push_back({p[0], p[1], p[2]});
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(normal);
        tree.normals.push_back(length > 0 ? normal / length : glm::dvec3(0));
    }
    tree.build(geometry);
}

ClosestPoints::~ClosestPoints() = default;

ClosestPoint ClosestPoints::at(const glm::dvec3& x, double within, int guess) const {
    Query query{&tree_->triangles, &tree_->normals, tree_->toUnits(x), {}, 0};
    query.best.distance = within / tree_->size;
    if (guess >= 0) query.consider(guess);
    RTCPointQuery around{float(query.x.x), float(query.x.y), float(query.x.z), 0, above(query.best.distance)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(tree_->scene, &around, &context, considerTriangle, &query);
    ClosestPoint out = query.best;
    out.distance *= tree_->size;
    out.point = out.point * tree_->size + tree_->middle;
    return out;
}

double ClosestPoints::across(const glm::dvec3& from, const glm::dvec3& direction) const {
    constexpr int mostWalls = 64;
    const glm::vec3 start(tree_->toUnits(from)), way(direction);
    constexpr double never = std::numeric_limits<double>::infinity();
    int passed = 0;                  // ways out less ways in, so far; at the end the start's winding number
    double out[2] = {never, never};  // where that was first -1 and 1
    bool seen[2] = {false, false};
    float reached = float(looseness);
    for (int wall = 0; wall < mostWalls; ++wall) {
        const RTCRayHit ray = tree_->firstHit(start, way, reached);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return passed == 1 ? out[1] : passed == -1 ? out[0] : never;
        }
        const double facing = glm::dot(tree_->normals[ray.hit.primID], direction);
        passed += facing > 0 ? 1 : -1;
        if (const size_t side = passed > 0; std::abs(passed) == 1 && !seen[side]) {
            seen[side] = true;
            if (std::abs(facing) > std::sqrt(0.5)) out[side] = double(ray.ray.tfar) * tree_->size;
        }
        reached = ray.ray.tfar * (1 + float(looseness)) + float(looseness);
    }
    return never;
}

}  // namespace shoal
