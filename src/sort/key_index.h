// Defines the pair that is sorted by its key.
#pragma once

#include <cstdint>

namespace shoal {

struct KeyIndex {
    uint32_t key = 0, index = 0;
    bool operator==(const KeyIndex&) const = default;
};

}  // namespace shoal
