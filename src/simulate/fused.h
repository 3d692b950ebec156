// The fused path: one pass a group and frame. Each molecule is read once, runs all substeps of the frame in
// the registers of a lane (or the shared memory of a workgroup), and is written once, with its normals where
// something is drawn. With buffers (OpenGL 4.3) a pass is a dispatch of compute shaders. With textures
// (OpenGL 3.3) a molecule is a fragment: one draw writes as many of its 4-vectors as the context has colour
// targets, and what is left takes further draws, each of which does the whole step again.
//
// Contact between molecules cuts the frame into contact steps: a pass of some of its substeps, then the
// passes of contact (simulate/contact/contact.h).
#pragma once

#include <memory>
#include <vector>

#include "gpu/array_table.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/births.h"
#include "simulate/contact/contact.h"
#include "simulate/execution_path.h"
#include "simulate/group_kernel.h"
#include "simulate/school.h"
#include "simulate/state_view.h"
#include "simulate/watchdog.h"

namespace shoal {

class Fused : public ExecutionPath {
  public:
    using Form = gpu::ArrayTable::Form;

    // Borrows the plan and the tables. Error: out of memory; the driver refuses a kernel; a group's molecules
    // cannot be spread as demanded.
    Fused(gpu::Context& context, const Plan& plan, const Tables& tables, const SimulationOptions& options,
          Form form);

    void step(const Frame& frame, gpu::PassTimers& timers) override;
    void computeNormals(gpu::PassTimers& timers) override;
    StateView view() const override {
        return {.buffers = textures() ? nullptr : &buffers, .layers = textures() ? &layers : nullptr};
    }
    void write(size_t group, const GroupState& groupState, double time) override;
    GroupState read(size_t group) const override;
    GroupState readSome(size_t group, size_t first, size_t count) const override {
        return state(group).readSome(first, count);
    }
    std::vector<glm::vec3> readNormals(size_t group) const override {
        return state(group).readNormals(plan_->groups[group]);
    }
    std::optional<std::vector<GroupState>> readBefore() const override;
    std::optional<int> framesSinceAlarm(bool waits) override;
    void goBack(int frames) override;
    void disarm() override;
    const ContactResult* contact() const override { return contact_.get(); }
    void remember(const ContactMemory& memory) override {
        if (contact_) contact_->remember(memory);
    }
    Lanes lanes(size_t group) const override { return groups_[group].kernel->options().lanes; }
    LifeCounts lifeCounts(size_t group) const override { return births_->counts(group); }
    bool changeLife(size_t group, const Lifecycle& life) override;
    bool changeSchool(size_t group, const School& school) override;

    // The state of each group, in one of the two.
    std::vector<GroupBuffers> buffers;
    std::vector<GroupLayers> layers;

  private:
    struct Group {
        std::unique_ptr<GroupKernel> kernel;
        const gpu::Program* normals = nullptr;  // where something is drawn and has a surface
        // Of textures, where the group moves:
        const gpu::Program* watch = nullptr;    // where watched
        const gpu::Program* touched = nullptr;  // where there is contact
    };
    class Touched;

    bool textures() const { return form_ == Form::textures; }
    const PackedState& state(size_t group) const;
    PackedState& state(size_t group) { return const_cast<PackedState&>(std::as_const(*this).state(group)); }
    KernelOptions kernelOptions(const gpu::ContextInfo& info, const GroupPlan& group,
                                const SimulationOptions& options) const;
    void makeGroup(gpu::Context& context, const KernelSource& source, size_t index,
                   const SimulationOptions& options);
    // Goes before passes that read or write what others wrote or read, and after them.
    void settle() const;
    void run(const Frame& frame, gpu::PassTimers& timers);
    // Gives a program in use what it reads of a range of a group.
    void bind(const gpu::Program& program, size_t group, size_t range) const;
    void watch(gpu::PassTimers& timers);

    const Plan* plan_;
    Form form_;
    bool ahead_ = false;    // frames are issued before it is known whether one ran away
    int mostVertices_ = 0;  // of a lane, where loops end early (compile/lanes.h: piecesOf)
    int matrixTurns_ = 0;   // of bdf2-newton on a CPU rasteriser, the most of a group
    int pieces_ = 1;        // steps of the last frame
    gpu::Programs programs_;
    std::vector<Group> groups_;
    std::optional<RunawayWord> word_;    // of buffers, where watched
    std::optional<RunawayQuery> query_;  // of textures, where watched
    std::unique_ptr<ContactState> contactState_;
    std::unique_ptr<Contact> contact_;      // null: there is none
    std::unique_ptr<BirthPasses> births_;   // null: none is born and none dies
    std::unique_ptr<SchoolPasses> school_;  // null: none steers
    double steeringEnd_ = 0;                // s, of the frame
};

// Returns a context's limits, for compile/path.h.
PathLimits limitsOf(const gpu::ContextInfo& info);

}  // namespace shoal
