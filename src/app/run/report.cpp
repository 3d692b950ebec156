#include "app/run/report.h"

#include "core/error.h"
#include "core/printable.h"

namespace shoal::app {

static JsonValue asJson(const gpu::Traffic& traffic) {
    JsonValue out = object();
    for (int i = 0; i < gpu::Traffic::kinds; ++i)
        append(out, key(gpu::Traffic::names[i],
                        object(key("uploaded", traffic.uploaded[i]), key("readBack", traffic.readBack[i]))));
    return out;
}

static JsonValue asJson(const GroupLives& lives) {
    const LifeCounts& n = lives.counts;
    return object(key("group", lives.group), key("capacity", n.capacity), key("living", n.live),
                  key("reach", n.mark), key("born", n.born), key("lost", n.lost));
}

std::vector<GroupLives> livesOf(const Simulation& simulation) {
    std::vector<GroupLives> out;
    const std::vector<GroupPlan>& groups = simulation.plan().groups;
    for (size_t g = 0; g < groups.size(); ++g)
        if (groups[g].needs.life)
            out.push_back({groups[g].name, simulation.lifeCounts(g), groups[g].life->cycle.allocator});
    return out;
}

std::string text(const GroupLives& lives) {
    const LifeCounts& n = lives.counts;
    const char* why = lives.allocator == Allocator::ring ? "cut short (the ring gives the oldest place away"
                                                         : "lost (no place was free";
    const std::string lost =
        n.lost > 0 ? concat(", ", n.lost, " ", why, ": a larger \"capacity\" or --count holds more)") : "";
    return concat(printable(lives.group), ": ", n.live, " of ", n.capacity, " places taken, ", n.born,
                  " born", lost);
}

JsonValue asJson(const RunReport& report, Simulation& simulation, const std::vector<gpu::PassTime>& times,
                 uint64_t hash) {
    const gpu::ContextInfo& info = simulation.context().info();
    const JsonValue context = object(key("kind", gpu::name(info.kind)), key("renderer", info.renderer),
                                     key("version", info.version));
    const JsonValue bytes = object(key("start", asJson(report.start)), key("frames", asJson(report.frames)),
                                   key("outside", asJson(report.outside)));
    JsonValue out = object(key("scene", report.scene), key("path", name(simulation.path().path)),
                           key("context", context), key("frames", simulation.frames()),
                           key("time", simulation.time()), key("seconds", report.seconds),
                           key("stateBytes", simulation.stateBytes()), key("busBytes", bytes),
                           key("hash", formatted("%016llx", static_cast<unsigned long long>(hash))));
    if (!times.empty()) append(out, key("stages", arrayOf(times, bench::asJson)));
    append(out, key("written", report.written));
    if (!report.lives.empty()) append(out, key("lives", arrayOf(report.lives, asJson)));
    if (const ContactResult* contact = simulation.contact()) {
        const ContactConvergence ended = contact->convergence();
        append(out, key("contactBytes", contact->bytes()), key("contactsDropped", contact->dropped()),
               key("contactIterations", ended.iterations), key("contactResidual", ended.residual));
    }
    return out;
}

}  // namespace shoal::app
