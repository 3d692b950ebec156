// The part of the fused step that belongs to one molecule type, as GLSL: straight-line springs and triangles
// with the topology, rest lengths and relative stiffness as constants, and how the state is packed. Numbers
// that a slider moves are uniforms (shaders/fused/state.glsl), so that none of them compiles anything.
#pragma once

#include <bit>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "molecule/molecule.h"
#include "scene/solver.h"

namespace shoal {

// Tells which physics a group needs. Every pass, buffer and shader branch depends on one of these.
struct Needs {
    bool fields = false;  // there is a field and the group has drag
    bool drag = false;
    bool directionalDrag = false;
    bool gravity = false;
    bool forces = false;  // some accelerate by place: attract, vortexLine
    bool thrust = false;
    bool wind = false;  // a wind among the forces, and the group has drag
    bool springs = false;
    bool springDamping = false;
    bool actuation = false;
    bool pins = false;     // some vertex is held at the start
    bool release = false;  // and may be released
    bool records = false;  // anchors move or pins are released
    bool scale = false;    // instances differ from the molecule's own size
    bool phase = false;    // and in the phase of their muscles
    bool collide = false;
    bool normals = false;      // the shape has triangles
    bool life = false;         // some are born or die
    bool liveSprings = false;  // their numbers may change while it runs (CompileOptions)
    bool steers = false;       // they school
    bool avoids = false;       // and turn from colliders
};

struct KernelText {
    // For a lane a molecule. generated/molecule.glsl: masses, pins, sums over the vertices
    std::string molecule;
    std::string forces;  // generated/forces.glsl: springForces, surfaceNormals
    std::string sweeps;  // generated/sweeps.glsl: relaxForward, relaxBackward; for implicit solvers
    std::string stages;  // generated/stages.glsl: stageTime, shareOf, afterStage; for Runge-Kutta methods
    // For generated/packing.glsl of a lane: loadState, and expressions of the 4-vectors that are stored.
    std::string load;
    std::vector<std::string> state, normals;
    // generated/muscles.glsl: how far muscles are, where that is a uniform
    std::string muscles;
    // For a lane a vertex. generated/waves.glsl: the waves that muscles share
    std::string waves;

    bool operator==(const KernelText&) const = default;
};

// `ofLane`: with the text of a lane a molecule, which grows with the molecule.
KernelText kernelText(const Molecule& molecule, const Needs& needs, const Solver& solver, bool ofLane = true);

// Returns the numbers that the kernel reads where springs are live, two 4-vectors a spring:
//   stiffness, damping, rest length;   actuation: amplitude, 2 pi frequency, phase, angle at the frame's
//   start
// That angle is 0 here, and renewed every frame from the springs' frequencies, Hz.
std::vector<glm::vec4> springNumbers(const Molecule& molecule);
std::vector<double> springFrequencies(const Molecule& molecule);
// Whether how far its muscles' waves are is a uniform, muscleAngles (compile/clocks.h).
bool countsMuscles(const Needs& needs);

// The order of a sweep over the springs: in rounds whose springs share no vertex, so that a processor works
// on several at once (a greedy colouring of the edges).
std::vector<size_t> sweepOrder(const Molecule& molecule);

constexpr int stateWidth = 1024;  // texels of a row of state textures
constexpr int stateRows(size_t texels) {
    return int((texels + stateWidth - 1) / stateWidth);
}
// Parts of rows that hold the texels from `first` on.
struct TexelRun {
    int x, y, width;
    size_t offset;  // of the run's first texel, from `first`
};
std::vector<TexelRun> texelRuns(size_t first, size_t count);
// Textures of so many numbered texels have rows of 2^n of them, and are as wide as high or half as high;
// returns n.
constexpr int rowBits(size_t numbers) {
    return (int(std::bit_width(numbers - 1)) + 1) / 2;
}

// How the fused path stores a molecule (shaders/fused/state.glsl).
struct BufferLayout {
    static constexpr int block = 16;  // molecules that lie together
    int vertexCount = 0;
    bool history = false;  // the changes of the last substep lie behind positions and velocities
    bool life = false;     // age and length of life, s

    // Returns the lanes of a workgroup, a molecule each. Points have so little to do that workgroups count:
    // on a CPU rasteriser these take 6 % less.
    int lanes() const { return vertexCount == 1 ? 256 : 64; }
    int positionElements() const { return (3 * vertexCount + 3) / 4; }  // 4-vectors; as many of normals
    int stateElements() const { return (history ? 4 : 2) * positionElements() + (lifeApart() ? 1 : 0); }
    // Age and life take what the last 4-vectors of positions and of velocities leave free (their w), else the
    // x and y of one more at the end.
    bool lifeApart() const { return life && vertexCount % 4 == 0; }
    // Returns what a shader that reads or writes it needs (shaders/state/packed.glsl).
    // `layered`: in fragments, else in buffers.
    std::vector<std::string> defines(bool layered = false) const;
    // Returns the index of the 4-vector e of molecule m, with `elements` a molecule and so many molecules
    // together.
    static size_t index(size_t m, int e, int elements, size_t together = block) {
        return m / together * together * size_t(elements) + size_t(e) * together + m % together;
    }
    // To whole workgroups: lanes past the last molecule step what lies there, and nobody reads it.
    size_t padded(size_t molecules) const {
        const auto whole = size_t(lanes());
        return (molecules + whole - 1) / whole * whole;
    }
};

}  // namespace shoal
