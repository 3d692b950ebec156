// The programs of one group's fused step (simulate/fused.h), with all that they are given beside the state:
// for a dispatch of compute shaders, or for draws of fragment shaders.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compile/corotated.h"
#include "gpu/buffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "simulate/fused_kernel.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

// All kernels of a path borrow these.
struct KernelSource {
    gpu::Context* context;
    const Plan* plan;
    const Tables* tables;
};

class GroupKernel {
  public:
    // `moves`: there is a step. Borrows `programs`. Error: the driver refuses a kernel.
    GroupKernel(const KernelSource& source, size_t group, const KernelOptions& options, bool moves,
                gpu::Programs& programs);

    const KernelOptions& options() const { return options_; }
    bool moves() const { return step_ != nullptr; }
    // Brings what changes from frame to frame up to date, once a frame.
    void update(const Frame& frame);
    // Returns the program of the step, in use, with the numbers of the frame.
    const gpu::Program& useStep(const Frame& frame) const;
    // Returns another program for the same group: its options with this work.
    const gpu::Program& also(KernelOptions::Work work);
    // Binds all that a program of this group reads beside the state.
    void bindTables(const gpu::Program& program) const;

  private:
    void makeStep();
    void makeFactors();
    void updateFactors(const Frame& frame);
    void updateSprings(const Frame& frame);
    const GroupPlan& group() const { return source_.plan->groups[group_]; }
    const gpu::Program& make(const KernelOptions& options);

    KernelSource source_;
    size_t group_;
    KernelOptions options_;
    gpu::Programs* programs_;
    const gpu::Program* step_ = nullptr;  // where it moves
    std::unique_ptr<gpu::Program> own_;   // the step, where numbers that change are constants of it
    CorotatedStage stage_;                // bdf2-corotated: of the matrix
    gpu::Buffer factors_;                 // and the matrix, where it is not part of the program
    gpu::Texture springs_;                // where their numbers are live
};

}  // namespace shoal
