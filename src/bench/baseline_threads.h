// The baselines on the CPU share these: a team of threads, one core each, that takes up work within a
// microsecond while it is kept busy; memory for vectors.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <new>
#include <thread>
#include <utility>
#include <vector>

namespace shoal::bench {

// Floats, 0 at first, that begin with a cache line, and so with an AVX-512 vector.
class AlignedFloats {
  public:
    AlignedFloats() = default;
    explicit AlignedFloats(size_t count) : data_(new (alignment) float[count]()) {}
    float* data() const { return data_.get(); }

  private:
    static constexpr std::align_val_t alignment{64};
    struct Free {
        void operator()(float* p) const { operator delete[](p, alignment); }
    };
    std::unique_ptr<float[], Free> data_;
};

class PinnedThreads {
  public:
    explicit PinnedThreads(int count);  // the caller's own thread is the first of them
    ~PinnedThreads();
    PinnedThreads(const PinnedThreads&) = delete;
    PinnedThreads& operator=(const PinnedThreads&) = delete;

    int count() const { return int(workers_.size()) + 1; }
    // Which of so many pieces of work a thread takes: the first, and the one behind the last.
    std::pair<size_t, size_t> part(size_t all, int index) const {
        const auto n = size_t(count());
        return {all * size_t(index) / n, all * size_t(index + 1) / n};
    }
    // Calls work(0) here, work(1) and so on elsewhere, and waits for all. The caller's thread is tied to its
    // core meanwhile, and may run where it could before when this returns.
    void run(const std::function<void(int)>& work);

  private:
    void wait(int index);

    std::vector<int> cores_;  // that the process may use
    std::vector<std::thread> workers_;
    const std::function<void(int)>* work_ = nullptr;
    std::atomic<unsigned> round_{0};
    std::atomic<int> busy_{0};
    std::atomic<bool> ends_{false};
};

}  // namespace shoal::bench
