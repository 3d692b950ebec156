#include <iomanip>
#include <sstream>

#include "compile/path.h"
#include "core/error.h"
#include "core/json.h"
#include "core/printable.h"

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

static void listPasses(std::ostringstream& out, const Plan& plan, size_t g) {
    for (const PassPlan& pass : plan.passes) {
        if (pass.group != g) continue;
        out << "  " << std::left << std::setw(9) << name(pass.kind) << std::setw(21) << when(pass.when)
            << printable(pass.why) << "\n";
    }
}

// Lists the parts of a group's fused kernel.
static std::string kernelParts(const GroupPlan& group) {
    const Needs& needs = group.needs;
    std::string parts = "motion";
    const auto with = [&](bool need, const char* what) {
        if (need) parts += concat(", ", what);
    };
    with(needs.records && !needs.release, "anchors follow");
    with(needs.release, "anchors follow and pins may be released");
    with(needs.springs, "springs");
    with(needs.actuation, "muscles");
    with(needs.steers, "steering");
    with(needs.gravity, "gravity");
    with(needs.drag && !needs.directionalDrag, "drag");
    with(needs.directionalDrag, "drag by direction");
    with(needs.fields, "fields");
    with(needs.forces, "forces");
    with(needs.wind, "wind");
    with(needs.thrust, "thrust");
    with(needs.collide, "colliders");
    with(needs.normals, "normals where drawn");
    with(needs.life, "death");
    with(true, "watched");
    return parts;
}

// Lists a group's life, its places and its emitters.
static void listBirths(std::ostringstream& out, const GroupPlan& group) {
    if (!group.life) return;
    const Lifecycle& life = group.life->cycle;
    out << "  life     ";
    if (life.life.x >= longestLife)
        out << "for ever";
    else
        out << life.life.x << " to " << life.life.y << " s";
    if (life.within) out << ", dies outside a box";
    if (life.afterContact) out << ", dies " << *life.afterContact << " s after contact";
    out << "; " << group.life->atStart << " of " << life.capacity << " places taken at the start\n";
    if (!group.life->emits()) return;
    out << "  births   once a frame" << std::string(9, ' ') << "allocator " << name(life.allocator) << "\n";
    for (const Emitter& emitter : life.emitters) {
        out << "           from " << name(emitter.from);
        if (emitter.from == Emitter::From::death)
            out << " of \"" << printable(emitter.group) << "\", " << emitter.perDeath << " each";
        else
            out << ", " << emitter.rate << " a second" << (emitter.random ? " at random" : "");
        if (!emitter.bursts.empty()) out << ", " << emitter.bursts.size() << " bursts";
        out << "\n";
    }
}

static std::string leftOut(const GroupPlan& group, bool fused) {
    std::string absent;
    const auto without = [&](bool need, const char* what) {
        if (!need) absent += (absent.empty() ? "" : ", ") + std::string(what);
    };
    without(group.needs.springs, fused ? "no springs" : "no springs: no restore");
    without(group.needs.collide, fused ? "no colliders" : "no colliders: no collide");
    without(group.needs.drag, "no drag: no field is read");
    without(group.needs.fields || !group.needs.drag, "no fields");
    without(group.needs.normals, "no triangles: no normals");
    without(group.needs.records,
            fused ? "all molecules hang on pins: anchors stay" : "all molecules hang on pins: no records");
    return absent;
}

// Returns the kind, and the name where there is one, of each force that acts on a group.
static std::vector<std::string> forceNames(const Plan& plan, const GroupPlan& group) {
    std::vector<std::string> out;
    for (const auto* kind : {&group.forces.pulls, &group.forces.thrusts, &group.forces.winds})
        for (const GroupForces::One& one : *kind) {
            const Force& force = plan.forces[one.force];
            out.push_back(force.name.empty()
                              ? kindName(*force.shape)
                              : concat(kindName(*force.shape), " \"", printable(force.name), "\""));
        }
    return out;
}

static std::string listed(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names)
        out += (out.empty() ? "" : ", ") + name;
    return out;
}

static void tellContact(std::ostringstream& out, const Plan& plan) {
    const ContactPlan& contact = plan.contact;
    if (!contact.any()) return;
    out << "contact  " << contact.spheres << " spheres, found by the " << name(contact.settings.search)
        << " search in cells of " << contact.cell << " m, " << contact.steps
        << (contact.steps == 1 ? " time" : " times") << " a frame, in " << contact.settings.iterations
        << " iterations\n         up to " << contact.safeSpeed(1 / plan.frameRate)
        << " m/s relative to one another none passes through another between two contact steps\n";
}

// Who steers by whom, and in which grids they are found.
static void tellSchool(std::ostringstream& out, const Plan& plan, size_t g) {
    const SchoolMember* member = plan.school.memberOf(g);
    if (!member) return;
    const School& school = member->school;
    out << "  school   once a frame         others within " << school.radius << " m";
    for (const SchoolTarget& target : school.flees)
        out << ", flees \"" << printable(target.group) << "\" within " << target.radius << " m";
    for (const SchoolTarget& target : school.hunts)
        out << ", hunts \"" << printable(target.group) << "\" within " << target.radius << " m";
    if (plan.groups[g].needs.avoids) out << ", turns from colliders within " << school.walls << " m";
    if (school.home) out << ", has a home";
    if (school.depth) out << ", likes y from " << school.depth->x << " to " << school.depth->y << " m";
    out << "; " << 1 + member->targetGrids.size() << (member->targetGrids.empty() ? " grid\n" : " grids\n");
}

std::string explain(const Plan& plan, const PathChoice& choice, bool inPlace) {
    std::ostringstream out;
    if (!plan.sceneName.empty()) out << printable(plan.sceneName) << "\n";
    out << "frame    1/" << plan.frameRate << " s in " << many(plan.substeps, "substep", "substeps") << " of "
        << 1 / plan.frameRate / plan.substeps << " s\n";
    out << "path     " << name(choice.path) << ": " << printable(choice.why) << "\n";
    if (plan.fieldSampling != FieldSampling::vertexSubstep)
        out << "fields   " << name(plan.fieldSampling) << "\n";
    out << "memory   state " << mebibytes(stateBytes(plan, choice.path, true, inPlace)) << ", tables "
        << mebibytes(plan.tableBytes()) << "\n";
    for (const std::string& grid : plan.grids)
        out << "         " << grid << "\n";
    tellContact(out, plan);
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        out << "\ngroup \"" << printable(group.name) << "\": " << many(group.count, "molecule", "molecules")
            << " of " << many(group.vertexCount, "vertex", "vertices") << "\n";
        out << "  solver   " << name(group.solver) << ": " << printable(group.solverWhy) << "\n";
        if (group.needs.springs) {
            out << "  highest frequency " << group.highestFrequency << " rad/s; " << name(group.solver);
            if (solver(group.solver).implicit)
                out << " is stable at any substep\n";
            else
                out << " is stable up to " << group.stableStep << " s\n";
        }
        if (group.forces.any()) out << "  forces   " << listed(forceNames(plan, group)) << "\n";
        if (choice.path == Path::fused)
            out << "  fused    once a frame         " << kernelParts(group) << "\n";
        else
            listPasses(out, plan, g);
        tellSchool(out, plan, g);
        listBirths(out, group);
        const std::string absent = leftOut(group, choice.path == Path::fused);
        if (!absent.empty()) out << "  left out: " << absent << "\n";
    }
    return out.str();
}

static JsonValue passEntry(const char* pass, const char* moment, const std::string& why) {
    JsonValue entry = JsonValue::makeObject();
    entry.add("pass", JsonValue::makeString(pass))
        .add("when", JsonValue::makeString(moment))
        .add("why", JsonValue::makeString(why));
    return entry;
}

JsonValue explainJson(const Plan& plan, const PathChoice& choice, bool inPlace) {
    JsonValue groups = JsonValue::makeArray();
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        JsonValue passes = JsonValue::makeArray();
        if (choice.path == Path::fused)
            passes.items.push_back(passEntry("fused", "once a frame", kernelParts(group)));
        for (const PassPlan& pass : plan.passes)
            if (choice.path == Path::pingPong && pass.group == g)
                passes.items.push_back(passEntry(name(pass.kind), when(pass.when), pass.why));
        JsonValue entry = JsonValue::makeObject();
        entry.add("name", JsonValue::makeString(group.name))
            .add("molecules", JsonValue::makeNumber(group.count))
            .add("vertices", JsonValue::makeNumber(group.vertexCount))
            .add("solver", JsonValue::makeString(name(group.solver)))
            .add("solverWhy", JsonValue::makeString(group.solverWhy));
        if (group.needs.springs) entry.add("highestFrequency", JsonValue::makeNumber(group.highestFrequency));
        if (group.needs.springs && !solver(group.solver).implicit)
            entry.add("stableStep", JsonValue::makeNumber(group.stableStep));
        if (group.life)
            entry.add("atStart", JsonValue::makeNumber(group.life->atStart))
                .add("allocator", JsonValue::makeString(name(group.life->cycle.allocator)))
                .add("emitters", JsonValue::makeNumber(double(group.life->cycle.emitters.size())));
        if (const SchoolMember* member = plan.school.memberOf(g))
            entry.add("schoolGrids", JsonValue::makeNumber(double(1 + member->targetGrids.size())));
        if (group.forces.any()) {
            JsonValue forces = JsonValue::makeArray();
            for (const std::string& force : forceNames(plan, group))
                forces.items.push_back(JsonValue::makeString(force));
            entry.add("forces", std::move(forces));
        }
        entry.add("passes", std::move(passes));
        groups.items.push_back(std::move(entry));
    }
    JsonValue out = JsonValue::makeObject();
    out.add("scene", JsonValue::makeString(plan.sceneName))
        .add("path", JsonValue::makeString(name(choice.path)))
        .add("fieldSampling", JsonValue::makeString(name(plan.fieldSampling)))
        .add("frameRate", JsonValue::makeNumber(plan.frameRate))
        .add("substeps", JsonValue::makeNumber(plan.substeps))
        .add("stateBytes", JsonValue::makeNumber(double(stateBytes(plan, choice.path, true, inPlace))))
        .add("tableBytes", JsonValue::makeNumber(double(plan.tableBytes())))
        .add("groups", std::move(groups));
    if (!plan.grids.empty()) {
        JsonValue grids = JsonValue::makeArray();
        for (const std::string& grid : plan.grids)
            grids.items.push_back(JsonValue::makeString(grid));
        out.add("grids", std::move(grids));
    }
    if (!plan.contact.any()) return out;
    JsonValue contact = JsonValue::makeObject();
    contact.add("spheres", JsonValue::makeNumber(plan.contact.spheres))
        .add("cell", JsonValue::makeNumber(plan.contact.cell))
        .add("steps", JsonValue::makeNumber(plan.contact.steps))
        .add("search", JsonValue::makeString(name(plan.contact.settings.search)))
        .add("response", JsonValue::makeString(name(plan.contact.settings.response)))
        .add("iterations", JsonValue::makeNumber(plan.contact.settings.iterations))
        .add("safeSpeed", JsonValue::makeNumber(plan.contact.safeSpeed(1 / plan.frameRate)));
    out.add("contact", std::move(contact));
    return out;
}

}  // namespace shoal
