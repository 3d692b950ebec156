#include "window/frame_rate.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "measure/timing.h"

namespace shoal::window {

namespace {

constexpr double budget = 1 / FrameRate::wanted;           // s
constexpr size_t fewest = 3, remembered = 9, steady = 30;  // frames: to lower, to look at, to raise
constexpr int patience = 600;                              // frames

void remember(std::vector<double>& values, double value) {
    if (values.size() == remembered) values.erase(values.begin());
    values.push_back(value);
}

}  // namespace

void FrameRate::took(double seconds, double drawing) {
    if (!keeps) return;
    for (int& frames : tooSlow_)
        frames = std::max(0, frames - 1);
    if (settling_ > 0) {
        --settling_;
        return;
    }
    remember(seconds_, seconds);
    remember(drawing_, drawing);
    if (++frames_ < fewest) return;
    const double frame = measure::spreadOf(seconds_).median, picture = measure::spreadOf(drawing_).median;
    rest_ = std::max(0.0, frame - picture);
    const double full = picture / pictureLevels[level_].cost;  // about, s of a full picture
    // Where the least picture is too slow as well, because all else is slow, a third of the frame is the
    // picture's: less would not be seen in the rate.
    double most = budget - rest_;
    if (full * pictureLevels.back().cost > most) most = std::max(most, rest_ / 2);
    const bool slow = frame > 1.05 * budget;
    if (slow && picture > 1.05 * most && level_ + 1 < pictureLevels.size()) {
        tooSlow_[level_] = patience;
        size_t next = level_ + 1;
        while (next + 1 < pictureLevels.size() && full * pictureLevels[next].cost > most)
            ++next;
        change(next);
        return;
    }
    if (frames_ < steady) return;
    missed_ = slow;
    if (level_ > 0 && tooSlow_[level_ - 1] == 0 && full * pictureLevels[level_ - 1].cost < 0.9 * most)
        change(level_ - 1);
}

void FrameRate::change(size_t level) {
    level_ = level;
    settling_ = unsettled;
    frames_ = 0;
    seconds_.clear();
    drawing_.clear();
}

void FrameRate::forget() {
    tooSlow_ = {};
    missed_ = false;
    change(level_);
}

std::string FrameRate::whyMissed() const {
    const std::string without = told(level());
    return concat(wanted, " frames a second cannot be kept here, ",
                  rest_ > budget
                      ? concat("where all but the picture takes ", std::lround(1e3 * rest_), " ms a frame")
                      : concat("even with ", without.empty() ? "pictures" : without));
}

std::string told(const PictureLevel& level) {
    std::vector<std::string> out;
    if (level.scale < 1) out.push_back(concat(level.scale, " of its width"));
    if (level.quality.samples == 1) out.emplace_back("1 sample a pixel");
    if (!level.quality.shadows) out.emplace_back("no shadows of what is near");
    if (!level.quality.occlusion) out.emplace_back("no occlusion");
    return joined(out, ", ");
}

}  // namespace shoal::window
