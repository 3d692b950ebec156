// A team of threads, one core each, that takes up work within a microsecond while it is kept busy.
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace shoal::bench {

class PinnedThreads {
  public:
    explicit PinnedThreads(int count);  // the caller's own thread is the first of them
    ~PinnedThreads();
    PinnedThreads(const PinnedThreads&) = delete;
    PinnedThreads& operator=(const PinnedThreads&) = delete;

    int count() const { return int(workers_.size()) + 1; }
    // Calls work(0) here, work(1) and so on elsewhere, and waits for all. The caller's thread is tied to its
    // core meanwhile, and may run where it could before when this returns.
    void run(const std::function<void(int)>& work);
    // s of processor time that the slowest thread spent on the last work: what it takes when no other program
    // wants the cores.
    double slowest() const;

  private:
    void wait(int index);
    void measured(const std::function<void(int)>& work, int index);

    std::vector<int> cores_;  // that the process may use
    std::vector<std::thread> workers_;
    std::vector<double> seconds_;  // per thread
    const std::function<void(int)>* work_ = nullptr;
    std::atomic<unsigned> round_{0};
    std::atomic<int> busy_{0};
    std::atomic<bool> ends_{false};
};

}  // namespace shoal::bench
