#include "render/water_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/lighting.h"

namespace shoal {

namespace {

constexpr int texels = 512;      // of a tile's side
constexpr int cells = 176;       // of the grid along a side, margins included
constexpr double margin = 0.15;  // tiles
constexpr int meshes = 8;        // along a tile

// Whole waves along a tile's sides: about `meshes` of them, every way, so that they make a net. More go with
// the wind (+x) than against it, or the net would stand.
constexpr std::array<glm::ivec2, WaterLight::waveCount> wholeWaves = {{{7, 1},
                                                                       {6, 5},
                                                                       {2, 8},
                                                                       {-3, 7},
                                                                       {5, -6},
                                                                       {9, -2},
                                                                       {-6, -4},
                                                                       {-7, 3},
                                                                       {1, -9},
                                                                       {4, 3},
                                                                       {11, 4},
                                                                       {-2, -5},
                                                                       {3, -4},
                                                                       {8, 9}}};

constexpr double focus = 0.5;  // of each wave: its share in how strongly the surface gathers light

// Deep water: the speed goes with the root of the wavelength. rad/s.
double frequencyOf(const glm::dvec2& whole, const Water& water) {
    const double shortest = 2 * std::numbers::pi / (meshes * water.causticsSize);
    return shortest * water.causticsSpeed * std::sqrt(meshes * glm::length(whole));
}

}  // namespace

WaterLight::WaterLight(gpu::Context& context, const Water& water)
    : water_(water),
      program_(context, {"water/caustics.vert",
                         "water/caustics.frag",
                         {concat("CELLS ", cells), concat("MARGIN ", margin), concat("TEXELS ", texels)},
                         {},
                         "caustics"}),
      grid_(context, "caustics"),
      caustics_(context, gpu::Format::r32f, texels, texels, "caustics"),
      target_(context, {&caustics_}, nullptr, "caustics") {
    std::vector<uint32_t> indices;
    for (uint32_t y = 0; y < cells; ++y)
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t corner = y * (cells + 1) + x, above = corner + cells + 1;
            indices.insert(indices.end(), {corner, corner + 1, above + 1, corner, above + 1, above});
        }
    indices_ = gpu::Buffer(context, gpu::Buffer::Use::index, std::span<const uint32_t>(indices), "caustics");
    grid_.indices(indices_);
}

double WaterLight::tile() const {
    return meshes * water_.causticsSize;
}

void WaterLight::draw(double time) {
    target_.bind();
    glDisable(GL_DEPTH_TEST);
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    program_.use();
    applyWaves(program_, time);
    grid_.bind();
    gpu::beginPass();
    glDrawElements(GL_TRIANGLES, 6 * cells * cells, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_BLEND);
    caustics_.setLinear(true, true);
}

void WaterLight::applyWaves(const gpu::Program& program, double time) const {
    std::array<glm::vec4, waveCount> waves{};
    for (size_t i = 0; i < waves.size(); ++i) {
        const glm::dvec2 whole(wholeWaves[i]);
        constexpr double turn = 2 * std::numbers::pi;
        // The golden angle sets their phases apart at time 0.
        const double turns =
            std::fmod((2.3999632 * double(i * i) - frequencyOf(whole, water_) * time) / turn, 1);
        waves[i] = glm::vec4(glm::vec2(whole), float(focus / (turn * glm::dot(whole, whole))), float(turns));
    }
    program.set("waves", std::span<const glm::vec4>(waves));
}

void WaterLight::applyMedium(const gpu::Program& program, const Eye& eye) const {
    const glm::dvec2 place = glm::dvec2(eye.origin.exact.x, eye.origin.exact.z) / tile();
    program.set("eyeDepth", float(water_.surface - eye.origin.exact.y));
    program.set("waterExtinction", glm::vec3(water_.extinction));
    program.set("waterScattering", glm::vec3(water_.scattering));
    program.set("causticsAt",
                glm::vec4(float(water_.caustics), float(1 / tile()), glm::vec2(place - glm::floor(place))));
    program.set("causticsDepth", float(1.5 * water_.causticsSize));
    program.texture("caustics", caustics_);
}

// ---- Beams

static constexpr int smaller = 4;                // than the picture, along a side
static constexpr double longest = 60;            // m
static constexpr double leastExtinction = 0.02;  // 1/m: what is clearer sends beams no further than this

WaterBeams::WaterBeams(gpu::Context& context, const WaterLight* water)
    : context_(&context), water_(water != nullptr && water->water().rays > 0 ? water : nullptr) {
    if (!water_) return;
    program_ = gpu::Program(context, {"render/screen.vert", "render/beams.frag", {}, {}, "beams"});
}

void WaterBeams::resize(int width, int height) {
    if (!water_) return;
    light_ = gpu::Texture(*context_, gpu::Format::rgba16f, std::max(1, width / smaller),
                          std::max(1, height / smaller), "beams");
    light_.setLinear();
    target_ = gpu::Framebuffer(*context_, {&light_}, nullptr, "beams");
}

void WaterBeams::draw(const Eye& eye, const Lighting& lighting, const gpu::Texture& sceneDepth) const {
    target_.bind();
    program_.use();
    lighting.applyBeams(program_, eye);
    program_.texture("sceneDepth", sceneDepth);
    program_.set("viewToScene", eye.viewToScene);
    program_.set("tangents", eye.tangents);
    program_.set("nearest", eye.nearest);
    program_.set("strength", float(water_->water().rays));
    const glm::dvec3 k = glm::max(water_->water().extinction, glm::dvec3(leastExtinction));
    program_.set("reach", float(std::min(longest, 1.5 / std::min({k.x, k.y, k.z}))));
    gpu::drawVertices(3);
}

}  // namespace shoal
