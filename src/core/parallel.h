// Independent pieces of work on several threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace shoal {

// Calls work(piece) for each of 0 .. pieces - 1, in any order. The first exception comes out.
template <typename Work>
void parallel(int pieces, int threads, Work&& work) {
    std::atomic<int> next{0};
    std::mutex guard;
    std::exception_ptr failure;
    const auto run = [&] {
        try {
            for (int piece; (piece = next++) < pieces;)
                work(piece);
        } catch (...) {
            const std::lock_guard lock(guard);
            if (!failure) failure = std::current_exception();
            next = pieces;
        }
    };
    std::vector<std::thread> helpers;
    for (int i = 1; i < std::min(threads, pieces); ++i)
        helpers.emplace_back(run);
    run();
    for (std::thread& helper : helpers)
        helper.join();
    if (failure) std::rethrow_exception(failure);
}

// As many as the machine runs at once.
inline int allThreads() {
    return int(std::clamp(std::thread::hardware_concurrency(), 1u, 64u));
}

}  // namespace shoal
