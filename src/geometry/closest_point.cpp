// Embree finds the triangles, in single precision and generously; distances and hits are ours, in double.
// Closest points are computed in the hierarchy's units.
#include "geometry/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/error.h"

namespace shoal {

// ---- Embree 3 or 4, whose differences end here

namespace {

// Bounds the rounding of floats in [-1, 1], with room: searches look this much further.
constexpr double looseness = 1e-6;

// A bounding volume hierarchy [Wald 2014] over one geometry of a mesh's triangles. Its units are the mesh's
// longest side about its middle, so that tiny, huge and far meshes are alike to Embree's floats.
struct Hierarchy {
    glm::dvec3 middle;
    double size;  // m, of the unit
    size_t triangleCount;
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    // Error: Embree does not start.
    explicit Hierarchy(const Mesh& mesh)
        : middle((mesh.low + mesh.high) / 2.0), triangleCount(mesh.triangles.size()) {
        const glm::dvec3 extent = mesh.high - mesh.low;
        size = std::max({extent.x, extent.y, extent.z, std::numeric_limits<double>::min()});
        device = rtcNewDevice(nullptr);
        if (!device) throw Error("Embree does not start");
        scene = rtcNewScene(device);
    }
    ~Hierarchy() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    Hierarchy(const Hierarchy&) = delete;
    Hierarchy& operator=(const Hierarchy&) = delete;

    // Takes the geometry over. Error: no memory for it.
    void build(RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw noMemory();
    }
    Error noMemory() const { return Error("no memory for the hierarchy of ", triangleCount, " triangles"); }

    glm::dvec3 toUnits(const glm::dvec3& x) const { return (x - middle) / size; }

    // The first hit beyond `least`, all in units; hit.geomID is RTC_INVALID_GEOMETRY_ID where there is none.
    RTCRayHit firstHit(const glm::vec3& from, const glm::vec3& direction, float least) const {
        RTCRayHit ray{};
        ray.ray.org_x = from.x, ray.ray.org_y = from.y, ray.ray.org_z = from.z;
        ray.ray.dir_x = direction.x, ray.ray.dir_y = direction.y, ray.ray.dir_z = direction.z;
        ray.ray.tnear = least;
        ray.ray.tfar = std::numeric_limits<float>::infinity();
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(scene, &ray, nullptr);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &ray);
#endif
        return ray;
    }
};

}  // namespace

// ---- Closest points

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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
    double least = infinity;
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

ClosestPoint ClosestPoints::find(const glm::dvec3& x, double within, int guess) const {
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
    int passed = 0;  // ways out less ways in, so far; at the end the start's winding number
    double out[2] = {infinity, infinity};  // where that was first -1 and 1
    bool seen[2] = {false, false};
    float reached = float(looseness);
    for (int wall = 0; wall < mostWalls; ++wall) {
        const RTCRayHit ray = tree_->firstHit(start, way, reached);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return passed == 1 ? out[1] : passed == -1 ? out[0] : infinity;
        }
        const double facing = glm::dot(tree_->normals[ray.hit.primID], direction);
        passed += facing > 0 ? 1 : -1;
        if (const size_t side = passed > 0; std::abs(passed) == 1 && !seen[side]) {
            seen[side] = true;
            if (std::abs(facing) > std::sqrt(0.5)) out[side] = double(ray.ray.tfar) * tree_->size;
        }
        reached = ray.ray.tfar * (1 + float(looseness)) + float(looseness);
    }
    return infinity;
}

// ---- Thickness

namespace {

// One ray at a time.
class ExitSearch {
  public:
    // Hits closer than `least` are those of the triangles that a ray starts on.
    ExitSearch(const Mesh& mesh, double least) : hierarchy_(mesh), least_(least) {
        for (const glm::ivec3& t : mesh.triangles) {
            const glm::dvec3& a = mesh.positions[size_t(t.x)];
            faces_.push_back({a, mesh.positions[size_t(t.y)] - a, mesh.positions[size_t(t.z)] - a});
        }
        RTCGeometry geometry = rtcNewGeometry(hierarchy_.device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, unsigned(faces_.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(geometry, bound, nullptr);
        rtcSetGeometryIntersectFunction(geometry, meet);
        hierarchy_.build(geometry);
    }

    // Distance from `from` along the unit `direction` to the first triangle; infinite when there is none or
    // when the ray meets its front, so that it started outside.
    double exit(const glm::dvec3& from, const glm::dvec3& direction) {
        from_ = from, direction_ = direction;
        distance_ = infinity, leaving_ = false;
        hierarchy_.firstHit(hierarchy_.toUnits(from), direction, 0);
        return leaving_ ? distance_ : infinity;
    }

  private:
    struct Face {
        glm::dvec3 a, ab, ac;
    };

    static void bound(const RTCBoundsFunctionArguments* asked) {
        const ExitSearch& self = *static_cast<const ExitSearch*>(asked->geometryUserPtr);
        const Face& face = self.faces_[asked->primID];
        const glm::dvec3 a = self.hierarchy_.toUnits(face.a), b = self.hierarchy_.toUnits(face.a + face.ab),
                         c = self.hierarchy_.toUnits(face.a + face.ac);
        const glm::vec3 low = glm::min(a, glm::min(b, c)) - looseness,
                        high = glm::max(a, glm::max(b, c)) + looseness;
        *asked->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
    }

    static void meet(const RTCIntersectFunctionNArguments* asked) {
        ExitSearch& self = *static_cast<ExitSearch*>(asked->geometryUserPtr);
        if (!self.meets(self.faces_[asked->primID])) return;
        RTCRay& ray = reinterpret_cast<RTCRayHit*>(asked->rayhit)->ray;
        ray.tfar = std::min(ray.tfar, float(self.distance_ / self.hierarchy_.size + 4 * looseness));
    }

    // Moeller and Trumbore's test: true when no hit so far is nearer. Of two in one place the way out counts,
    // in whichever order Embree finds them.
    bool meets(const Face& f) {
        const glm::dvec3 p = glm::cross(direction_, f.ac);
        const double determinant = glm::dot(f.ab, p);  // below 0 when the ray leaves through the back
        if (determinant == 0) return false;
        const glm::dvec3 t = from_ - f.a;
        const double u = glm::dot(t, p) / determinant;
        if (!(u >= -1e-9 && u <= 1 + 1e-9)) return false;
        const glm::dvec3 q = glm::cross(t, f.ab);
        const double v = glm::dot(direction_, q) / determinant;
        if (!(v >= -1e-9 && u + v <= 1 + 1e-9)) return false;
        const double distance = glm::dot(f.ac, q) / determinant;
        if (!(distance > least_ && distance <= distance_)) return false;
        leaving_ = determinant < 0 || (distance == distance_ && leaving_);
        distance_ = distance;
        return true;
    }

    Hierarchy hierarchy_;
    double least_;  // m
    std::vector<Face> faces_;
    glm::dvec3 from_{0}, direction_{0};  // of the ray
    double distance_ = infinity;         // m: the nearest hit so far
    bool leaving_ = false;               // through that triangle's back
};

}  // namespace

std::vector<double> localThickness(const Mesh& mesh, const std::vector<char>& wanted) {
    ExitSearch search(mesh, 1e-6 * glm::distance(mesh.low, mesh.high));

    // In a frame with z inward: the middle, three at 15 degrees, four at 30.
    std::array<glm::dvec3, 8> fan = {glm::dvec3(0, 0, 1)};
    for (size_t i = 1; i < fan.size(); ++i) {
        const double angle = (i < 4 ? 15 : 30) * std::numbers::pi / 180;
        const double round = 2 * std::numbers::pi * (i < 4 ? double(i) / 3 + 0.05 : double(i) / 4);
        fan[i] = {std::sin(angle) * std::cos(round), std::sin(angle) * std::sin(round), std::cos(angle)};
    }

    std::vector<double> thickness(mesh.weldedPositions.size(), infinity);
    for (size_t v = 0; v < thickness.size(); ++v) {
        if (!wanted.empty() && !wanted[v]) continue;
        const glm::dvec3 inward = -mesh.weldedNormals[v];
        const glm::dvec3 other = std::abs(inward.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        const glm::dvec3 s = glm::normalize(glm::cross(inward, other)), t = glm::cross(inward, s);
        std::array<double, fan.size()> lengths;
        for (size_t i = 0; i < fan.size(); ++i)
            lengths[i] =
                search.exit(mesh.weldedPositions[v], fan[i].x * s + fan[i].y * t + fan[i].z * inward);
        const double middle = lengths[0];
        std::sort(lengths.begin(), lengths.end());
        const auto found = std::lower_bound(lengths.begin(), lengths.end(), infinity) - lengths.begin();
        if (found > 0) thickness[v] = std::min(middle, lengths[size_t(found - 1) / 2]);
    }
    return thickness;
}

double medianThickness(const Mesh& mesh) {
    std::vector<double> areas(mesh.weldedPositions.size());
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 a = mesh.positions[size_t(t[0])];
        const double area =
            0.5 * glm::length(glm::cross(mesh.positions[size_t(t[1])] - a, mesh.positions[size_t(t[2])] - a));
        for (int i = 0; i < 3; ++i)
            areas[size_t(mesh.weld[size_t(t[i])])] += area / 3;
    }
    const std::vector<double> thickness = localThickness(mesh);
    std::vector<size_t> order;
    double half = 0;
    for (size_t v = 0; v < thickness.size(); ++v)
        if (std::isfinite(thickness[v])) {
            order.push_back(v);
            half += 0.5 * areas[v];
        }
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return thickness[a] < thickness[b]; });
    for (const size_t v : order)
        if (half -= areas[v]; half <= 0) return thickness[v];
    return 0;
}

}  // namespace shoal
