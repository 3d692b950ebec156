// The fused step in fragments (OpenGL 3.3): the kernels of the fused path as fragment shaders, a fragment a
// molecule. One draw writes as many of a molecule's 4-vectors as the context has colour targets; what is left
// takes further draws, each of which does the whole step again and writes other 4-vectors.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "simulate/births.h"
#include "simulate/contact/contact.h"
#include "simulate/execution_path.h"
#include "simulate/group_kernel.h"
#include "simulate/layer_state.h"
#include "simulate/school.h"
#include "simulate/state_view.h"
#include "simulate/watchdog.h"

namespace shoal {

class Fragments : public ExecutionPath {
  public:
    // Borrows the plan and the tables. Error: out of memory; the driver refuses a kernel.
    Fragments(gpu::Context& context, const Plan& plan, const Tables& tables,
              const SimulationOptions& options);

    void step(const Frame& frame, gpu::PassTimers& timers) override;
    void computeNormals(gpu::PassTimers& timers) override;
    StateView view() const override { return {.layers = &state}; }
    void write(size_t group, const GroupState& groupState, double time) override;
    GroupState read(size_t group) const override;
    GroupState readOne(size_t group, size_t molecule) const override {
        return state[group].readOne(molecule);
    }
    std::vector<glm::vec3> readNormals(size_t group) const override {
        return state[group].readNormals(plan_->groups[group]);
    }
    std::optional<std::vector<GroupState>> readBefore() const override;
    bool changeSchool(size_t group, const School& school) override {
        return school_ && school_->change(group, school);
    }
    bool changeLife(size_t group, const Lifecycle& life) override;
    LifeCounts lifeCounts(size_t group) const override { return births_->counts(group); }
    std::optional<int> framesSinceAlarm(bool) override {
        return query_ ? query_->framesSince() : std::nullopt;
    }
    void disarm() override;
    const ContactResult* contact() const override { return contact_.get(); }
    void remember(const ContactMemory& memory) override {
        if (contact_) contact_->remember(memory);
    }
    Lanes lanes(size_t) const override { return Lanes::molecule; }

    std::vector<GroupLayers> state;  // per group

  private:
    struct Programs {
        std::unique_ptr<GroupKernel> kernel;
        const gpu::Program* normals = nullptr;  // where something is drawn and has a surface
        const gpu::Program* watch = nullptr;    // where watched
        const gpu::Program* touched = nullptr;  // where there is contact
    };
    class Touched;
    void run(const Frame& frame, gpu::PassTimers& timers);
    // Draws the rows of so many molecules, as one triangle or what the vertex shader makes of more vertices,
    // with a program that is in use.
    void draw(const gpu::Program& program, size_t group, std::span<const LayerDraw> draws, int molecules,
              int vertices = 3) const;
    void watch(gpu::PassTimers& timers);

    const Plan* plan_;
    int mostVertices_ = 0;  // of a lane, where loops end early (compile/lanes.h: piecesOf)
    int pieces_ = 1;        // dispatches of the last frame
    gpu::Programs made_;
    std::vector<Programs> programs_;         // per group
    std::unique_ptr<RunawayQuery> query_;    // null: not watched
    std::unique_ptr<TextureSchool> school_;  // null: there is none
    double steeringEnd_ = 0;                 // s, of the frame
    std::unique_ptr<TextureBirths> births_;  // null: none is born and none dies
    std::unique_ptr<ContactState> contactState_;
    std::unique_ptr<Contact> contact_;  // null: there is none
};

}  // namespace shoal
