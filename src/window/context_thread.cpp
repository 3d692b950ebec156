#include "window/context_thread.h"

#include <utility>

#include "core/contract.h"
#include "run/signals.h"

namespace shoal::window {

ContextThread::ContextThread(gpu::Context& context) : context_(context) {
    context_.leave();
    thread_ = std::thread([this] { go(); });
    begin([this] { context_.makeCurrent(); });
    finish();
}

ContextThread::~ContextThread() {
    {
        const std::lock_guard lock(guard_);
        ends_ = true;
    }
    changed_.notify_all();
    thread_.join();
    context_.makeCurrent();
}

void ContextThread::begin(std::function<void()> work) {
    {
        const std::lock_guard lock(guard_);
        EXPECTS(!work_);
        work_ = std::move(work);
    }
    changed_.notify_all();
}

bool ContextThread::waits(std::chrono::milliseconds time) {
    std::unique_lock lock(guard_);
    return changed_.wait_for(lock, time, [this] { return !work_; });
}

void ContextThread::finish() {
    std::unique_lock lock(guard_);
    changed_.wait(lock, [this] { return !work_; });
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, {}));
}

void ContextThread::go() {
    leaveSignalsToMain();
    std::unique_lock lock(guard_);
    while (true) {
        changed_.wait(lock, [this] { return ends_ || work_; });
        if (!work_) break;
        lock.unlock();
        try {
            work_();
        } catch (...) {
            thrown_ = std::current_exception();
        }
        lock.lock();
        work_ = nullptr;
        changed_.notify_all();
    }
    context_.leave();
}

}  // namespace shoal::window
