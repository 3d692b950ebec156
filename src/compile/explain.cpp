#include <cmath>
#include <iomanip>
#include <sstream>

#include "compile/passes.h"
#include "compile/path.h"
#include "core/error.h"
#include "core/json_build.h"
#include "core/printable.h"
#include "molecule/analysis.h"

namespace shoal {

namespace {

const char* when(Pass::When moment) {
    static constexpr const char* words[] = {"once a frame, first", "every substep", "once a frame, last"};
    return words[size_t(moment)];
}

// Returns the form that a group takes, or would take, on a GPU or on a CPU rasteriser.
std::string formOn(const Plan& plan, const GroupPlan& group, Lanes wanted, bool software) {
    PathLimits limits;
    limits.software = software;
    try {
        return name(chooseLanes(plan, group, wanted, limits));
    } catch (const Error&) {
        return "refused";  // it would compile for too long
    }
}

// Tells how its molecules are spread over lanes.
std::string lanesText(const Plan& plan, const GroupPlan& group, Lanes wanted) {
    const PathLimits limits;
    const std::string onRasteriser = formOn(plan, group, wanted, true);
    std::string out =
        concat("on a GPU a lane a ", formOn(plan, group, wanted, false), ", on a CPU rasteriser ");
    if (onRasteriser == "refused")
        out += "refused, since it would compile for too long";
    else
        out += "a lane a " + onRasteriser;
    if (onRasteriser == name(Lanes::molecule))
        out += concat(", compiled in about ", std::lround(secondsToCompile(plan, group)), " s");
    if (wanted != Lanes::automatic) return out + ", as asked";
    return out +
           (solver(group.solver).implicit && !solver(group.solver).spread
                ? concat("; ", name(group.solver), " goes over the springs one after the other, in one lane")
                : concat("; a lane a vertex holds ", FusedLimits::vertices(limits.maxSharedBytes),
                         " vertices with ", limits.maxSharedBytes, " bytes of shared memory"));
}

}  // namespace

static void listPasses(std::ostringstream& out, const GroupPlan& group) {
    for (const Pass& pass : passesOf(group))
        out << "  " << std::left << std::setw(9) << name(pass.kind) << std::setw(21) << when(pass.when)
            << printable(pass.why) << "\n";
}

// Lists the parts of a group's fused kernel.
static std::string kernelParts(const GroupPlan& group) {
    const Needs& needs = group.needs;
    std::string parts = "motion";
    const auto add = [&](bool need, const char* what) {
        if (need) parts += concat(", ", what);
    };
    add(needs.records && !needs.release, "anchors follow");
    add(needs.release, "anchors follow and pins may be released");
    add(needs.springs, "springs");
    add(needs.actuation, "muscles");
    add(needs.steers, "steering");
    add(needs.gravity, "gravity");
    add(needs.drag && !needs.directionalDrag, "drag");
    add(needs.directionalDrag, "drag by direction");
    add(needs.fields, "fields");
    add(needs.forces, "forces");
    add(needs.wind, "wind");
    add(needs.thrust, "thrust");
    add(needs.collide, "colliders");
    add(needs.normals, "normals where drawn");
    add(needs.life, "death");
    add(true, "watched");
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
        for (const GroupForces::Entry& entry : *kind) {
            const Force& force = plan.forces[entry.force];
            out.push_back(force.name.empty()
                              ? kindName(*force.shape)
                              : concat(kindName(*force.shape), " \"", printable(force.name), "\""));
        }
    return out;
}

static void tellContact(std::ostringstream& out, const Plan& plan, Path path) {
    const ContactPlan& contact = plan.contact;
    if (!contact.any()) return;
    out << "contact  " << contact.spheres << " spheres, found by the " << name(contact.settings.search)
        << " search in cells of " << contact.cell << " m, " << contact.steps
        << (contact.steps == 1 ? " time" : " times") << " a frame, in at most " << contact.settings.iterations
        << " iterations\n         up to " << contact.safeSpeed(1 / plan.frameRate)
        << " m/s relative to one another none passes through another between two contact steps\n";
    if (contact.settings.rest)
        out << "         what moves more slowly than " << *contact.settings.rest << " m/s "
            << (path == Path::fused ? "rests\n" : "would rest with compute shaders\n");
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
        << mebibytes(tableBytes(plan, choice.path)) << "\n";
    for (const std::string& grid : plan.grids)
        out << "         " << grid << "\n";
    tellContact(out, plan, choice.path);
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        out << "\ngroup \"" << printable(group.name) << "\": " << many(group.count, "molecule", "molecules")
            << " of " << many(group.vertexCount, "vertex", "vertices") << "\n";
        out << "  solver   " << name(group.solver) << ": " << printable(group.solverWhy) << "\n";
        if (group.needs.springs) {
            out << "  highest frequency " << hertz(group.highestFrequency) << " Hz; " << name(group.solver);
            if (solver(group.solver).implicit)
                out << " is stable at any substep\n";
            else
                out << " is stable up to " << group.stableStep << " s\n";
        }
        if (group.forces.any()) out << "  forces   " << joined(forceNames(plan, group), ", ") << "\n";
        if (choice.path == Path::pingPong)
            listPasses(out, group);
        else
            out << "  fused    once a frame         " << kernelParts(group) << "\n";
        if (choice.path == Path::fused) out << "  lanes    " << lanesText(plan, group, choice.lanes) << "\n";
        if (group.skinTriangleCount > 0)
            out << "  drawn    as a skin of " << many(group.skinTriangleCount, "triangle", "triangles")
                << ", " << int64_t(group.skinTriangleCount) * group.count
                << " in all near the camera, fewer where a pixel hides the difference\n";
        tellSchool(out, plan, g);
        listBirths(out, group);
        const std::string absent = leftOut(group, choice.path != Path::pingPong);
        if (!absent.empty()) out << "  left out: " << absent << "\n";
    }
    return out.str();
}

static JsonValue passEntry(const char* pass, const char* moment, const std::string& why) {
    return object(key("pass", pass), key("when", moment), key("why", why));
}

static JsonValue groupEntry(const Plan& plan, size_t g, const PathChoice& choice) {
    const GroupPlan& group = plan.groups[g];
    const Path path = choice.path;
    std::vector<JsonValue> passes;
    if (path != Path::pingPong)
        passes.push_back(passEntry("fused", "once a frame", kernelParts(group)));
    else
        for (const Pass& pass : passesOf(group))
            passes.push_back(passEntry(name(pass.kind), when(pass.when), pass.why));
    JsonValue out =
        object(key("name", group.name), key("molecules", group.count), key("vertices", group.vertexCount),
               key("solver", name(group.solver)), key("solverWhy", group.solverWhy));
    if (group.needs.springs) append(out, key("highestFrequency", hertz(group.highestFrequency)));
    if (group.needs.springs && !solver(group.solver).implicit)
        append(out, key("stableStep", group.stableStep));
    if (group.life)
        append(out, key("atStart", group.life->atStart), key("allocator", name(group.life->cycle.allocator)),
               key("emitters", group.life->cycle.emitters.size()));
    if (const SchoolMember* member = plan.school.memberOf(g))
        append(out, key("schoolGrids", 1 + member->targetGrids.size()));
    if (group.forces.any()) append(out, key("forces", forceNames(plan, group)));
    if (path == Path::fused)
        append(out, key("lanes", object(key("gpu", formOn(plan, group, choice.lanes, false)),
                                        key("rasteriser", formOn(plan, group, choice.lanes, true)))));
    return append(out, key("passes", passes));
}

JsonValue explainJson(const Plan& plan, const PathChoice& choice, bool inPlace) {
    std::vector<JsonValue> groups;
    for (size_t g = 0; g < plan.groups.size(); ++g)
        groups.push_back(groupEntry(plan, g, choice));
    JsonValue out = object(key("scene", plan.sceneName), key("path", name(choice.path)),
                           key("fieldSampling", name(plan.fieldSampling)), key("frameRate", plan.frameRate),
                           key("substeps", plan.substeps),
                           key("stateBytes", stateBytes(plan, choice.path, true, inPlace)),
                           key("tableBytes", tableBytes(plan, choice.path)), key("groups", groups));
    if (!plan.grids.empty()) append(out, key("grids", plan.grids));
    if (!plan.contact.any()) return out;
    const ContactSettings& settings = plan.contact.settings;
    JsonValue contact = object(key("spheres", plan.contact.spheres), key("cell", plan.contact.cell),
                               key("steps", plan.contact.steps), key("search", name(settings.search)),
                               key("response", name(settings.response)),
                               key("iterations", settings.iterations), key("tolerance", settings.tolerance),
                               key("safeSpeed", plan.contact.safeSpeed(1 / plan.frameRate)));
    if (settings.rest) append(contact, key("rest", *settings.rest));
    return append(out, key("contact", contact));
}

}  // namespace shoal
