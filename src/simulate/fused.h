// The fused path (OpenGL 4.3): one dispatch a group and frame. Each molecule is read once, runs all substeps
// of the frame in the registers of a lane (or the shared memory of a workgroup), and is written once, with
// its normals where something is drawn. Contact between molecules cuts the frame into contact steps: a
// dispatch of some of its substeps, then the passes of contact (simulate/contact/contact.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pass_timers.h"
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
    // Borrows the plan and the tables. Error: out of memory; the driver refuses a kernel; a group's molecules
    // cannot be spread as demanded.
    Fused(gpu::Context& context, const Plan& plan, const Tables& tables, const SimulationOptions& options);

    void step(const Frame& frame, gpu::PassTimers& timers) override;
    void computeNormals(gpu::PassTimers& timers) override;
    StateView view() const override { return {.buffers = &state}; }
    void write(size_t group, const GroupState& groupState, double time) override;
    GroupState read(size_t group) const override;
    GroupState readOne(size_t group, size_t molecule) const override {
        return state[group].readOne(molecule);
    }
    std::vector<glm::vec3> readNormals(size_t group) const override {
        return state[group].readNormals(plan_->groups[group]);
    }
    std::optional<std::vector<GroupState>> readBefore() const override;
    std::optional<int> framesSinceAlarm(bool waits) override {
        return alarm_ ? alarm_->framesSince(waits) : std::nullopt;
    }
    void goBack(int frames) override;
    void disarm() override {
        if (alarm_) alarm_->disarm();
    }
    const ContactResult* contact() const override { return contact_.get(); }
    void remember(const ContactMemory& memory) override {
        if (contact_) contact_->remember(memory);
    }
    Lanes lanes(size_t group) const override { return kernels_[group]->options().lanes; }
    LifeCounts lifeCounts(size_t group) const override { return births_->counts(group); }
    bool changeLife(size_t group, const Lifecycle& life) override;
    bool changeSchool(size_t group, const School& school) override;

    std::vector<GroupBuffers> state;  // per group

  private:
    class Touched;
    void run(const Frame& frame, gpu::PassTimers& timers);
    void dispatch(const gpu::Program& program, size_t index, const GroupBuffers::Part& part,
                  KernelOptions::Work work) const;

    const Plan* plan_;
    int mostVertices_ = 0;  // of a lane, where loops end early (compile/lanes.h: piecesOf)
    int pieces_ = 1;        // dispatches of the last frame
    bool drawn_;
    gpu::Programs programs_;
    std::vector<std::unique_ptr<GroupKernel>> kernels_;  // per group, as the next
    std::vector<const gpu::Program*> normals_;           // null: there are none
    std::optional<RunawayWord> alarm_;                   // where watched
    std::unique_ptr<ContactState> contactState_;
    std::unique_ptr<Contact> contact_;      // null: there is none
    std::unique_ptr<BufferBirths> births_;  // null: none is born and none dies
    std::unique_ptr<BufferSchool> school_;  // null: none steers
    double steeringEnd_ = 0;                // s, of the frame
};

// Returns a context's limits, for compile/path.h.
PathLimits limitsOf(const gpu::ContextInfo& info);

}  // namespace shoal
