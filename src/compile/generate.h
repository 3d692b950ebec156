// Fields and colliders as straight-line GLSL. Numbers that a slider may move live in uniform arrays of
// 4-vectors, so that moving them compiles nothing; kinds, seeds, octaves and the sizes of grids are in the
// text. Grids and height fields put their samples into one shared table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/clocks.h"
#include "compile/moving_colliders.h"
#include "scene/scene.h"

namespace shoal {

struct Generated {
    std::string source;
    std::vector<glm::vec4> parameters;
};

struct GeneratedFields : Generated {
    std::vector<size_t> weights;    // of each field: the parameter whose w is its weight
    std::vector<ClockSlot> clocks;  // their parameters are renewed every frame
    std::vector<NoiseTile> noiseTiles;
};

// vec3 fluidVelocity(vec3 anchor, vec3 position, float time), m/s, without the wind factor; time: since the
// frame's start.
// `near`: a point amid the molecules, m.
GeneratedFields generateFields(const std::vector<Field>& fields, std::vector<glm::vec4>& samples,
                               const glm::dvec3& near = glm::dvec3(0));
// Describes each grid among the fields, and each tile of noise, in a line for people, with the memory that it
// takes.
std::vector<std::string> describeGrids(const std::vector<Field>& fields,
                                       const std::vector<NoiseTile>& noiseTiles);
// 4-vectors of uniforms that fields, and colliders, may each take: within what OpenGL 3.3 promises a fragment
// shader (1024 components), with room for the passes' own.
constexpr size_t maxParameters = 200;

struct GeneratedColliders : Generated {
    // Holds, for each collider, the index of the parameter whose x is its restitution, y its friction.
    std::vector<size_t> materials;
    std::vector<MovingCollider> moving;  // their parameters are renewed every frame
    std::optional<size_t> fastestSlot;   // setPoses
    size_t turns = 0;                    // of loops, about, for a look at all (compile/collider_table.h)
};

// Whether a vertex has contact with all of them at once: not where there is only one
// plane or height field that stands still.
bool respondTogether(const std::vector<Collider>& colliders);

// float clearance(vec3 anchor, vec3 position, float time): m from the nearest surface, negative inside. For
// one plane or height field that stands still, Contact collideAll(vec3 anchor, vec3 position, vec3 velocity,
// Drift drift), which responds where that is negative, and its parts, vec4 surfaceAt(vec3 anchor, vec3
// position) and Contact answerTo(vec4 surface, vec3 position, vec3 velocity, Drift drift). For all else,
// those of shaders/step/joint_contact.glsl; what uniforms have no room for goes into
// the samples (compile/collider_table.h).
// `near` as above.
GeneratedColliders generateColliders(const std::vector<Collider>& colliders, std::vector<glm::vec4>& samples,
                                     const glm::dvec3& near = glm::dvec3(0));

// The declaration of a uniform array, and for the fused step (FUSED) its copy in registers:
// loadFieldParameters().
std::string parameterArray(const std::string& name, size_t count);

}  // namespace shoal
