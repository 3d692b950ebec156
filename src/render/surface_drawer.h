// Draws what stands still: host models and terrain, and the colliders that molecules touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/program.h"
#include "render/lighting.h"
#include "render/view.h"
#include "scene/collider_kinds.h"

namespace shoal {

struct SurfaceMesh;

class SurfaceDrawer {
  public:
    // `grid`: planes show a metre grid.
    SurfaceDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene,
                  const Lighting& lighting, const ShadowMap* shadow, bool grid);

    void drawShadows(const ShadowMap& shadow, double time) const;
    void draw(const Eye& eye, const Lighting& lighting, double time) const;

  private:
    struct Drawn {
        glm::dvec3 origin{0};  // m, of the mesh
        glm::vec3 color{1};
        float roughness = 0.9f, detail = 0;
        bool casts = true;
        int indexCount = 0;
        gpu::Buffer corners, indices;
        gpu::VertexArray array;
        std::optional<PlaneCollider> plane;  // the mesh follows the eye along it
        std::optional<ColliderPath> path;    // of a collider that moves
    };

    void add(gpu::Context& context, const SurfaceMesh& mesh, Drawn drawn, const char* label);
    void submit(const Drawn& surface) const;
    void placePlane(const gpu::Program& program, const PlaneCollider& plane, const Eye& eye) const;

    gpu::Program lit_, litPlane_, depth_;
    std::vector<Drawn> surfaces_;
};

}  // namespace shoal
