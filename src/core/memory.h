// How much memory the machine has left.
#pragma once

#include <cstdint>

namespace shoal {

// Returns the bytes that programs can still take without others being swapped out; nothing known: the largest
// number.
int64_t availableMemory();

}  // namespace shoal
