// The rates of a device when it only copies, and when it only computes: measured once and kept.
#pragma once

#include <optional>
#include <string>

#include "bench/runner.h"

namespace shoal::bench {

struct DeviceRates {
    double bytesPerSecond = 0;       // read and written, by a kernel that copies 100 MB
    double operationsPerSecond = 0;  // a multiplication or an addition each
    bool kept = false;               // from a file of the folder
};

// From <folder>/rates/<key>.json, which is made where it is missing; an empty folder keeps nothing. The key
// says device, driver and processor. Takes about a second, and should find the
// device with nothing else to do: what is kept is as good as that moment. Nothing below OpenGL 4.3.
// Error: out of memory, the driver refuses a shader.
std::optional<DeviceRates> deviceRates(const BenchDevice& device, const std::string& processor,
                                       const std::string& folder);

}  // namespace shoal::bench
