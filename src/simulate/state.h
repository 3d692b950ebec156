// The state textures and their sides. Layout: compile/plan.h.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include "compile/plan.h"
#include "gpu/context.h"
#include "gpu/framebuffer.h"
#include "gpu/texture.h"

namespace shoal {

// Two textures, of which each group has its own current side: a group that did not step is never stale.
struct TwoSided {
    std::array<gpu::Texture, 2> side;
    std::vector<int> current;  // per group

    const gpu::Texture& read(size_t group) const { return side[size_t(current[group])]; }
    const gpu::Texture& write(size_t group) const { return side[size_t(1 - current[group])]; }
    void flip(size_t group) { current[group] = 1 - current[group]; }
    explicit operator bool() const { return bool(side[0]); }
};

class State {
  public:
    State(gpu::Context& context, const Plan& plan);
    void upload(const Plan& plan);  // the start state into the current sides

    TwoSided position, velocity, acceleration, record;
    gpu::Texture normal, constant, topology, samples;

    // Framebuffer that draws into the given sides (made once per combination).
    const gpu::Framebuffer& target(const gpu::Texture& first, const gpu::Texture* second = nullptr);

  private:
    struct Target {
        GLuint first, second;
        gpu::Framebuffer framebuffer;
    };
    gpu::Context* context_;
    std::deque<Target> targets_;  // references to its elements stay valid
};

}  // namespace shoal
