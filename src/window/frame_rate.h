// Keeps a rate of frames where pictures are slow to draw, as on a CPU, by what they may do without: at first
// size, then samples, shadows and occlusion.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "render/renderer.h"

namespace shoal::window {

struct PictureLevel {
    double scale = 1;  // of its sides
    Quality quality = {};
    double cost = 1;  // about, of what a full picture takes
};
// The full picture, then what takes less and less.
constexpr std::array<PictureLevel, 8> pictureLevels = {{{},
                                                        {0.71, {}, 0.58},
                                                        {0.5, {}, 0.37},
                                                        {0.5, {.samples = 1}, 0.27},
                                                        {0.5, {.samples = 1, .shadows = false}, 0.2},
                                                        {0.5, {1, false, false}, 0.18},
                                                        {0.35, {1, false, false}, 0.13},
                                                        {0.25, {1, false, false}, 0.1}}};
// Says what a picture does without, such as "0.5 of its width, 1 sample a pixel"; empty: nothing.
std::string told(const PictureLevel& level);

class FrameRate {
  public:
    static constexpr double wanted = 20;  // frames a second

    bool keeps = true;  // the rate; else all pictures are full
    const PictureLevel& level() const { return pictureLevels[keeps ? level_ : 0]; }
    // Whether the picture's own time is to be waited for, after a frame of so many seconds: they may be those
    // of the monitor, for which frames wait.
    bool measures(double seconds) const { return seconds * wanted > 1 || level().cost < 1; }
    // Takes note of how long a frame with a picture of level() took, all in all and the picture alone, at the
    // most.
    void took(double seconds, double drawing);
    void forget();  // how long frames took: another scene, or another size

    // Whether frames are too slow for it whatever pictures do without, and why, in a sentence.
    bool missed() const { return keeps && missed_; }
    std::string whyMissed() const;

  private:
    void change(size_t level);

    size_t level_ = 0;
    int settling_ = unsettled;               // frames that are not counted: programs are made in them
    size_t frames_ = 0;                      // at this level, that were counted
    std::vector<double> seconds_, drawing_;  // of the last of them
    double rest_ = 0;                        // s, of a frame beside its picture
    bool missed_ = false;
    // Frames until a level that was too slow is tried again.
    std::array<int, pictureLevels.size()> tooSlow_{};

    static constexpr int unsettled = 2;
};

}  // namespace shoal::window
