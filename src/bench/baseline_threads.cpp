#include "bench/baseline_threads.h"

#include <sched.h>

namespace shoal::bench {

namespace {

// Long enough for the next frame of a run, too short to take a core from what is measured next.
constexpr int spins = 20'000;

void relax() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

std::vector<int> usableCores() {
    std::vector<int> out;
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        for (int i = 0; i < CPU_SETSIZE; ++i) {
            if (CPU_ISSET(unsigned(i), &set)) out.push_back(i);
        }
    }
    return out;
}

void pin(const std::vector<int>& cores, int index) {
    if (cores.empty()) return;
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(unsigned(cores[size_t(index) % cores.size()]), &set);
    sched_setaffinity(0, sizeof set, &set);
}

}  // namespace

PinnedThreads::PinnedThreads(int count) : cores_(usableCores()) {
    for (int i = 1; i < count; ++i)
        workers_.emplace_back([this, i] { wait(i); });
}

PinnedThreads::~PinnedThreads() {
    ends_ = true;
    ++round_;
    round_.notify_all();
    for (std::thread& worker : workers_)
        worker.join();
}

void PinnedThreads::wait(int index) {
    pin(cores_, index);
    for (unsigned seen = 0;; ++seen) {
        for (int i = 0; i < spins && round_.load(std::memory_order_acquire) == seen; ++i)
            relax();
        round_.wait(seen, std::memory_order_acquire);
        if (ends_) return;
        (*work_)(index);
        busy_.fetch_sub(1, std::memory_order_acq_rel);
    }
}

void PinnedThreads::run(const std::function<void(int)>& work) {
    cpu_set_t before;
    const bool known = sched_getaffinity(0, sizeof before, &before) == 0;
    pin(cores_, 0);
    work_ = &work;
    busy_ = int(workers_.size());
    ++round_;
    round_.notify_all();
    work(0);
    for (int i = 0; busy_.load(std::memory_order_acquire) != 0; ++i) {
        if (i < spins)
            relax();
        else
            std::this_thread::yield();
    }
    if (known) sched_setaffinity(0, sizeof before, &before);
}

}  // namespace shoal::bench
