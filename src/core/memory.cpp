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

int64_t mostMemoryTaken() {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("VmPeak:", 0) == 0) return std::stoll(line.substr(7)) << 10;
    return 0;
}

}  // namespace shoal
