// The plan: a scene turned into what the GPU needs and nothing more. Made by pure functions, read by
// `simulate` and `render`, printed by `shoal explain`. A plan knows no context: which path runs it is chosen
// afterwards (compile/path.h), and each path lays out the start state in its own way:
//
//   ping-pong   textures, in rows of 1024 texels        simulate/texture_state.h
//   fused       buffers, in blocks of 16 molecules      simulate/buffer_state.h
//   fragments   layers of textures, a texel a molecule  simulate/layer_state.h
//
// Topology, for the paths that read it from a table: 4-vectors, of all groups; per group from `base`:
//   base + v                       first spring entry, springs, first triangle entry, triangles around v
//   base + vertexCount + v         1/mass (1/kg), pinned (0 or 1), mass (kg), its share of the molecule's
//   base + 2 vertexCount + t       the corners of triangle t
//   spring entries, two texels     other vertex, stiffness, damping, rest length
//                                  amplitude, 2 pi frequency, phase, the number of its frequency; of what
//                                  steers the bend in its place (compile/school_plan.h), and where waves are
//                                  shared (compile/muscle_waves.h) amplitude, number of the wave, 0
//   triangle entries, one texel    the other two corners, anticlockwise after v; which of the three v is
//   base + 2 vertexCount + triangleCount    with bdf2-newton: the table of its matrix (compile/newton.h)
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/block_pattern.h"
#include "compile/contact_plan.h"
#include "compile/generate.h"
#include "compile/generate_forces.h"
#include "compile/group_state.h"
#include "compile/kernel.h"
#include "compile/life_plan.h"
#include "compile/school_plan.h"
#include "scene/scene.h"

namespace shoal {

struct GroupPlan {
    std::string name;
    Location location;  // of the group in the scene file, for messages
    size_t index = 0;   // in scene.groups
    int count = 0;      // places, where some are born or die
    int vertexCount = 0, springCount = 0, triangleCount = 0;
    int skinTriangleCount = 0;  // 0: its own triangles are drawn
    int topologyBase = 0;
    Needs needs;
    SolverKind solver = SolverKind::leapfrog;
    std::string solverWhy;  // for people
    Drag drag;
    Release release;
    double stiffness = 1, damping = 1;
    double phaseSpread = 0;              // rad
    std::vector<double> muscles;         // Hz, their different frequencies (compile/clocks.h)
    double musclePeriod = 0;             // s, of all its muscles; 0: there are none
    double size = 1;                     // m, of the molecule
    double highestFrequency = 0;         // rad/s, of the molecule as held, with the group's stiffness
    double stableStep = 0;               // s, largest substep of the solver; infinite without springs
    std::optional<size_t> fastestForce;  // in Plan::forces: of those by place the one that turns it fastest
    double solidFrequency = 0;  // rad/s, the lowest of a free molecule that springs hold in every way; else 0
    bool rigid = false;         // all its springs are too stiff for the step: contact treats it as a body
    std::vector<bool> pinned;   // a vertex each: held at the start
    std::optional<LifePlan> life;  // needs.life
    GroupState start;
    GroupConstants constants;
    std::vector<glm::vec4> colliderParameters;  // as of Plan::colliders, with the group's restitution and
                                                // friction; or none
    GroupForces forces;
    KernelText kernel;                     // of the fused path
    std::vector<glm::vec4> springNumbers;  // needs.liveSprings: see compile/kernel.h
    std::vector<double> springFrequencies;
    Molecule shape;       // bdf2-corotated only: of its matrix (compile/corotated.h)
    BlockPattern matrix;  // bdf2-newton only (compile/newton.h)

    // Whether nothing of it ever moves.
    bool isStill() const {
        return !needs.release && !needs.life &&
               std::find(pinned.begin(), pinned.end(), false) == pinned.end();
    }
    bool factored() const { return solver == SolverKind::bdf2Corotated; }  // has a matrix
    BufferLayout layout() const { return {vertexCount, shoal::solver(solver).history, needs.life}; }
};

float largestScale(const GroupPlan& group);  // of the rest lengths

struct Plan {
    std::string sceneName;
    double frameRate = 60;
    int frames = 0;  // that a run asks for, for chooseLanes(); 0: not known
    int substeps = 4;
    glm::dvec3 gravity{0};
    FieldSampling fieldSampling = FieldSampling::vertexSubstep;
    std::vector<Force> forces;  // as in the scene
    std::vector<GroupPlan> groups;
    ContactPlan contact;  // of molecules with one another
    SchoolPlan school;    // of those that steer by one another
    std::vector<glm::vec4> topology;

    // Fields and colliders become straight-line GLSL that reads its numbers from uniform arrays, so that
    // changing a number never compiles. Samples (grids, height fields) share one table of 4-vectors.
    GeneratedFields fields;        // generated/fields.glsl
    GeneratedColliders colliders;  // generated/colliders.glsl; the parameters are those of each group
    size_t fieldCount = 0, colliderCount = 0;
    bool jointContact = false;  // colliders answer together (compile/generate.h)
    bool longFields = false;    // computed noise, grids or many waves: too much text to repeat
    std::vector<glm::vec4> samples;
    std::vector<std::string> grids;  // what each field's grid and each tile takes, for people

    std::vector<Warning> warnings;

    bool hasLife() const;  // in some group some are born or die
};

struct CompileOptions {
    // The springs' numbers are data instead of constants of the fused kernels, for an editor: a step takes
    // longer, and Simulation::changeSprings compiles nothing. Not with bdf2-corotated (its matrix).
    bool liveSprings = false;
};

// Error, located: the scene has more vertices than are counted, or memory has no room for its start.
void checkCounts(const Scene& scene);

// Error, located: checkCounts(), and of a scene whose distance fields are to be baked all that compile()
// refuses without them: colliders that turn too fast, muscles of too many frequencies, a substep beyond what
// the solver holds stable (located at the solver, else at the group; says how many substeps would do).
void checkPlan(const Scene& scene);

// Error: what checkScene() refuses (scene/json/scene_file.h), what checkPlan() names, contact, schools or
// births that do not fit, or fields or colliders take more uniforms than OpenGL 3.3 promises.
Plan compile(const Scene& scene, const CompileOptions& options = {});

// How many substeps of a frame the solvers need when stiffness, damping and drag are scaled by these factors;
// at least `substeps`.
int substepsNeeded(const Plan& plan, double frameTime, double stiffnessFactor, double dampingFactor,
                   double dragFactor, int substeps);

}  // namespace shoal
