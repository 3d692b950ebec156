// The ping-pong path (OpenGL 3.3): fragment passes over state textures, read one side, draw into the other,
// swap. Layout: simulate/texture_state.h. The passes of a frame: compile/passes.h. Contact between molecules
// cuts the frame into contact steps: some of its substeps, then the passes of contact
// (simulate/contact/contact.h).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "compile/passes.h"
#include "gpu/buffer.h"
#include "gpu/gl.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/contact/contact.h"
#include "simulate/execution_path.h"
#include "simulate/state_view.h"
#include "simulate/step.h"
#include "simulate/tables.h"
#include "simulate/watchdog.h"

namespace shoal {

class PingPong : public ExecutionPath {
  public:
    // Borrows the plan and the tables.
    PingPong(gpu::Context& context, const Plan& plan, const Tables& tables, const SimulationOptions& options);

    void step(const Frame& frame, gpu::PassTimers& timers) override;
    void computeNormals(gpu::PassTimers& timers) override;
    StateView view() const override { return {.textures = &state}; }
    void write(size_t group, const GroupState& groupState, double) override {
        state.write(group, groupState);
    }
    GroupState read(size_t group) const override { return state.read(group); }
    GroupState readSome(size_t group, size_t first, size_t count) const override {
        return state.readSome(group, first, count);
    }
    std::vector<glm::vec3> readNormals(size_t group) const override { return state.readNormals(group); }
    std::optional<int> framesSinceAlarm(bool) override {
        return query_ ? query_->framesSince() : std::nullopt;
    }
    void disarm() override {
        if (query_) query_->disarm();
    }
    const ContactResult* contact() const override { return contact_.get(); }
    void remember(const ContactMemory& memory) override {
        if (contact_) contact_->remember(memory);
    }

    TextureState state;

  private:
    // The solver's times for one substep of a group.
    struct Step {
        double time;  // s, at its start
        double h;     // s
        bool first;   // of the frame
        const Frame& frame;
    };
    void run(Pass::When when, const Step& step, gpu::PassTimers& timers);
    void runSubsteps(const Frame& frame, gpu::PassTimers& timers);  // and what is before them
    void runPass(size_t index, const Pass& pass, const Step& step, gpu::PassTimers& timers);
    void records(const GroupPlan& group, size_t index, const Step& step);
    void normals(const GroupPlan& group, size_t index, const Step& step, bool ahead);
    void thrust(const GroupPlan& group, size_t index, const Step& step);
    void restore(const GroupPlan& group, size_t index, const Step& step, bool frameStart);
    void advect(const GroupPlan& group, size_t index, const Step& step);
    void stage(const GroupPlan& group, size_t index, const Step& step, int s);
    void collide(const GroupPlan& group, size_t index, const Step& step);
    void watch(gpu::PassTimers& timers);

    const gpu::Program& makeProgram(gpu::Context& context, PassKind kind, size_t index);
    const gpu::Program& prepare(PassKind kind, size_t index);
    void setSprings(const gpu::Program& program, const GroupPlan& group, const Step& step,
                    double predictTime);
    void setParameters(const gpu::Program& program, const GroupPlan& group, const Step& step);
    using Targets = std::vector<gpu::ColorTarget>;
    void draw(size_t index, int firstRow, int rows, const Targets& targets);
    void drawState(size_t index, const Targets& targets);
    void drawVelocity(size_t index);  // into the other side, the current one then
    void drawMotion(size_t index);    // position and velocity, likewise

    const Plan* plan_;
    const Tables* tables_;
    bool drawn_;
    gpu::Programs made_;
    std::vector<std::vector<Pass>> passes_;                     // per group
    std::vector<std::array<const gpu::Program*, 8>> programs_;  // per group, by PassKind
    std::unique_ptr<RunawayQuery> query_;                       // null: not watched
    std::unique_ptr<ContactState> contactState_;
    std::unique_ptr<Contact> contact_;  // null: there is none
};

}  // namespace shoal
