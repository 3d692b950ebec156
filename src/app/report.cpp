#include "app/report.h"

#include <cstdio>

#include "core/error.h"
#include "core/printable.h"

namespace shoal::app {

static JsonValue asJson(const gpu::Traffic& traffic) {
    JsonValue out = JsonValue::makeObject();
    for (int i = 0; i < gpu::Traffic::kinds; ++i) {
        JsonValue entry = JsonValue::makeObject();
        entry.add("uploaded", JsonValue::makeNumber(double(traffic.uploaded[i])))
            .add("readBack", JsonValue::makeNumber(double(traffic.readBack[i])));
        out.add(gpu::Traffic::names[i], std::move(entry));
    }
    return out;
}

static JsonValue asJson(const std::vector<GroupLives>& lives) {
    JsonValue out = JsonValue::makeArray();
    for (const auto& [group, counts] : lives) {
        JsonValue entry = JsonValue::makeObject();
        entry.add("group", JsonValue::makeString(group))
            .add("capacity", JsonValue::makeNumber(counts.capacity))
            .add("living", JsonValue::makeNumber(counts.live))
            .add("reach", JsonValue::makeNumber(counts.mark))
            .add("born", JsonValue::makeNumber(double(counts.born)))
            .add("lost", JsonValue::makeNumber(double(counts.lost)));
        out.items.push_back(std::move(entry));
    }
    return out;
}

std::vector<GroupLives> livesOf(const Simulation& simulation) {
    std::vector<GroupLives> out;
    const std::vector<GroupPlan>& groups = simulation.plan().groups;
    for (size_t g = 0; g < groups.size(); ++g)
        if (groups[g].needs.life) out.push_back({groups[g].name, simulation.lifeCounts(g)});
    return out;
}

std::string text(const GroupLives& lives) {
    const LifeCounts& n = lives.counts;
    return concat(
        printable(lives.group), ": ", n.live, " of ", n.capacity, " places taken, ", n.born, " born",
        n.lost > 0
            ? concat(", ", n.lost, " lost (no place was free: a larger \"capacity\" or --count holds more)")
            : "");
}

JsonValue asJson(const std::vector<gpu::PassTime>& passes) {
    JsonValue out = JsonValue::makeArray();
    for (const gpu::PassTime& pass : passes) {
        JsonValue entry = JsonValue::makeObject();
        entry.add("pass", JsonValue::makeString(pass.name))
            .add("callsPerFrame", JsonValue::makeNumber(pass.calls))
            .add("minSeconds", JsonValue::makeNumber(pass.min))
            .add("medianSeconds", JsonValue::makeNumber(pass.median));
        out.items.push_back(std::move(entry));
    }
    return out;
}

JsonValue asJson(const RunReport& report, Simulation& simulation, const std::vector<gpu::PassTime>& times,
                 uint64_t hash) {
    const gpu::ContextInfo& info = simulation.context().info();
    JsonValue context = JsonValue::makeObject();
    context.add("kind", JsonValue::makeString(gpu::name(info.kind)))
        .add("renderer", JsonValue::makeString(info.renderer))
        .add("version", JsonValue::makeString(info.version));

    JsonValue bytes = JsonValue::makeObject();
    bytes.add("start", asJson(report.start))
        .add("frames", asJson(report.frames))
        .add("outside", asJson(report.outside));

    JsonValue written = JsonValue::makeArray();
    for (const std::string& file : report.written)
        written.items.push_back(JsonValue::makeString(file));

    char hashText[20];
    std::snprintf(hashText, sizeof hashText, "%016llx", static_cast<unsigned long long>(hash));
    JsonValue out = JsonValue::makeObject();
    out.add("scene", JsonValue::makeString(report.scene))
        .add("path", JsonValue::makeString(name(simulation.path().path)))
        .add("context", std::move(context))
        .add("frames", JsonValue::makeNumber(simulation.frames()))
        .add("time", JsonValue::makeNumber(simulation.time()))
        .add("seconds", JsonValue::makeNumber(report.seconds))
        .add("stateBytes", JsonValue::makeNumber(double(simulation.stateBytes())))
        .add("busBytes", std::move(bytes))
        .add("hash", JsonValue::makeString(hashText));
    if (!times.empty()) out.add("passes", asJson(times));
    out.add("written", std::move(written));
    if (!report.lives.empty()) out.add("lives", asJson(report.lives));
    if (simulation.contact())
        out.add("contactBytes", JsonValue::makeNumber(double(simulation.contact()->bytes())))
            .add("contactsDropped", JsonValue::makeNumber(simulation.contact()->dropped()));
    return out;
}

}  // namespace shoal::app
