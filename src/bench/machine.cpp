#include "bench/machine.h"

#include <algorithm>
#include <fstream>
#include <thread>

namespace shoal::bench {

void appendDeviceTime(JsonValue& out, const measure::Spread& device) {
    std::optional<double> min, median;
    if (device.samples > 0) min = device.min, median = device.median;
    append(out, key("deviceMinSeconds", min), key("deviceMedianSeconds", median));
}

std::string processorName() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(": ");
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown processor";
}

MeasuredOn measuredOn(const gpu::Context& context, const std::string& version) {
    return {version, processorName(), int(std::max(1u, std::thread::hardware_concurrency())), 0,
            context.info()};
}

std::string asText(const MeasuredOn& machine) {
    std::string out =
        concat(machine.processor, ", ", machine.cores, machine.cores == 1 ? " core; " : " cores; ",
               machine.context.renderer, ", OpenGL ", machine.context.version);
    if (machine.pinned > 0) out += concat("; ", machine.pinned, " rasteriser threads pinned");
    return out;
}

JsonValue asJson(const gpu::ContextInfo& context) {
    return object(key("kind", gpu::name(context.kind)), key("renderer", context.renderer),
                  key("version", context.version), key("software", context.software));
}

JsonValue headOf(const MeasuredOn& machine) {
    return object(key("version", machine.version), key("processor", machine.processor),
                  key("cores", machine.cores), key("pinnedRasteriserThreads", machine.pinned),
                  key("renderer", machine.context.renderer), key("openGL", machine.context.version));
}

JsonValue asJson(const gpu::PassTime& pass) {
    return object(key("stage", pass.name), key("callsPerFrame", pass.calls), key("minSeconds", pass.min),
                  key("medianSeconds", pass.median));
}

}  // namespace shoal::bench
