#include "bench/rates.h"

#include <filesystem>

#include "core/cache_folder.h"
#include "core/file.h"
#include "core/json_build.h"
#include "measure/timing.h"

namespace shoal::bench {

namespace {

constexpr int copiedQuads = 1 << 20, leastSamples = 5, mostSamples = 200;
constexpr double secondsOfRate = 0.3;  // a short sample finds a quiet moment

// s a frame, the shortest; the device's own time where that can be had.
double fastestFrame(BenchRunner& runner, const BenchDevice& device) {
    runner.run(1);  // compiles, touches memory
    gpu::DeviceTimer timer;
    double best = 0;
    const measure::Clock::time_point start = measure::Clock::now();
    for (int i = 0; i < mostSamples; ++i) {
        if (i >= leastSamples && measure::secondsSince(start) > secondsOfRate) break;
        const double own = device.ownTimes ? timer.secondsOf([&] { runner.frame(); })
                                           : measure::secondsOf([&] { runner.run(1); });
        if (i == 0 || own < best) best = own;
    }
    return best;
}

DeviceRates measureRates(const BenchDevice& device) {
    BenchCase benchCase;
    benchCase.subject = Subject::kernelCopy;
    benchCase.molecule = "quad";
    benchCase.count = copiedQuads;
    const Molecule quad = cloth(2);  // of as many vertices
    BenchCase small = benchCase;
    small.count = 1;
    const BenchStart none(small, quad, 1);  // copies begin anywhere
    DeviceRates out;
    {
        const auto copy = makeRunner(benchCase, quad, none, device);
        out.bytesPerSecond = double(copy->movedBytes) / fastestFrame(*copy, device);
    }
    benchCase.subject = Subject::multiplyAdd;
    const auto compute = makeRunner(benchCase, quad, none, device);
    out.operationsPerSecond = compute->operations / fastestFrame(*compute, device);
    return out;
}

std::optional<DeviceRates> loadRates(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::exists(file, none)) return std::nullopt;
    try {
        const JsonValue value = readJson(file.string());
        JsonReader reader(value, file.string());
        DeviceRates out;
        reader.need("bytesPerSecond", out.bytesPerSecond, Range::atLeast(1));
        reader.need("operationsPerSecond", out.operationsPerSecond, Range::atLeast(1));
        out.kept = true;
        return out;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace

std::optional<DeviceRates> deviceRates(const BenchDevice& device, const std::string& processor,
                                       const std::string& folder) {
    const gpu::ContextInfo& info = device.context->info();
    if (!info.computeShaders) return std::nullopt;
    const std::string key = contentKey(
        concat("rates 1\n", info.vendor, "\n", info.renderer, "\n", info.version, "\n", processor));
    const std::filesystem::path file = std::filesystem::path(folder) / "rates" / (key + ".json");
    if (!folder.empty())
        if (const std::optional<DeviceRates> kept = loadRates(file)) return kept;
    const DeviceRates out = measureRates(device);
    if (folder.empty()) return out;
    try {
        writeFile(file, writeJson(object(shoal::key("bytesPerSecond", out.bytesPerSecond),
                                         shoal::key("operationsPerSecond", out.operationsPerSecond))));
    } catch (const Error&) {
        // as every cache: what cannot be kept is measured again
    }
    return out;
}

}  // namespace shoal::bench
