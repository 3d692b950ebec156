#include "app/machine.h"

#include <algorithm>
#include <fstream>

#include "core/error.h"

namespace shoal::app {

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

std::string roughly(double seconds) {
    if (seconds < 90) return concat(std::max(1, int(seconds + 0.5)), " s");
    return concat(int(seconds / 60 + 0.5), " minutes");
}

}  // namespace shoal::app
