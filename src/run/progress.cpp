#include "run/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "core/activity.h"
#include "core/printable.h"
#include "gpu/program.h"
#include "run/signals.h"

namespace shoal {

using Clock = std::chrono::steady_clock;

void TimeLeft::reach(int done, double time) {
    constexpr size_t remembered = 9;
    last_.emplace_back(done, time);
    if (last_.size() > remembered) last_.pop_front();
}

double TimeLeft::seconds(int total) const {
    if (last_.size() < 2) return 0;
    const auto& [first, began] = last_.front();
    const auto& [done, ended] = last_.back();
    return (ended - began) / (done - first) * (total - done);
}

Progress::Progress(const std::string& what, int total)
    : what_(printable(what)), total_(std::max(total, 1)), terminal_(::isatty(2) != 0), start_(Clock::now()) {
    if (terminal_) print();
}

Progress::~Progress() {
    if (terminal_) std::fputc('\n', stderr);
}

void Progress::reach(int done) {
    if (done <= done_) return;
    const Clock::time_point current = Clock::now();
    done_ = std::min(done, total_);
    // from the first step on, which has what is done once: drivers compile in it
    left_.reach(done_, std::chrono::duration<double>(current - start_).count());
    if (terminal_ && (done_ == total_ || current - printed_ > std::chrono::milliseconds(100))) {
        printed_ = current;
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
    what_ = printable(what);
    if (terminal_) print();
}

void Progress::print() {
    const Clock::time_point current = Clock::now();
    const double seconds = std::chrono::duration<double>(current - start_).count();
    const double left = done_ == 1 ? seconds * (total_ - 1) : left_.seconds(total_);
    if (!terminal_) {
        const std::string time = left < 1 ? "less than 1 s" : concat("about ", roughly(left));
        const std::string rest = done_ < total_ ? concat(", ", time, " left") : "";
        std::fprintf(stderr, "%s: %d of %d, %.1f s%s\n", what_.c_str(), done_, total_, seconds, rest.c_str());
        return;
    }
    const int width = std::clamp(38 - int(what_.size()), 8, 32);  // a line has 80 letters
    std::string bar(size_t(width * done_ / total_), '#');
    bar.resize(size_t(width), '.');
    const std::string rest =
        done_ == 0 ? "starting" : concat(done_ < total_ ? roughly(left) : "0 s", " left");
    std::fprintf(stderr, "\r%s [%s] %d/%d  %s   ", what_.c_str(), bar.c_str(), done_, total_, rest.c_str());
    std::fflush(stderr);
}

Busy busyWith() {
    const gpu::FirstUse compiled = gpu::firstUse();
    if (compiled.label.empty()) return activity();
    const std::string what = concat("compiling \"", compiled.label, "\"");
    if (compiled.expected <= 0) return {what, compiled.seconds, 0};
    constexpr double last = 0.99;  // until it is done
    return {concat(what, ", about ", roughly(compiled.expected)), compiled.seconds,
            std::min(compiled.seconds / compiled.expected, last)};
}

BusyWatch::BusyWatch(std::function<void(const std::string&)> tell, std::chrono::milliseconds patience)
    : tell_(std::move(tell)), patience_(patience), thread_([this] { watch(); }) {}

void BusyWatch::say(const std::string& what) {
    std::fprintf(stderr, "shoal: %s\n", printable(what).c_str());
}

BusyWatch::~BusyWatch() {
    {
        const std::lock_guard lock(guard_);
        ends_ = true;
    }
    end_.notify_all();
    thread_.join();
}

void BusyWatch::watch() {
    leaveSignalsToMain();
    std::unique_lock lock(guard_);
    while (!end_.wait_for(lock, patience_ / 20, [this] { return ends_; }))
        show(busyWith());
    bar_.reset();
}

void BusyWatch::show(const Busy& busy) {
    const bool waits = !busy.what.empty() && busy.seconds >= std::chrono::duration<double>(patience_).count();
    const int percent = int(100 * busy.share);
    if (!waits || percent < percent_ || busy.what != barOf_) bar_.reset();  // or the same begins anew, finer
    percent_ = percent;
    barOf_ = busy.what;
    if (!waits) return;
    const bool isNew = told_.insert(busy.what).second;
    if (percent > 0 && ::isatty(2) != 0) {
        if (!bar_) bar_.emplace(busy.what, 100);
        bar_->reach(percent);
    } else if (isNew) {
        tell_(busy.what);
    }
}

std::string roughly(double seconds) {
    if (seconds < 90) return concat(std::max(1, int(std::lround(seconds))), " s");
    return concat(std::lround(seconds / 60), " minutes");
}

void tellWarnings(const std::vector<Warning>& warnings) {
    for (const Warning& warning : warnings)
        std::cerr << "shoal: warning: " << text(warning) << "\n";
}

}  // namespace shoal
