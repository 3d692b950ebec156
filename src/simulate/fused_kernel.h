// The fused step's shader for a group: the molecule's own text (compile/kernel.h), the scene's fields and
// colliders, the solver, and the skeleton of shaders/fused, with only the branches that the group needs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/path.h"
#include "gpu/program.h"
#include "simulate/step.h"

namespace shoal {

struct KernelOptions {
    enum class Work {
        frame,
        normals,  // of the state as it is; nothing moves
        watch,    // in fragments: whether the state as it is has run away
        touched,  // in fragments: what contact between molecules does to the state
        births,   // of newborns (shaders/particles/spawn.glsl)
    };
    // Which of the 4-vectors that a molecule stores one draw writes, a colour target each.
    struct Targets {
        int first = 0, count = 0;
    };
    Work work = Work::frame;
    std::optional<Targets> fragments = {};  // a fragment shader (OpenGL 3.3); else a compute shader
    std::string factors = {};               // bdf2-corotated: its matrix as constants; empty: a uniform block
    Lanes lanes = Lanes::molecule;          // not automatic
    int sharedBytes = PathLimits{}.maxSharedBytes;  // of a workgroup, for a lane a vertex
    bool normals = false;                           // a frame writes them, where the shape has a surface
    bool groupVote = false;                         // ContextInfo::groupVote
    bool software = false;                          // what suits a CPU rasteriser
    bool watch = false;                             // a frame looks for states that run away
    bool ahead =
        false;  // frames are issued before it is known whether one ran away; they change nothing then
};

// Returns the GLSL of what a frame in fragments stores of a molecule, a 4-vector each: its state and, where
// that changes, its record.
std::vector<std::string> storedInFragments(const GroupPlan& group);
// Returns the same of a newborn, and its constants.
std::vector<std::string> storedAtBirth(const GroupPlan& group);
// Returns the draws, of at most so many targets each, that store so many 4-vectors.
std::vector<KernelOptions::Targets> drawsOf(size_t values, int targets);

constexpr int birthLanes = 64;  // of a workgroup of births (shaders/particles/bits_scan.comp counts with it)
// Vertices that a lane of the step holds, at most.
int verticesOfLane(const GroupPlan& group, const KernelOptions& options);
// Molecules of a workgroup of the step.
int workgroupMolecules(const GroupPlan& group, const KernelOptions& options);

gpu::ProgramOptions kernelProgram(const Plan& plan, size_t group, const KernelOptions& options);

// Returns all numbers by which something other than contact acts on a group's molecules in a frame.
std::vector<glm::vec4> stepNumbers(const Plan& plan, const GroupPlan& group, const Frame& frame);

// The numbers of a frame, for a step and for births.
void setStepUniforms(const gpu::Program& program, const Plan& plan, const GroupPlan& group,
                     const Frame& frame);

// Returns the text that the driver gets, to be read by people. Error: a shader file is missing.
std::string kernelShader(const std::string& shaderRoot, const Plan& plan, size_t group,
                         const KernelOptions& options);

}  // namespace shoal
