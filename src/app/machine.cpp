#include "app/machine.h"

#include <algorithm>
#include <fstream>
#include <thread>

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

MeasuredOn measuredOn(const gpu::Context& context) {
    return {processorName(), int(std::max(1u, std::thread::hardware_concurrency())), 0, context.info()};
}

std::string asText(const MeasuredOn& machine) {
    std::string out =
        concat(machine.processor, ", ", machine.cores, machine.cores == 1 ? " core; " : " cores; ",
               machine.context.renderer, ", OpenGL ", machine.context.version);
    if (machine.pinned > 0) out += concat("; ", machine.pinned, " rasteriser threads pinned");
    return out;
}

std::string twoLines(const MeasuredOn& machine) {
    return concat(machine.processor, ", ", machine.cores, " cores\n", machine.context.renderer, " (",
                  gpu::name(machine.context.kind), "), OpenGL ", machine.context.version);
}

JsonValue asJson(const gpu::ContextInfo& context) {
    JsonValue out = JsonValue::makeObject();
    return out.add("kind", JsonValue::makeString(gpu::name(context.kind)))
        .add("renderer", JsonValue::makeString(context.renderer))
        .add("version", JsonValue::makeString(context.version))
        .add("software", JsonValue::makeBoolean(context.software));
}

JsonValue headOf(const MeasuredOn& machine) {
    JsonValue out = JsonValue::makeObject();
    out.add("version", JsonValue::makeString(SHOAL_VERSION))
        .add("processor", JsonValue::makeString(machine.processor))
        .add("cores", JsonValue::makeNumber(machine.cores))
        .add("pinnedRasteriserThreads", JsonValue::makeNumber(machine.pinned))
        .add("renderer", JsonValue::makeString(machine.context.renderer))
        .add("openGL", JsonValue::makeString(machine.context.version));
    return out;
}

}  // namespace shoal::app
