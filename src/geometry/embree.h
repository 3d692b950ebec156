// Embree 3 or 4, whose differences end here. Used by closest_point.cpp and thickness.cpp only.
#pragma once

#include <algorithm>
#include <limits>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/error.h"
#include "geometry/mesh.h"

namespace shoal {

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
    Error noMemory() const {
        return Error(concat("no memory for the hierarchy of ", triangleCount, " triangles"));
    }

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

}  // namespace shoal
