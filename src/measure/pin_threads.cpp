#include "measure/pin_threads.h"

#include <sched.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>

namespace shoal::measure {

int pinRasteriserThreads() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    int pinned = 0;
    std::error_code none;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", none)) {
        std::ifstream file(task.path() / "comm");
        std::string name;
        std::getline(file, name);
        if (name.rfind("llvmpipe", 0) != 0) continue;
        cpu_set_t set;
        CPU_ZERO(&set);
        CPU_SET(unsigned(pinned++) % cores, &set);
        sched_setaffinity(std::stoi(task.path().filename().string()), sizeof set, &set);
    }
    return pinned;
}

}  // namespace shoal::measure
