#include "render/occlusion.h"

#include <algorithm>

#include "gpu/gl.h"
#include "gpu/shader_source.h"
#include "render/lighting.h"

namespace shoal {

static constexpr double reachByHeight = 0.12;  // of the picture

static double luminance(const glm::dvec3& color) {
    return glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
}

AmbientOcclusion::AmbientOcclusion(gpu::Context& context, const Scene& scene)
    : context_(&context), gathers_(gatherDefines(context.info())), strength_(float(scene.sky.occlusion)) {
    if (!*this) return;
    const Sky& sky = scene.sky;
    ambient_ = float(sky.intensity * luminance(sky.zenith + sky.horizon + sky.ground) / 3);
    // As far as it reaches where the camera of the scene looks: what lies behind is not darkened by what is
    // metres away.
    const double distance = std::max(glm::distance(scene.camera.eye, scene.camera.target), 1e-3);
    farthest_ = float(2 * reachByHeight * 2 * std::tan(scene.camera.fieldOfView / 2) * distance);
    find_ = gpu::Program(context, {"render/screen.vert", "render/occlusion.frag", gathers_, {}, "occlusion"});
    blur_ = gpu::Program(
        context, {"render/screen.vert", "render/occlusion_smooth.frag", gathers_, {}, "occlusion, smoothed"});
}

std::vector<std::string> AmbientOcclusion::defines() const {
    std::vector<std::string> out = gathers_;
    out.push_back(gpu::constant("OCCLUSION", bool(*this)));
    return out;
}

void AmbientOcclusion::resize(int width, int height) {
    if (!*this) return;
    const int w = std::max(1, (width + 1) / 2), h = std::max(1, (height + 1) / 2);
    rough_ = gpu::Texture(*context_, gpu::Format::r32f, w, h, "occlusion");
    smooth_ = gpu::Texture(*context_, gpu::Format::r32f, w, h, "occlusion, smoothed");
    roughTarget_ = gpu::Framebuffer(*context_, {&rough_}, nullptr, "occlusion");
    smoothTarget_ = gpu::Framebuffer(*context_, {&smooth_}, nullptr, "occlusion, smoothed");
}

void AmbientOcclusion::draw(const Eye& eye, const gpu::Texture& sceneDepth) {
    glDisable(GL_DEPTH_TEST);
    roughTarget_.bind();
    find_.use();
    find_.texture("sceneDepth", sceneDepth);
    find_.set("nearest", eye.nearest);
    find_.set("tangents", eye.tangents);
    find_.set("reach", glm::vec2(float(reachByHeight), farthest_));
    gpu::drawVertices(3);
    smoothTarget_.bind();
    blur_.use();
    blur_.texture("occlusion", rough_);
    gpu::drawVertices(3);
}

void AmbientOcclusion::apply(const gpu::Program& program, const Eye& eye, const gpu::Texture& sceneDepth,
                             bool drawn) const {
    program.texture("occlusion", smooth_);
    program.texture("sceneDepth", sceneDepth);
    program.set("nearest", eye.nearest);
    program.set("occlusionStrength", drawn ? strength_ : 0);
    program.set("ambientLuminance", ambient_);
}

}  // namespace shoal
