// Embree finds the triangles, in single precision and generously; the hits are ours, in double.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/embree.h"
#include "geometry/mesh.h"

namespace shoal {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

}  // namespace shoal
