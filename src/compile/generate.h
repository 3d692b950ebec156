// Fields and colliders as straight-line GLSL. Numbers that a slider may move live in uniform arrays of
// 4-vectors, so that moving them compiles nothing; kinds, seeds, octaves and the sizes of grids are in the
// text. Grids and height fields put their samples into one shared table.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace shoal {

struct Generated {
    std::string source;
    std::vector<glm::vec4> parameters;
};

// vec3 fluidVelocity(vec3 anchor, vec3 position, float time), m/s, without the wind factor.
Generated generateFields(const std::vector<Field>& fields, std::vector<glm::vec4>& samples);
struct GeneratedColliders : Generated {
    // Of each collider: the parameter whose x is its restitution, y its friction.
    std::vector<size_t> materials;
};

// Contact collideAll(vec3 anchor, vec3 position, vec3 velocity, vec3 gravity, Drift drift), and
// float clearance(vec3 anchor, vec3 position): negative where collideAll would respond.
GeneratedColliders generateColliders(const std::vector<Collider>& colliders, std::vector<glm::vec4>& samples);

// The declaration of a uniform array, and for the fused step (FUSED) its copy in registers:
// loadFieldParameters().
std::string parameterArray(const std::string& name, size_t count);

// A name as part of a comment in the text: whatever could end or continue the line is replaced.
std::string inComment(const std::string& name);

const char* kindName(const FieldShape& shape);
const char* kindName(const ColliderShape& shape);

}  // namespace shoal
