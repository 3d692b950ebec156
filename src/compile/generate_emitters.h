// Emitters as GLSL: shaders/births/spawn.glsl calls emitFrom. What sliders and paths move is in a uniform
// array; kinds, and the tables of surfaces, are in the text.
#pragma once

#include <string>
#include <vector>

#include "compile/kernel.h"
#include "compile/life_plan.h"
#include "scene/scene.h"

namespace shoal {

// void emitFrom(int emitter, uint seed, float time, Source source, out Start start), with the structures of
// shaders/births/spawn.glsl. Surfaces put their triangles into the samples. `layouts`: how the group of
// each emitter's source is stored; of others anything.
std::string generateEmitters(const Scene& scene, const Lifecycle& life,
                             const std::vector<BufferLayout>& layouts, std::vector<glm::vec4>& samples);

// The uniform array, with emitters that move as they are in the middle of a frame from `time` of `duration`
// (s).
std::vector<glm::vec4> emitterParameters(const Lifecycle& life, const std::vector<glm::dvec3>& middles,
                                         double time, double duration);

// m, of each emitter, without its path.
std::vector<glm::dvec3> emitterMiddles(const Scene& scene, const Lifecycle& life);

// Whether one can become the other by its parameters alone, without another text.
bool sameText(const Emitter& a, const Emitter& b);

}  // namespace shoal
