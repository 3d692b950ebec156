#include <iomanip>
#include <sstream>

#include "compile/plan.h"
#include "core/json.h"

namespace shoal {

namespace {

const char* when(PassPlan::When moment) {
    static constexpr const char* words[] = {"once a frame, first", "every substep", "once a frame, last"};
    return words[size_t(moment)];
}

std::string mebibytes(size_t bytes) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(2) << double(bytes) / (1 << 20) << " MiB";
    return out.str();
}

}  // namespace

std::string explain(const Plan& plan) {
    std::ostringstream out;
    if (!plan.sceneName.empty()) out << plan.sceneName << "\n";
    out << "frame    1/" << plan.frameRate << " s in " << plan.substeps << " substeps of "
        << 1 / plan.frameRate / plan.substeps << " s, solver " << name(plan.solver) << "\n";
    out << "memory   state " << mebibytes(plan.stateBytes()) << ", tables " << mebibytes(plan.tableBytes())
        << "\n";
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        out << "\ngroup \"" << group.name << "\": " << group.count << " molecules of " << group.vertexCount
            << " vertices\n";
        if (group.needs.springs)
            out << "  highest frequency " << group.highestFrequency << " rad/s; " << name(plan.solver)
                << " is stable up to " << group.stableStep << " s\n";
        for (const PassPlan& pass : plan.passes) {
            if (pass.group != g) continue;
            out << "  " << std::left << std::setw(9) << name(pass.kind) << std::setw(21) << when(pass.when)
                << pass.why << "\n";
        }
        std::string absent;
        const auto without = [&](bool need, const char* what) {
            if (!need) absent += (absent.empty() ? "" : ", ") + std::string(what);
        };
        without(group.needs.springs, "no springs: no restore");
        without(group.needs.collide, "no colliders: no collide");
        without(group.needs.drag, "no drag: no field is read");
        without(group.needs.fields || !group.needs.drag, "no fields");
        without(group.needs.normals, "no triangles: no normals");
        without(group.needs.records, "all molecules hang on pins: no records");
        if (!absent.empty()) out << "  left out: " << absent << "\n";
    }
    return out.str();
}

JsonValue explainJson(const Plan& plan) {
    JsonValue groups = JsonValue::makeArray();
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        JsonValue passes = JsonValue::makeArray();
        for (const PassPlan& pass : plan.passes) {
            if (pass.group != g) continue;
            JsonValue entry = JsonValue::makeObject();
            entry.add("pass", JsonValue::makeString(name(pass.kind)))
                .add("when", JsonValue::makeString(when(pass.when)))
                .add("why", JsonValue::makeString(pass.why));
            passes.items.push_back(std::move(entry));
        }
        JsonValue entry = JsonValue::makeObject();
        entry.add("name", JsonValue::makeString(group.name))
            .add("molecules", JsonValue::makeNumber(group.count))
            .add("vertices", JsonValue::makeNumber(group.vertexCount));
        if (group.needs.springs)
            entry.add("highestFrequency", JsonValue::makeNumber(group.highestFrequency))
                .add("stableStep", JsonValue::makeNumber(group.stableStep));
        entry.add("passes", std::move(passes));
        groups.items.push_back(std::move(entry));
    }
    JsonValue out = JsonValue::makeObject();
    out.add("scene", JsonValue::makeString(plan.sceneName))
        .add("solver", JsonValue::makeString(name(plan.solver)))
        .add("frameRate", JsonValue::makeNumber(plan.frameRate))
        .add("substeps", JsonValue::makeNumber(plan.substeps))
        .add("stateBytes", JsonValue::makeNumber(double(plan.stateBytes())))
        .add("tableBytes", JsonValue::makeNumber(double(plan.tableBytes())))
        .add("groups", std::move(groups));
    return out;
}

}  // namespace shoal
