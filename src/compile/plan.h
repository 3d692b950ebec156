// The plan: a scene turned into what the GPU needs and nothing more. Made by pure functions, read by
// `simulate` and `render`, printed by `shoal explain`.
//
// State layout (shared by all groups; one texel = one vertex, RGBA32F):
//
//   a state texture is 1024 texels wide; group g owns the rows [firstRow, firstRow + vertexCount * slabRows)
//   vertex v of molecule m:   x = m mod 1024,  y = firstRow + v * slabRows + m / 1024
//   so vertex v of all molecules is a slab of whole rows, and neighbouring texels are neighbouring molecules
//
//   position       xyz relative to the molecule's anchor, m      (two sides, ping-pong)
//   velocity       xyz m/s                                       (two sides)
//   acceleration   xyz of the springs, m/s^2: leapfrog only      (two sides)
//   normal         xyz unit
//
// Record layout: molecule m of group g at x = m mod 1024, y = firstRecordRow + m / 1024
//   dynamic        xyz anchor, m; w flags: 1 = pins released     (two sides)
//   constant       x seed (an integer below 2^24), y scale, z actuation phase offset (rad), w unused
//
// Topology: one texture of 4-vectors, read by index i at (i mod 1024, i / 1024); per group from `base`:
//   base + v                       first spring entry, springs, first triangle entry, triangles around v
//   base + vertexCount + v         1/mass (1/kg), pinned (0 or 1), mass (kg), unused
//   spring entries, two texels     other vertex, stiffness, damping, rest length
//                                  amplitude, 2 pi frequency, phase, unused
//   triangle entries, one texel    the other two corners, anticlockwise after v
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace shoal {

// What of the physics a group needs. Every pass, buffer and shader branch hangs on one of these.
struct Needs {
    bool fields = false;  // there is a field and the group has drag
    bool drag = false;
    bool directionalDrag = false;
    bool gravity = false;
    bool springs = false;
    bool springDamping = false;
    bool actuation = false;
    bool pins = false;     // some vertex is held at the start
    bool release = false;  // and may be let go
    bool records = false;  // anchors move or pins are released: the records pass runs
    bool collide = false;
    bool normals = false;       // the shape has triangles
    bool acceleration = false;  // the solver keeps the springs' acceleration
};

constexpr int stateWidth = 1024;

struct GroupPlan {
    std::string name;
    size_t index = 0;  // in scene.groups
    int count = 0, vertexCount = 0;
    int slabRows = 0;            // rows of one vertex slab
    int firstRow = 0, rows = 0;  // in the state textures
    int firstRecordRow = 0;      // in the record textures; slabRows of them
    int topologyBase = 0;
    Needs needs;
    SolverKind solver = SolverKind::leapfrog;
    Drag drag;
    Release release;
    double stiffness = 1, damping = 1;
    double size = 1;              // m, of the molecule
    double highestFrequency = 0;  // rad/s, of the molecule as held, with the group's stiffness
    double stableStep = 0;        // s, largest substep of the solver; infinite without springs
};

enum class PassKind { records, normals, restore, advect, collide };
const char* name(PassKind kind);

struct PassPlan {
    PassKind kind;
    size_t group = 0;
    enum class When { frameStart, substep, frameEnd } when = When::substep;
    std::string why;
};

struct Plan {
    std::string sceneName;
    double frameRate = 60;
    int substeps = 4;
    glm::dvec3 gravity{0};
    SolverKind solver = SolverKind::leapfrog;
    std::vector<GroupPlan> groups;
    std::vector<PassPlan> passes;  // in the order of a frame; substep passes repeat

    // Packed start state; sizes: rows * 1024 texels.
    int rows = 0, recordRows = 0;
    std::vector<glm::vec4> positions, velocities;
    std::vector<glm::vec4> records, constants;
    std::vector<glm::vec4> topology;
    int topologyRows = 0;

    // Fields and colliders become straight-line GLSL that reads its numbers from uniform arrays, so that
    // changing a number never compiles. Samples (grids, height fields) share one texture of 4-vectors, read
    // by index like the topology.
    std::string fieldSource;    // generated/fields.glsl
    std::string collideSource;  // generated/colliders.glsl
    std::vector<glm::vec4> fieldParameters, colliderParameters;
    std::vector<glm::vec4> samples;
    int sampleRows = 0;

    std::vector<Warning> warnings;

    size_t stateBytes() const;  // all sides of the state and record textures
    size_t tableBytes() const;  // topology and samples
};

// Limits of the context that runs the plan; the defaults are what OpenGL 3.3 promises nearly everywhere.
struct PlanLimits {
    int maxTextureSize = 16384;
};

// Error: the state (located at the group), or a table, does not fit, and how much it would take; fields or
// colliders take more uniforms than OpenGL 3.3 promises; or the substep is beyond what the explicit solver
// holds stable (located at the solver, else at the group), and how many substeps would do.
Plan compile(const Scene& scene, const PlanLimits& limits = {});

// How many substeps of a frame the solver needs when stiffness and damping are scaled by these factors; at
// least `substeps`.
int substepsNeeded(const Plan& plan, double frameTime, double stiffnessFactor, double dampingFactor,
                   int substeps);

// For people: groups, passes and why each is there, memory.
std::string explain(const Plan& plan);
// For programs.
class JsonValue;
JsonValue explainJson(const Plan& plan);

}  // namespace shoal
