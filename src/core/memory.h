// How much memory there is, and errors that say what took it.
#pragma once

#include <cstdint>
#include <new>
#include <string>

#include "core/error.h"

namespace shoal {

// Returns the bytes that programs can still take without others being swapped out; nothing known: the largest
// number.
int64_t availableMemory();

// The most bytes of address space that this process has had; 0: nothing tells.
int64_t mostMemoryTaken();

// Does work that takes about so many bytes. Error, located at `where`, in place of std::bad_alloc: `what`
// does not fit.
template <typename Work>
void namingMemory(const Location& where, const std::string& what, double bytes, const Work& work) {
    try {
        work();
    } catch (const std::bad_alloc&) {
        throw Error(where, "there is not enough memory for ", what, ", which take about ",
                    mebibytes(size_t(bytes)));
    }
}

}  // namespace shoal
