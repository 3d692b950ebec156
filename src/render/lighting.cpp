#include "render/lighting.h"

#include "render/water_light.h"

namespace shoal {

glm::dvec3 towardsSun(const Light& light) {
    const double length = glm::length(light.direction);
    return length > 0 ? -light.direction / length : glm::dvec3(0, 1, 0);
}

Lighting::Lighting(const Scene& scene, const Sphere& crown, const ShadowMap* shadow, const WaterLight* water,
                   bool blends)
    : towardsSun_(shoal::towardsSun(scene.light)),
      sun_(scene.light.color * scene.light.intensity),
      zenith_(scene.sky.zenith * scene.sky.intensity),
      horizon_(scene.sky.horizon * scene.sky.intensity),
      ground_(scene.sky.ground * scene.sky.intensity),
      fog_(float(scene.sky.fog)),
      crown_(crown),
      shadow_(shadow),
      water_(water),
      blends_(blends) {}

std::vector<std::string> Lighting::defines() const {
    std::vector<std::string> out = toneDefines();
    if (shadow_ != nullptr) out.emplace_back("SHADOWS");
    if (water_ != nullptr) out.emplace_back("WATER");
    return out;
}

std::vector<std::string> Lighting::skyDefines() const {
    std::vector<std::string> out = toneDefines();
    if (water_ != nullptr) out.emplace_back("WATER");
    return out;
}

std::vector<std::string> Lighting::toneDefines() const {
    if (!blends_) return {};
    return {"LINEAR_LIGHT"};
}

void Lighting::applySun(const gpu::Program& program) const {
    program.set("sunDirection", towardsSun_);
    program.set("sunColor", sun_);
    program.set("skyZenith", zenith_);
    program.set("skyHorizon", horizon_);
    program.set("skyGround", ground_);
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
    applySun(program);
    applyMedium(program, eye);
    program.set("crown", glm::vec4(glm::vec3(crown_.center - eye.origin.exact), float(crown_.radius)));
    if (shadow_ == nullptr) return;
    program.texture("shadowMap", unit::shadowMap, shadow_->depth());
    program.set("toShadow", shadow_->toTexture(eye.origin));
    program.set("shadowFilter", shadow_->filter());
}

}  // namespace shoal
