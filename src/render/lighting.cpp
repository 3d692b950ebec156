#include "render/lighting.h"

#include <algorithm>

#include "gpu/shader_source.h"
#include "render/water_light.h"

namespace shoal {

Lighting::Lighting(const gpu::ContextInfo& info, const Scene& scene, const BoundingSphere& crown,
                   const Shadows* shadows, const WaterLight* water, bool blends, int samples)
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
    out.push_back(gpu::constant("SHADOWS", shadows_ != nullptr));
    out.push_back(gpu::constant("WIDE_SHADOWS", shadows_ && shadows_->wide()));
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
    if (shadows_) shadows_->apply(program, eye);
}

}  // namespace shoal
