// The fused step's shader for a group: the molecule's own text (compile/kernel.h), the scene's fields and
// colliders, the solver, and the skeleton of shaders/fused, with only the branches that the group needs.
#pragma once

#include <string>

#include "compile/path.h"
#include "gpu/program.h"
#include "simulate/step.h"

namespace shoal {

struct KernelOptions {
    std::string factors = {};       // bdf2-corotated: its matrix as constants; empty: a uniform block
    Lanes lanes = Lanes::molecule;  // not automatic
    bool normals = false;           // written, where the shape has a surface
    bool onlyNormals = false;       // of the state as it is; nothing moves
    bool groupVote = false;         // ContextInfo::groupVote
    bool software = false;          // what suits a CPU rasteriser
    bool watch = false;             // for states that run away
    bool births = false;            // of newborns instead of a step (shaders/particles/spawn.comp)
};

constexpr int birthLanes = 64;  // of a workgroup of births (shaders/particles/bits_scan.comp counts with it)
// Lanes of a workgroup of the step.
int workgroupLanes(const GroupPlan& group, Lanes lanes);

gpu::ProgramOptions kernelProgram(const Plan& plan, size_t group, const KernelOptions& options);

// The numbers of a frame, for a step and for births.
void setStepUniforms(const gpu::Program& program, const Plan& plan, const GroupPlan& group,
                     const Frame& frame);

// Returns the text that the driver gets, to be read by people. Error: a shader file is missing.
std::string kernelShader(const std::string& shaderRoot, const Plan& plan, size_t group,
                         const KernelOptions& options);

}  // namespace shoal
