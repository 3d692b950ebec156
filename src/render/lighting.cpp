#include "render/lighting.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/shader_source.h"
#include "render/water_light.h"

namespace shoal {

glm::dvec3 towardsSun(const Light& light) {
    const double length = glm::length(light.direction);
    return length > 0 ? -light.direction / length : glm::dvec3(0, 1, 0);
}

Lighting::Lighting(const gpu::ContextInfo& info, const Scene& scene, const BoundingSphere& crown,
                   const Shadows& shadows, const WaterLight* water, bool blends, int samples)
    : towardsSun_(shoal::towardsSun(scene.light)),
      sun_(scene.light.color * scene.light.intensity),
      zenith_(scene.sky.zenith * scene.sky.intensity),
      horizon_(scene.sky.horizon * scene.sky.intensity),
      ground_(scene.sky.ground * scene.sky.intensity),
      fog_(float(scene.sky.fog)),
      crown_(crown),
      shadows_(shadows),
      water_(water),
      blends_(blends),
      gathers_(gatherDefines(info)),
      lateDepth_(info.software && info.stencilExport && std::min(samples, info.maxSamples) > 1) {}

std::vector<std::string> gatherDefines(const gpu::ContextInfo& info) {
    if (!info.shadowGather) return {};
    return {gpu::requireExtension("GL_ARB_gpu_shader5"), "GATHERS"};
}

std::vector<std::string> Lighting::defines() const {
    std::vector<std::string> out = toneDefines();
    out.push_back(gpu::constant("SHADOWS", shadows_.near != nullptr));
    out.push_back(gpu::constant("WIDE_SHADOWS", shadows_.wide != nullptr));
    if (water_ != nullptr) out.emplace_back("WATER");
    out.insert(out.end(), gathers_.begin(), gathers_.end());
    if (lateDepth_)
        out.insert(out.end(), {gpu::requireExtension("GL_ARB_shader_stencil_export"), "LATE_DEPTH"});
    return out;
}

std::vector<std::string> Lighting::toneDefines() const {
    return {gpu::constant("LINEAR_LIGHT", blends_)};
}

void Lighting::applySun(const gpu::Program& program) const {
    program.set("sunDirection", towardsSun_);
    program.set("sunColor", sun_);
    program.set("skyZenith", zenith_);
    program.set("skyHorizon", horizon_);
    program.set("skyGround", ground_);
    program.set("ambientAbove", glm::mix(horizon_, zenith_, 0.55f));
    program.set("ambientBelow", ground_ * (0.35f + 0.3f * std::max(towardsSun_.y, 0.0f) * sun_));
}

void Lighting::applyMedium(const gpu::Program& program, const Eye& eye) const {
    program.set("fogDensity", fog_);
    if (water_ != nullptr) water_->applyMedium(program, eye);
}

void Lighting::applySky(const gpu::Program& program, const Eye& eye) const {
    applySun(program);
    if (water_ == nullptr) return;
    applyMedium(program, eye);
    water_->applyWaves(program, double(eye.time));
}

void Lighting::applyBeams(const gpu::Program& program, const Eye& eye) const {
    applySun(program);
    applyMedium(program, eye);
}

void Lighting::apply(const gpu::Program& program, const Eye& eye) const {
    applyBeams(program, eye);
    program.set("crown", glm::vec4(glm::vec3(crown_.center - eye.origin.exact), float(crown_.radius)));
    if (shadows_.near == nullptr) return;
    program.texture("shadowMap", shadows_.near->depth());
    program.set("toShadow", shadows_.near->toTexture(eye.origin));
    program.set("shadowOffsets", shadows_.near->offsets());
    if (shadows_.wide == nullptr) return;
    program.texture("wideShadowMap", shadows_.wide->depth());
    program.set("toWideShadow", shadows_.wide->toTexture(eye.origin));
    program.set("wideShadowOffsets", shadows_.wide->offsets());
}

// ---- The shadow map

// The sun is not a point, but half a degree wide: an edge as far away as the map reaches is blurred by 4
// thousandths of that, one a few metres up by centimetres.
static double blurOf(double reach, double texel) {
    return std::clamp(std::min(0.004 * reach, 0.02), 2 * texel, 5 * texel);
}

ShadowMap::ShadowMap(gpu::Context& context, int most, const Box& casters, const glm::dvec3& towardsSun)
    : origin_(0.5 * (casters.low + casters.high)) {
    const glm::dvec3 side = std::abs(towardsSun.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(side, towardsSun));
    const glm::dvec3 above = glm::cross(towardsSun, right);
    const glm::dmat3 toScene(right, above, towardsSun), toLight = glm::transpose(toScene);
    toScene_ = glm::mat3(toScene);

    // The box seen from the sun, and some air around it for what the wind carries off.
    glm::dvec3 half(0);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        half =
            glm::max(half, glm::abs(toLight * (glm::mix(casters.low, casters.high, high) - origin_.exact)));
    }
    const double reach = 1.15 * std::max({half.x, half.y, 1e-3}), depth = 1.15 * std::max(half.z, 1e-3);
    toClip_ = glm::mat4(glm::ortho(-reach, reach, -reach, reach, -depth, depth) * glm::dmat4(toLight));

    // The 16 texels of render/light.glsl blur by a standard deviation of 0.91 of them, a disc by half its
    // radius.
    const double blur = blurOf(reach, 2 * reach / most);
    const int size = std::min(most, int(std::lround(2 * reach * 0.91 / (0.5 * blur))));
    depth_ = gpu::Texture(context, gpu::Format::depth24, size, size, "shadow map");
    framebuffer_ = gpu::Framebuffer(context, {}, &depth_, "shadow map");
    depth_.setShadowCompare();
    pixelsPerMeter_ = float(size / (2 * reach));
    blur_ = float(blur);
}

bool ShadowMap::covers(const Box& box) const {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::bvec3 high(corner & 1, corner & 2, corner & 4);
        const glm::dvec4 place(glm::mix(box.low, box.high, high) - origin_.exact, 1);
        const glm::dvec4 clip = glm::dmat4(toClip_) * place;
        if (!(std::max(std::abs(clip.x), std::abs(clip.y)) <= 1)) return false;
    }
    return true;
}

void ShadowMap::begin(const ShadowMap* other) const {
    if (other) other->framebuffer_.blitDepthTo(framebuffer_);
    framebuffer_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    // Casters outside the box towards the sun still cast shadows; those below it count as at its bottom.
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 2);
    if (!other) glClear(GL_DEPTH_BUFFER_BIT);
}

void ShadowMap::end() const {
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
}

glm::mat4 ShadowMap::toTexture(const Origin& eye) const {
    const glm::dmat4 fromEye = glm::translate(glm::dmat4(1), eye.exact - origin_.exact);
    const glm::dmat4 toUnit = glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(0.5));
    return glm::mat4(toUnit * glm::dmat4(toClip_) * fromEye);
}

glm::vec2 ShadowMap::offsets() const {
    return {blur_, 0.5f / pixelsPerMeter_};
}

}  // namespace shoal
