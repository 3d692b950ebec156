// The picture: sky, host models, colliders and every molecule, with the sun's shadows, anti-aliased and
// gamma-correct. Draws straight from the state; moves no byte of state and writes none of it.
//
// The sky that near things hide is worked out from the depth of all that is not blended, and taken from
// the resolved light (render/occlusion.h).
//
// In scenes with water the net of caustics is drawn before all this, and its beams are added to the resolved
// light. What is blended comes last, over the sky; where nothing is, nothing is done for it. Particles that
// fade in front of surfaces read the depth that is there by then, a copy of it.
//
//   shadow map (depth)  ->  light (RGBA16F, several samples)  ->  resolved light  ->  picture (RGBA8, sRGB)
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compile/plan.h"
#include "core/image.h"
#include "gpu/context.h"
#include "gpu/framebuffer.h"
#include "gpu/pass_timers.h"
#include "render/drawn_groups.h"
#include "render/lighting.h"
#include "render/occlusion.h"
#include "render/surface_drawer.h"
#include "render/view.h"
#include "render/water_light.h"
#include "simulate/state_view.h"

namespace shoal {

// The parts that a picture may do without, to be drawn sooner.
struct Quality {
    int samples = 4;        // a pixel; reduced to what the context has
    bool shadows = true;    // of the sun, but those of what stands still on far ground
    bool occlusion = true;  // of the sky by what stands near in the picture
    bool operator==(const Quality&) const = default;
};

struct RenderOptions {
    int width = 1280, height = 720;  // pixels
    Quality quality = {};
    int shadowSize = 2048;  // texels a side, at most
    gpu::PassTimers::Mode timing = gpu::PassTimers::Mode::off;
    int slabs = 128;    // of depth, where several groups are blended; 1 to 1024
    bool grid = false;  // a metre grid on planes; on anyway in scenes without a model
    // No sky behind: the picture's alpha is what of a pixel is covered, and its colour is not multiplied by
    // it (straight alpha).
    bool clear = false;
    bool layers = false;  // Renderer::layers() will be asked for
};

// What a compositor takes of a picture. Rows from the top, a value or four a pixel.
struct PictureLayers {
    int width = 0, height = 0;
    std::vector<float> color;  // linear RGB times exposure and alpha, and alpha
    std::vector<float> depth;  // m, along the view, of what is not blended; `nothingThere` behind all
    // The share of a pixel in which a group is seen, in [0, 1], of each group by its name.
    std::vector<std::pair<std::string, std::vector<float>>> masks;

    static constexpr float nothingThere = 1e10f;
};

// Draws among the molecules to show how they work; part of the picture, with its depth.
class Overlay {
  public:
    virtual ~Overlay() = default;
    virtual void draw(const StateView& state, const DrawInputs& inputs) = 0;
};

class Renderer {
  public:
    // `plan` with its packed start state. Error: an image of a material is missing or not a PNG.
    Renderer(gpu::Context& context, const Scene& scene, const Plan& plan, const RenderOptions& options = {});

    // Error: larger than the context allows.
    void resize(int width, int height);
    void setQuality(const Quality& quality);
    int width() const { return picture_.width(); }
    int height() const { return picture_.height(); }

    // Into the renderer's own picture; nothing of OpenGL's state is kept from before nor restored afterwards,
    // except that blending, depth and face culling are off at the end.
    void draw(const StateView& state, const View& view, Overlay* overlay = nullptr);
    const gpu::Texture& picture() const { return picture_; }  // the last one
    // The last picture into another framebuffer of the context.
    void present(int width, int height, unsigned framebuffer) const {
        pictureTarget_.blitTo(framebuffer, width, height);
    }
    // The last picture, RGBA, rows from the top. Counted as parameters that are read back.
    Image capture() const;

    // Of the last picture, drawn of these. Needs RenderOptions::layers.
    PictureLayers layers(const StateView& state, const View& view);

    // Other looks for a group of particles of the plan, from the next picture on. False, and nothing changes:
    // they need another renderer.
    bool changeParticle(size_t group, const ParticleType& type) {
        return groups_.changeParticle(group, type, lighting_);
    }

    // Another colour, roughness, translucency, opacity or growth for a group of molecules, likewise.
    bool changeLooks(size_t group, const Group& looks) { return groups_.changeLooks(group, looks); }

    // Draws these instead of the scene's.
    void changeColliders(const std::vector<Collider>& colliders);

    gpu::PassTimers& timers() { return timers_; }
    // How many points and triangles of molecules the last picture has; waits for it.
    uint64_t drawnPrimitives() const { return primitives_.last(); }
    // In which a blended group of the plan was last drawn; null: it has none. For tests.
    const DrawOrder* orderOf(size_t group) const { return groups_.orderOf(group); }
    const gpu::Framebuffer& target() const { return pictureTarget_; }

  private:
    Renderer(gpu::Context& context, const Scene& scene, const Plan& plan, const RenderOptions& options,
             const SceneBounds& bounds);
    void makeTargets(int width, int height);
    void drawShadows(const StateView& state, double time);
    void drawStillShadows();
    void drawClouds(const Scene& scene);
    void drawSky(const Eye& eye);
    void drawBlended(const StateView& state, const DrawInputs& inputs, double time);
    void clearGround();
    void drawPicture(const gpu::Program& tone, const Eye& eye, double exposure);

    gpu::Context* context_;
    RenderOptions options_;
    std::unique_ptr<Shadows> shadows_;   // null: the sun casts none
    std::unique_ptr<WaterLight> water_;  // null: all is in the air
    Lighting lighting_;
    SurfaceDrawer surfaces_;
    DrawnGroups groups_;
    WaterBeams beams_;  // none without water
    AmbientOcclusion occlusion_;
    gpu::Program sky_, tone_;
    gpu::Program covered_, linear_;  // none unless the ground is clear, and without layers
    gpu::Texture clouds_;            // none: a clear sky
    gpu::PassTimers timers_;
    gpu::PrimitiveCounter primitives_;
    gpu::Framebuffer samples_;  // light
    gpu::Texture light_, picture_;
    gpu::Framebuffer lightTarget_, pictureTarget_;
    gpu::Texture linearPicture_;  // none without layers
    gpu::Framebuffer linearTarget_;
    // Depth of what is not blended, one sample a pixel; none where nothing fades in front of surfaces,
    // no beams end there, no place is darker because of others, and nothing refracts.
    gpu::Texture sceneDepth_;
    gpu::Framebuffer sceneDepthTarget_;
};

}  // namespace shoal
