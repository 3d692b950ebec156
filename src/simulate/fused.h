// The fused path (OpenGL 4.3): one dispatch a group and frame. Each molecule is read once, runs all substeps
// of the frame in the registers of a lane (or the shared memory of a workgroup), and is written once, with
// its normals where something is drawn. Contact between molecules cuts the frame into contact steps: a
// dispatch of some of its substeps, then the passes of contact (simulate/molecule_contact.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compile/corotated.h"
#include "gpu/buffer_texture.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/births.h"
#include "simulate/buffer_state.h"
#include "simulate/fused_kernel.h"
#include "simulate/molecule_contact.h"
#include "simulate/school.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

struct FusedOptions {
    bool drawn = true;               // normals are written
    bool inPlace = false;            // one side instead of two: half the memory
    Lanes lanes = Lanes::automatic;  // how molecules are spread
    gpu::ProgramCache* cache = nullptr;
    bool watch = false;  // for states that run away (simulate/watchdog.h)
};

class Fused {
  public:
    // Borrows the plan and the tables. Error: out of memory; the driver refuses a kernel; a group's molecules
    // cannot be spread as demanded.
    Fused(gpu::Context& context, const std::string& shaderRoot, const Plan& plan, const Tables& tables,
          const FusedOptions& options);

    void step(const Frame& frame, gpu::PassTimers& timers);
    void computeNormals(gpu::PassTimers& timers);  // of the state as it is, where drawn

    std::vector<GroupBuffers> state;  // per group
    Lanes lanes(size_t group) const { return kernels_[group].options.lanes; }
    const MoleculeContact* contact() const { return contact_.get(); }  // null: there is none
    Births* births() const { return births_.get(); }                   // null: none is born and none dies
    Schooling* school() const { return school_.get(); }                // null: none steers
    // Whether a frame since disarm() left a state that ran away; waits for the last one, and reads 4 bytes.
    bool alarmed() const;
    void disarm();

  private:
    struct Kernel {
        KernelOptions options;
        const gpu::Program *step = nullptr, *normals = nullptr;
        std::unique_ptr<gpu::Program> own;  // the step, where numbers that change are constants of it
        CorotatedStage stage;               // bdf2-corotated: of the matrix
        gpu::Buffer factors;                // and the matrix, where it is not part of the program
        gpu::Buffer springs;                // where their numbers are live
        gpu::BufferTexture springTexels;
    };
    void makeStep(size_t index);
    void makeFactors(size_t index);
    void updateFactors(size_t index, const Frame& frame);
    void updateSprings(size_t index, const Frame& frame);
    void run(const Frame& frame, gpu::PassTimers& timers);
    void bind(const gpu::Program& program, size_t index, const GroupBuffers::Part& part) const;
    void dispatch(const gpu::Program& program, size_t index, const GroupBuffers::Part& part) const;

    gpu::Context* context_;
    std::string shaderRoot_;
    const Plan* plan_;
    const Tables* tables_;
    bool drawn_;
    gpu::ProgramCache* cache_;
    gpu::Programs programs_;
    std::vector<Kernel> kernels_;
    gpu::Buffer alarm_;  // one word; where watched
    std::unique_ptr<MoleculeContact> contact_;
    std::unique_ptr<Births> births_;
    std::unique_ptr<Schooling> school_;
    double steeringEnd_ = 0;  // s, of the frame
};

// Returns a context's limits, for compile/path.h.
PathLimits limitsOf(const gpu::ContextInfo& info);

}  // namespace shoal
