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

    // After a frame: keeps its state if its turn has come, and forgets what was kept of later ones, which may
    // come otherwise now. In a loop, goes back to its begin after its end.
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
