// A thread that alone uses a context, so that the thread of the window can go on while a driver compiles.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "gpu/context.h"

namespace shoal::window {

class ContextThread {
  public:
    // Takes the context, which is current, over from the calling thread, until this is destroyed there.
    explicit ContextThread(gpu::Context& context);
    ~ContextThread();
    ContextThread(const ContextThread&) = delete;
    ContextThread& operator=(const ContextThread&) = delete;

    // Begins work after the last was finished.
    void begin(std::function<void()> work);
    // Waits for the work; false: it is not done within that time.
    bool waits(std::chrono::milliseconds time);
    // Waits for the work, and throws what it threw.
    void finish();

  private:
    void go();

    gpu::Context& context_;
    std::mutex guard_;
    std::condition_variable changed_;
    std::function<void()> work_;  // empty: there is none
    std::exception_ptr thrown_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace shoal::window
