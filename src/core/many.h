// Counts in messages: "1 spring", "2 springs".
#pragma once

#include <cstdint>
#include <string>

namespace shoal {

inline std::string many(int64_t count, const char* one, const char* several) {
    return std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace shoal
