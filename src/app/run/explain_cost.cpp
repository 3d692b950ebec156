// `shoal explain --cost`: what each kernel moves and computes, and which of the two bounds it on this device.
#include <algorithm>
#include <cmath>

#include "app/run/explain.h"
#include "core/cache_folder.h"
#include "core/data_paths.h"
#include "core/table.h"
#include "simulate/fused.h"

namespace shoal::app {

using namespace bench;

namespace {

// s of a frame, at the least.
double memorySeconds(const KernelCost& cost, const DeviceRates& rates) {
    return cost.bytes * cost.molecules / rates.bytesPerSecond;
}
double arithmeticSeconds(const KernelCost& cost, const DeviceRates& rates) {
    return cost.operations * cost.molecules / rates.operationsPerSecond;
}

// Names the bound of a kernel from below. A GPU's registers go first where a lane wants more than there are.
const char* boundOf(const KernelCost& cost, const SceneCost& all) {
    if (!all.rates) return "not known";
    if (!all.software && cost.spills()) return "registers";
    return memorySeconds(cost, *all.rates) > arithmeticSeconds(cost, *all.rates) ? "memory" : "arithmetic";
}

JsonValue asJson(const KernelCost& cost, const SceneCost& all) {
    std::optional<double> memory, arithmetic, occupancy;
    if (all.rates) memory = memorySeconds(cost, *all.rates), arithmetic = arithmeticSeconds(cost, *all.rates);
    if (!all.software) occupancy = cost.occupancy;
    return object(
        key("group", cost.group), key("molecules", cost.molecules), key("lanes", name(cost.lanes)),
        key("draws", cost.draws), key("bytesPerMolecule", cost.bytes),
        key("operationsPerMolecule", cost.operations), key("stateFetchesPerMolecule", cost.stateFetches),
        key("tableFetchesPerMolecule", cost.tableFetches), key("sharedBytes", cost.sharedBytes),
        key("estimatedRegisters", cost.registers), key("estimatedOccupancy", occupancy),
        key("memorySeconds", memory), key("arithmeticSeconds", arithmetic), key("bound", boundOf(cost, all)));
}

constexpr Column kernelColumns[] = {{"group", "group", -20},
                                    {"lanes", "a lane a", 10},
                                    {"bytesPerMolecule", "bytes", 9, "%.0f"},
                                    {"operationsPerMolecule", "operations", 12, "%.0f"},
                                    {"stateFetchesPerMolecule", "state fetches", 15, "%.0f"},
                                    {"tableFetchesPerMolecule", "table fetches", 15, "%.0f"},
                                    {"sharedBytes", "shared", 8, "%.0f"},
                                    {"estimatedRegisters", "registers", 11, "%.0f"},
                                    {"estimatedOccupancy", "occupancy", 11, "%.0f%%", 100},
                                    {"memorySeconds", "memory ms", 11, "%.3g", 1e3},
                                    {"arithmeticSeconds", "arithmetic ms", 15, "%.3g", 1e3},
                                    {"bound", "bound", 12}};

}  // namespace

SceneCost sceneCost(const Options& options, const Loaded& loaded) {
    gpu::Context context(hiddenContext(options));
    const PathLimits limits = limitsOf(context.info());
    const PathChoice choice = choosePath(loaded.plan, options.path, limits, options.lanes);
    if (choice.path == Path::pingPong)
        throw WrongUse("--cost is of the fused path's kernels; this scene runs on the other path: " +
                       choice.why);
    BenchDevice device;
    device.context = &context;
    device.ownTimes = !context.info().software;
    SceneCost out{bench::measuredOn(context, SHOAL_VERSION), context.info().software,
                  deviceRates(device, bench::processorName(), cacheFolder()),
                  kernelCosts(loaded.scene, loaded.plan, choice, limits)};
    context.checkErrors("--cost");
    return out;
}

std::string asText(const SceneCost& all) {
    std::string out = asText(all.machine) + "\n";
    if (all.rates)
        out += formatted("a kernel that copies: %.3g GB/s; one that multiplies and adds: %.3g Gop/s (%s)\n",
                         all.rates->bytesPerSecond * 1e-9, all.rates->operationsPerSecond * 1e-9,
                         all.rates->kept ? "kept from before" : "measured now");
    else
        out += "no rates: copies and multiply-adds are measured with compute shaders (OpenGL 4.3)\n";
    out += "\nof a molecule and frame; ms: what all of them take at the least, at those rates\n";
    out += tableText(kernelColumns, asJson(all).find("kernels")->items);
    return out +
           "\nBytes, fetches and shared memory (of a workgroup, bytes) follow from the layout. Operations "
           "are "
           "counted from\nmolecule, solver, fields and colliders, about right within a factor of two; "
           "contacts "
           "that are found,\nforces, births, steering and contact between molecules are not counted. "
           "Registers "
           "are an estimate, of the\nvectors that a lane keeps; occupancy follows from them for 65,536 "
           "registers, 2,048 lanes and 100 KiB of\nshared memory a multiprocessor.\n";
}

JsonValue asJson(const SceneCost& all) {
    JsonValue kernels = JsonValue::makeArray(), rates;
    for (const KernelCost& cost : all.kernels)
        kernels.items.push_back(asJson(cost, all));
    if (all.rates)
        rates =
            object(key("bytesPerSecond", all.rates->bytesPerSecond),
                   key("operationsPerSecond", all.rates->operationsPerSecond), key("kept", all.rates->kept));
    return object(key("renderer", all.machine.context.renderer), key("rates", rates),
                  key("kernels", kernels));
}

}  // namespace shoal::app
