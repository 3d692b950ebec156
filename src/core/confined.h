// Strangers' files, read by others' code: in a child process with limits of time and memory. What crashes,
// hangs or takes all memory there is one error here.
//
// The child is a fork without exec, so that programs which use the library need nothing beside it. It may
// touch memory, files and its pipe, but no OpenGL context and no thread of the parent's; it leaves with
// _exit().
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "core/child_process.h"
#include "core/error.h"

namespace shoal {

// Limits what the child takes: a base, more with every byte of the files that it opens, never more than the
// most. Under AddressSanitizer, which reserves terabytes, memory has no limit.
struct ConfinedLimits {
    double memory = 512e6, memoryPerByte = 100, mostMemory = 16e9;  // bytes, beyond what the parent has
    double seconds = 2, secondsPerByte = 3e-6, mostSeconds = 900;   // of processor time
    double waiting = 60, waitingBySeconds = 20;                     // s on the clock, by those of work

    double memoryFor(double fileBytes) const {
        return std::min(memory + memoryPerByte * fileBytes, mostMemory);
    }
    double secondsFor(double fileBytes) const {
        return std::round(std::min(seconds + secondsPerByte * fileBytes, mostSeconds));
    }
    double clockFor(double fileBytes) const { return waiting + waitingBySeconds * secondsFor(fileBytes); }
};

// In the child: what it hands to its parent.
class ToParent {
  public:
    ToParent(int pipe, const ConfinedLimits& limits, double memoryBefore)
        : pipe_(pipe), limits_(limits), memoryBefore_(memoryBefore) {}
    // A file was opened: the limits grow.
    void opened(uint64_t fileBytes);
    template <typename T>
    void put(const std::vector<T>& array) {
        static_assert(std::is_trivially_copyable_v<T>);
        record('A', array.data(), array.size() * sizeof(T));
    }
    void refuse(const std::string& message, int line = 0);  // of the file; 0: not known
    void limit() const;

  private:
    void record(char kind, const void* data, uint64_t bytes);
    void write(const void* data, size_t bytes);

    int pipe_;
    ConfinedLimits limits_;
    double memoryBefore_, fileBytes_ = 0;
};

class Confined {
  public:
    // Starts `work` in a child. An Error that it throws comes out of get(), located at `file`, in its line
    // where it is of that file.
    Confined(const Location& file, const ConfinedLimits& limits, const std::function<void(ToParent&)>& work);
    ~Confined();  // ends the child, if it is still at work, and takes its status
    Confined(const Confined&) = delete;
    Confined& operator=(const Confined&) = delete;

    // Returns the next array, in the order in which the child puts them. Error, located at the file: the
    // child threw one, it crashed, or it needed more time or memory than its files allow.
    template <typename T>
    std::vector<T> get() {
        static_assert(std::is_trivially_copyable_v<T>);
        const uint64_t bytes = nextArray(sizeof(T));
        std::vector<T> out(size_t(bytes / sizeof(T)));
        read(out.data(), size_t(bytes));
        return out;
    }

  private:
    uint64_t nextArray(size_t elementBytes);
    void read(void* data, size_t bytes);
    [[noreturn]] void fail(const std::string& message) const;
    [[noreturn]] void failEnded();
    [[noreturn]] void failTime(double seconds, const char* what) const;
    std::string filesText() const;

    Location file_;
    ConfinedLimits limits_;
    std::unique_ptr<ChildProcess> child_;
    int pipe_ = -1;
    double start_, fileBytes_ = 0, taken_ = 0;
};

}  // namespace shoal
