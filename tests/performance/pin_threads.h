// A CPU rasteriser's worker threads, left alone, share one core half of the time: up to twice the noise.
#pragma once

#include <sched.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

// Ties the process's llvmpipe workers to one core each, in turn. Returns how many there were.
inline int pinRasteriserThreads() {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    int pinned = 0;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
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
