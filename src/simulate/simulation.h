// Runs a plan on the ping-pong path (OpenGL 3.3): fragment passes over state textures, read one side, draw
// into the other, swap. The layout of every texture is in compile/plan.h.
//
// After construction a frame moves no byte of state over the bus; `snapshot` reads it back when asked.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/pass_timers.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "simulate/parameters.h"
#include "simulate/state.h"

namespace shoal {

// A group's state in double precision and world coordinates; index = molecule * vertexCount + vertex.
struct Snapshot {
    double time = 0;
    int count = 0, vertexCount = 0;
    std::vector<glm::dvec3> positions, velocities;  // m, m/s
    std::vector<glm::vec3> normals;                 // unit; zero where the shape has no triangles
    std::vector<bool> released;                     // per molecule: pins let go
};

class Simulation {
  public:
    // `drawn`: normals are computed at the end of each frame, for the renderer and for exports.
    Simulation(gpu::Context& context, const std::string& shaderRoot, Plan plan, bool drawn = true,
               gpu::PassTimers::Mode timing = gpu::PassTimers::Mode::off);

    void frame();    // advances by parameters.frameTime
    void restart();  // back to the start state, which is uploaded again

    Parameters parameters;
    const Plan& plan() const { return plan_; }
    const State& state() const { return state_; }
    double time() const { return time_; }
    int frames() const { return frames_; }
    gpu::PassTimers& timers() { return timers_; }
    gpu::Context& context() { return *context_; }

    Snapshot snapshot(size_t group);  // state bytes are counted as read back
    uint64_t hash();                  // of the whole state's bits (FNV-1a): same scene, same bits

  private:
    // The solver's times for one substep of a group.
    struct Step {
        double time;  // s, at its start
        double h;     // s
        bool first;   // of the frame
    };
    void runPass(const PassPlan& pass, const Step& step);
    void records(const GroupPlan& group, size_t index, const Step& step);
    void normals(const GroupPlan& group, size_t index, const Step& step, bool ahead);
    void restore(const GroupPlan& group, size_t index, const Step& step, bool frameStart);
    void advect(const GroupPlan& group, size_t index, const Step& step);
    void collide(const GroupPlan& group, size_t index, const Step& step);

    const gpu::Program& prepare(PassKind kind, const GroupPlan& group, size_t index);
    void setSprings(const gpu::Program& program, const GroupPlan& group, double time, double predictTime);
    void drawState(const GroupPlan& group, const gpu::Framebuffer& target);
    void drawRecords(const GroupPlan& group, const gpu::Framebuffer& target);

    gpu::Context* context_;
    Plan plan_;
    bool drawn_;
    State state_;
    std::vector<std::array<gpu::Program, 5>> programs_;  // per group, by PassKind
    gpu::VertexArray noAttributes_;
    gpu::PassTimers timers_;
    double time_ = 0;  // s
    int frames_ = 0;
};

}  // namespace shoal
