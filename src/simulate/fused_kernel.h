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
        births,   // of newborns (shaders/births/spawn.glsl)
    };
    Work work = Work::frame;
    // In fragments (OpenGL 3.3), the most colour targets of a draw, each of which takes one of the 4-vectors
    // that a molecule stores; else a compute shader.
    std::optional<int> targets = {};
    std::string factors = {};       // bdf2-corotated: its matrix as constants; empty: a uniform block
    Lanes lanes = Lanes::molecule;  // not automatic
    int sharedBytes = PathLimits{}.maxSharedBytes;  // of a workgroup, for a lane a vertex
    bool normals = false;                           // a frame writes them, where the shape has a surface
    bool groupVote = false;                         // ContextInfo::groupVote
    bool software = false;                          // what suits a CPU rasteriser
    bool watch = false;                             // a frame looks for states that run away
    // Frames are issued before it is known whether one ran away; they change nothing then.
    bool ahead = false;
};

// Returns the draws that store so many 4-vectors: of each, the first that it writes (uniform firstStored).
// All write as many, so that the last may write some again: to Mesa's rasteriser another number of targets is
// another program, which it compiles.
std::vector<int> drawsOf(size_t values, int targets);

constexpr int birthLanes = 64;  // of a workgroup of births
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
