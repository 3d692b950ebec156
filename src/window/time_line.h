// A time line of a run, at the bottom of the window: states that are kept in memory as the run goes on, to
// go back to. Keeping one waits for the GPU.
#pragma once

#include <optional>
#include <vector>

#include "simulate/simulation.h"

namespace shoal::window {

class TimeLine {
  public:
    bool open = false;

    // To be called after a frame. Keeps the frame's state if its turn has come, and forgets the states of
    // later frames, which may now turn out differently. In a loop, goes from its end back to its beginning.
    void note(Simulation& simulation);
    void forget();  // all: the scene is another one

    // Draws it between `left` and `right` (from the window's right edge), in the interface's units. The state
    // to go to, if the user chose one.
    const SavedState* draw(float left, float right, const Simulation& simulation);

    static constexpr size_t mostBytes = size_t(256) << 20;

  private:
    void thinOut();

    std::vector<SavedState> kept_;  // by ascending frames
    static constexpr int usualEvery = 15;
    int every_ = usualEvery;   // frames
    std::optional<int> loop_;  // the last frame of the loop, which begins with the first that was kept
};

}  // namespace shoal::window
