#include "core/memory.h"

#include <fstream>
#include <limits>
#include <string>

namespace shoal {

int64_t availableMemory() {
    std::ifstream in("/proc/meminfo");
    std::string key, unit;
    int64_t kibibytes = 0;
    while (in >> key >> kibibytes && std::getline(in, unit))
        if (key == "MemAvailable:") return kibibytes << 10;
    return std::numeric_limits<int64_t>::max();
}

}  // namespace shoal
