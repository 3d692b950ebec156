// Triangles ready for a vertex buffer, relative to an origin of their own so that floats hold them far out.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace shoal {

struct SurfaceMesh {
    struct Corner {
        glm::vec3 position{0};  // m, relative to the origin
        glm::vec3 normal{0};    // unit
        glm::vec3 color{1};     // linear RGB
    };
    glm::dvec3 origin{0};  // m
    std::vector<Corner> corners;
    std::vector<uint32_t> indices;
};

SurfaceMesh meshOf(const Mesh& mesh);
SurfaceMesh sphereMesh(const SphereCollider& sphere);
SurfaceMesh boxMesh(const BoxCollider& box);
SurfaceMesh capsuleMesh(const CapsuleCollider& capsule);
// A disc of radius 1 around the origin; its rings are closer together in the middle, where the eye is.
SurfaceMesh discMesh(const glm::dvec3& normal);

// Two unit directions across a unit normal; x and z for one that points up.
std::pair<glm::dvec3, glm::dvec3> tangentsOf(const glm::dvec3& normal);

}  // namespace shoal
