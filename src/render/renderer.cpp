#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/packing.hpp>

#include "core/contract.h"
#include "gpu/gl.h"
#include "gpu/shader_source.h"
#include "render/picture.h"

namespace shoal {

static std::unique_ptr<Shadows> makeShadows(gpu::Context& context, const Scene& scene,
                                            const SceneBounds& bounds, const RenderOptions& options) {
    if (!scene.light.shadows || scene.light.intensity <= 0) return nullptr;
    const int most = std::min(options.shadowSize, context.info().maxTextureSize / 2);  // side by side
    return std::make_unique<Shadows>(context, most, bounds.casters, bounds.models, towardsSun(scene.light));
}

static std::unique_ptr<WaterLight> makeWater(gpu::Context& context, const Scene& scene) {
    if (!scene.water) return nullptr;
    return std::make_unique<WaterLight>(context, *scene.water);
}

static std::vector<std::string> pictureDefines(const Lighting& lighting, const WaterBeams& beams,
                                               const AmbientOcclusion& occlusion, bool clear, bool linear) {
    std::vector<std::string> out = occlusion.defines();
    for (const std::string& define : lighting.toneDefines())
        out.push_back(define);
    out.insert(out.end(), {gpu::constant("CLEAR", clear), gpu::constant("LINEAR", linear),
                           gpu::constant("BEAMS", bool(beams))});
    return out;
}

static std::vector<std::string> skyDefines(const Lighting& lighting, const Sky& sky) {
    std::vector<std::string> out = lighting.defines();
    out.push_back(gpu::constant("CLOUDS", sky.clouds > 0));
    return out;
}

// Returns the pixels per metre at the camera's target, in a picture `height` rows high.
static double pixelsPerMeterAt(const Camera& camera, int height) {
    const double distance = std::max(glm::distance(camera.eye, camera.target), 1e-3);
    return height / (2 * std::tan(camera.fieldOfView / 2) * distance);
}

Renderer::Renderer(gpu::Context& context, const Scene& scene, const Plan& plan, const RenderOptions& options)
    : Renderer(context, scene, plan, options, boundsOf(scene, plan)) {}

Renderer::Renderer(gpu::Context& context, const Scene& scene, const Plan& plan, const RenderOptions& options,
                   const SceneBounds& bounds)
    : context_(&context),
      options_(options),
      shadows_(makeShadows(context, scene, bounds, options)),
      water_(makeWater(context, scene)),
      lighting_(context.info(), scene, bounds.crown, shadows_.get(), water_.get(),
                DrawnGroups::blends(scene, plan) || SurfaceDrawer::blends(scene), options.quality.samples),
      surfaces_(context, scene, lighting_, shadows_ != nullptr, options.grid || scene.models.empty()),
      groups_(context, scene, plan, lighting_, options.slabs, pixelsPerMeterAt(scene.camera, options.height)),
      beams_(context, water_.get()),
      occlusion_(context, scene),
      sky_(context, {"render/screen.vert", "render/sky.frag", skyDefines(lighting_, scene.sky), {}, "sky"}),
      tone_(context, {"render/screen.vert",
                      "render/picture.frag",
                      pictureDefines(lighting_, beams_, occlusion_, options.clear, false),
                      {},
                      "picture"}),
      timers_(context, options.timing) {
    if (options.clear)
        covered_ = gpu::Program(context, {"render/screen.vert", "render/covered.frag", {}, {}, "covered"});
    if (options.layers)
        linear_ = gpu::Program(context, {"render/screen.vert",
                                         "render/picture.frag",
                                         pictureDefines(lighting_, beams_, occlusion_, options.clear, true),
                                         {},
                                         "linear picture"});
    resize(options.width, options.height);
    if (scene.sky.clouds > 0) drawClouds(scene);
    drawStillShadows();
}

void Renderer::changeColliders(const std::vector<Collider>& colliders) {
    surfaces_.changeColliders(*context_, colliders, lighting_);
    drawStillShadows();
}

void Renderer::drawStillShadows() {
    if (!shadows_) return;
    shadows_->drawStill(surfaces_.castsStill(),
                        [&](const ShadowMap& map) { surfaces_.drawShadows(map, {}); });
}

void Renderer::resize(int width, int height) {
    if (!picture_ || width != picture_.width() || height != picture_.height()) makeTargets(width, height);
}

void Renderer::setQuality(const Quality& quality) {
    if (quality == options_.quality) return;
    const Quality before = std::exchange(options_.quality, quality);
    if (quality.samples != before.samples) makeTargets(width(), height());
    if (shadows_ && !quality.shadows) shadows_->clear();
}

void Renderer::makeTargets(int width, int height) {
    using gpu::Format;
    samples_ = gpu::Framebuffer::multisampled(*context_, Format::rgba16f, true, options_.quality.samples,
                                              width, height, "light, sampled");
    light_ = gpu::Texture(*context_, Format::rgba16f, width, height, "light");
    picture_ = gpu::Texture(*context_, Format::rgba8, width, height, "picture");
    lightTarget_ = gpu::Framebuffer(*context_, {&light_}, nullptr, "light");
    pictureTarget_ = gpu::Framebuffer(*context_, {&picture_}, nullptr, "picture");
    beams_.resize(width, height);
    occlusion_.resize(width, height);
    light_.setLinear();
    if (options_.layers) {
        linearPicture_ = gpu::Texture(*context_, Format::rgba32f, width, height, "linear picture");
        linearTarget_ = gpu::Framebuffer(*context_, {&linearPicture_}, nullptr, "linear picture");
    }
    if (!options_.layers && !groups_.readsDepth() && !beams_ && !occlusion_ && !surfaces_.refracts()) return;
    sceneDepth_ = gpu::Texture(*context_, Format::depth24, width, height, "scene depth");
    sceneDepthTarget_ = gpu::Framebuffer(*context_, {}, &sceneDepth_, "scene depth");
}

void Renderer::draw(const StateView& state, const View& view, Overlay* overlay) {
    const Eye eye(view, width(), height());
    const DrawInputs inputs{eye, lighting_, sceneDepth_ ? &sceneDepth_ : nullptr, samples_.samples() > 1};
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LEQUAL);

    const gpu::TimedFrame frame(timers_);
    if (groups_.orders()) {
        const auto timer = timers_.time("order");
        groups_.order(state, eye);
    }
    if (shadows_ && options_.quality.shadows) drawShadows(state, view.time);
    if (water_) {
        const auto timer = timers_.time("caustics");
        water_->draw(view.time);
    }
    samples_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    if (options_.clear) glClearColor(0, 0, 0, 0);
    glClear(options_.clear ? GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT : GL_DEPTH_BUFFER_BIT);
    {
        const auto timer = timers_.time("surfaces");
        surfaces_.draw(eye, lighting_, view.time, inputs.multisampled);
    }
    {
        const auto timer = timers_.time("molecules");
        primitives_.count([&] { groups_.draw(state, inputs); });
    }
    if (overlay) {
        const auto timer = timers_.time("overlay");
        overlay->draw(state, inputs);
    }
    if (options_.clear)
        clearGround();
    else
        drawSky(eye);
    if (sceneDepth_) {
        const auto timer = timers_.time("depth");
        samples_.blitDepthTo(sceneDepthTarget_);
        samples_.bind();
    }
    if (groups_.blends() || surfaces_.blends()) drawBlended(state, inputs, view.time);
    {
        const auto timer = timers_.time("resolve");
        samples_.blitTo(lightTarget_);
    }
    if (beams_) {
        const auto timer = timers_.time("beams");
        beams_.draw(eye, lighting_, sceneDepth_);
    }
    if (occlusion_ && options_.quality.occlusion) {
        const auto timer = timers_.time("occlusion");
        occlusion_.draw(eye, sceneDepth_);
    }
    pictureTarget_.bind();
    drawPicture(tone_, eye, view.exposure);
}

void Renderer::drawShadows(const StateView& state, double time) {
    const auto timer = timers_.time("shadows");
    shadows_->drawMoving([&](const ShadowMap& map) {
        surfaces_.drawShadows(map, time);
        groups_.drawShadows(state, map, time);
    });
}

void Renderer::drawClouds(const Scene& scene) {
    constexpr int size = 1536;  // texels a side
    clouds_ = gpu::Texture(*context_, gpu::Format::rgba16f, size, size, "clouds");
    clouds_.setLinear();
    const gpu::Framebuffer target(*context_, {&clouds_}, nullptr, "clouds");
    const gpu::Program program(*context_, {"render/screen.vert", "render/clouds.frag", {}, {}, "clouds"});
    target.bind();
    program.use();
    program.set("share", float(scene.sky.clouds));
    program.set("sunDirection", glm::vec3(towardsSun(scene.light)));
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    gpu::drawVertices(3);
}

// Last, at the far plane: only where nothing else was drawn.
void Renderer::drawSky(const Eye& eye) {
    const auto timer = timers_.time("sky");
    sky_.use();
    lighting_.applySky(sky_, eye);
    sky_.set("viewToScene", eye.viewToScene);
    sky_.set("tangents", eye.tangents);
    if (clouds_) sky_.texture("clouds", clouds_);
    glDepthMask(GL_FALSE);
    gpu::drawVertices(3);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

void Renderer::drawBlended(const StateView& state, const DrawInputs& inputs, double time) {
    const auto timer = timers_.time("blended");
    if (surfaces_.refracts()) {
        samples_.blitTo(lightTarget_);
        samples_.bind();
    }
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    if (surfaces_.blends()) surfaces_.drawBlended(inputs.eye, lighting_, time, {&light_, &sceneDepth_});
    groups_.drawBlended(state, inputs);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

// Sets the alpha of what has been drawn to 1, and of all else to 0, whatever shaders have written.
void Renderer::clearGround() {
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
    glClear(GL_COLOR_BUFFER_BIT);
    covered_.use();
    glDepthFunc(GL_GREATER);  // the far plane lies behind
    gpu::drawVertices(3);
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

// Into the framebuffer that is bound.
void Renderer::drawPicture(const gpu::Program& tone, const Eye& eye, double exposure) {
    const auto timer = timers_.time("picture");
    tone.use();
    tone.texture("light", light_);
    if (beams_) tone.texture("beams", beams_.light());
    if (occlusion_) occlusion_.apply(tone, eye, sceneDepth_, options_.quality.occlusion);
    tone.set("exposure", float(exposure));
    gpu::drawVertices(3);
}

namespace {

// Rows from the bottom, `each` values a pixel.
template <typename Value>
std::vector<Value> readBack(const gpu::Texture& texture, size_t each) {
    std::vector<Value> out(size_t(texture.width()) * size_t(texture.height()) * each);
    texture.download(gpu::Traffic::Kind::parameters, 0, 0, texture.width(), texture.height(), out.data(),
                     out.size() * sizeof(Value));
    return out;
}

std::vector<float> turnedOver(const std::vector<float>& rows, size_t width) {
    std::vector<float> out;
    out.reserve(rows.size());
    for (size_t end = rows.size(); end > 0; end -= width)
        out.insert(out.end(), rows.begin() + std::ptrdiff_t(end - width), rows.begin() + std::ptrdiff_t(end));
    return out;
}

}  // namespace

// The depth of the last picture is still there: a group is drawn again into alpha alone.
PictureLayers Renderer::layers(const StateView& state, const View& view) {
    EXPECTS(options_.layers);
    const Eye eye(view, width(), height());
    const DrawInputs inputs{eye, lighting_, &sceneDepth_, samples_.samples() > 1};
    const auto columns = size_t(width());
    PictureLayers out{width(), height(), {}, {}, {}};
    linearTarget_.bind();
    drawPicture(linear_, eye, view.exposure);
    out.color = turnedOver(readBack<float>(linearPicture_, 4), 4 * columns);
    std::vector<float> depth;
    for (const uint32_t stored : readBack<uint32_t>(sceneDepth_, 1)) {
        const double share = 1 - double(stored) / 4294967295.0;
        depth.push_back(share > 0 ? float(eye.nearest / share) : PictureLayers::nothingThere);
    }
    out.depth = turnedOver(depth, columns);
    for (size_t i = 0; i < groups_.count(); ++i) {
        samples_.bind();
        glClearColor(0, 0, 0, 0);
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
        glClear(GL_COLOR_BUFFER_BIT);
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        groups_.drawCover(i, state, inputs);
        glDepthMask(GL_TRUE);
        glDisable(GL_DEPTH_TEST);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        samples_.blitTo(lightTarget_);
        std::vector<float> mask;
        const std::vector<uint64_t> texels = readBack<uint64_t>(light_, 1);
        for (const uint64_t texel : texels)
            mask.push_back(std::clamp(glm::unpackHalf1x16(uint16_t(texel >> 48)), 0.0f, 1.0f));
        out.masks.emplace_back(groups_.nameOf(i), turnedOver(mask, columns));
    }
    return out;
}

Image Renderer::capture() const {
    Image image{width(), height(), 4, std::vector<uint8_t>(picture_.bytes())};
    picture_.download(gpu::Traffic::Kind::parameters, 0, 0, width(), height(), image.pixels.data(),
                      image.pixels.size());
    turnOver(image);
    return image;
}

}  // namespace shoal
