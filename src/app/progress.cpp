#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace shoal::app {

using Clock = std::chrono::steady_clock;

Progress::Progress(std::string what, int total)
    : what_(std::move(what)), total_(std::max(total, 1)), terminal_(::isatty(2) != 0), start_(Clock::now()) {}

Progress::~Progress() {
    if (terminal_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::step() {
    ++done_;
    const Clock::time_point now = Clock::now();
    if (terminal_ && (done_ == total_ || now - printed_ > std::chrono::milliseconds(100))) {
        printed_ = now;
        print();
    }
    const int tenth = done_ * 10 / total_;
    if (!terminal_ && tenth > printedTenth_) {
        printedTenth_ = tenth;
        print();
    }
}

void Progress::rename(std::string what) {
    if (terminal_) what.resize(std::max(what.size(), what_.size()), ' ');  // over what is longer
    what_ = std::move(what);
    if (terminal_ && done_ > 0) print();
}

void Progress::print() {
    const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    const double left = seconds / done_ * (total_ - done_);
    if (!terminal_) {
        std::fprintf(stderr, "%s: %d of %d, %.1f s\n", what_.c_str(), done_, total_, seconds);
        return;
    }
    constexpr int width = 32;
    std::string bar(size_t(width * done_ / total_), '#');
    bar.resize(width, '.');
    std::fprintf(stderr, "\r%s [%s] %d/%d  %.0f s left ", what_.c_str(), bar.c_str(), done_, total_, left);
    std::fflush(stderr);
}

}  // namespace shoal::app
