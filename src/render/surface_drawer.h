// Draws what stands still: host models and terrain, and the colliders that molecules touch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "render/lighting.h"
#include "render/view.h"
#include "scene/known_colliders.h"

namespace shoal {

struct SurfaceMesh;

class SurfaceDrawer {
  public:
    // `shadows`: the sun casts some; `grid`: planes show a metre grid.
    SurfaceDrawer(gpu::Context& context, const Scene& scene, const Lighting& lighting, bool shadows,
                  bool grid);

    // Draws these instead of the scene's.
    void changeColliders(gpu::Context& context, const std::vector<Collider>& colliders,
                         const Lighting& lighting);

    static bool blends(const Scene& scene);  // whether a model has a part that is blended with what is behind
    bool blends() const { return blends_; }
    bool castsStill() const;                     // something that stands still casts a shadow
    bool refracts() const { return refracts_; }  // then what is not blended has to be at hand as a picture

    // Draws what moves, at a time in s; without a time what stands still.
    void drawShadows(const ShadowMap& shadow, std::optional<double> time) const;
    void draw(const Eye& eye, const Lighting& lighting, double time, bool multisampled) const;
    // From back to front. `behind`: the light of all that is not blended, and its depth; only where it
    // refracts.
    struct Behind {
        const gpu::Texture *light = nullptr, *depth = nullptr;
    };
    void drawBlended(const Eye& eye, const Lighting& lighting, double time, const Behind& behind) const;

  private:
    // The triangles of a mesh that look alike.
    struct Look {
        SurfaceMaterial material;
        int firstIndex = 0, indexCount = 0;
        double plate = 0;      // m: the thickness of what refracts
        glm::dvec3 middle{0};  // m, relative to the mesh's origin: orders what is blended
        const gpu::Program* lit = nullptr;
        const gpu::Program* depth = nullptr;  // null: casts no shadow
    };
    struct Drawn {
        glm::dvec3 origin{0};  // m, of the mesh
        float detail = 0;
        bool stony = false;  // the kind of its grain
        bool casts = true;
        std::vector<Look> looks;
        std::vector<gpu::Texture> images;  // as the materials number them
        gpu::Buffer corners, indices;
        gpu::VertexArray array;
        std::optional<PlaneCollider> plane;  // the mesh follows the eye along it
        std::optional<ColliderPath> path;    // of a collider that moves
        std::optional<Box> closed;  // of an opaque model that is closed: bounds, from outside which its back
                                    // is never seen. Looked for only where hidden triangles cost much
    };

    static Drawn drawnModel(gpu::Context& context, const Model& model);
    void add(gpu::Context& context, const SurfaceMesh& mesh, Drawn drawn, const char* label);
    void choosePrograms(gpu::Context& context, const Lighting& lighting);
    void submit(const Drawn& surface, const Look& look) const;
    void drawLook(const Drawn& surface, const Look& look, const Eye& eye, const Lighting& lighting,
                  double time) const;
    void applyGlass(const Look& look, const Eye& eye, const Behind& behind) const;
    void placePlane(const gpu::Program& program, const PlaneCollider& plane, const Eye& eye) const;

    gpu::Programs programs_;
    std::vector<Drawn> surfaces_;  // the models, then the colliders
    size_t models_ = 0;
    bool shadows_, grid_;
    bool blends_ = false, refracts_ = false;
};

}  // namespace shoal
