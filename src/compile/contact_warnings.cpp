#include "compile/contact_warnings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "molecule/gap.h"
#include "scene/collider_kinds.h"

namespace shoal {

double upToTwoDigits(double value) {
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return std::ceil(value / unit) * unit;
}

namespace {

// How many contact steps of a frame are enough, in words: alike ones, of as many substeps each.
std::string stepsThatHold(const Scene& scene, const Plan& plan, double needed) {
    const int substeps = scene.solver.substeps, present = plan.contact.steps;
    int steps = int(std::ceil(needed));
    if (steps > maxSubsteps)
        return concat("more than the ", maxSubsteps, " substeps of a frame would hold it");
    while (steps < substeps && substeps % steps != 0)
        ++steps;
    return concat(present < substeps && steps <= substeps ? "\"steps\" of contact" : "\"substeps\"",
                  " of at least ", steps, " instead of ", present, " hold it");
}

// Warns of contact that no group takes part in, and of more steps of it than substeps.
void warnOfUnused(const Scene& scene, Plan& plan) {
    const ContactSettings& asked = scene.contact;
    if (asked.location.empty()) return;
    if (!plan.contact.any())
        plan.warnings.push_back(
            {asked.location,
             "no group has \"contact\", so that molecules pass through one another: "
             "\"contact\": {\"radius\": 0.01} in a group gives its vertices spheres of 1 cm"});
    else if (asked.steps > plan.contact.steps)
        plan.warnings.push_back(
            {asked.location, concat("contact of ", asked.steps, " steps runs ", plan.contact.steps,
                                    " times a frame, once a substep")});
}

// Warns of spheres that are larger than their molecule, and where they leave a gap in its surface through
// which a like sphere passes.
void warnOfSpheres(const Scene& scene, Plan& plan) {
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        const GroupContact& asked = *scene.groups[group.index].contact;
        const double size = scene.groups[group.index].molecule.size();
        if (group.vertexCount > 1 && asked.radius > size)
            plan.warnings.push_back(
                {asked.location,
                 concat("the spheres of \"", group.name, "\", with a radius of ", asked.radius,
                        " m, are larger than the molecule, which is ", size, " m long")});
        const Gap gap = largestGap(scene.groups[group.index].molecule, asked);
        if (gap.radius <= asked.radius) continue;
        plan.warnings.push_back(
            {asked.location,
             concat("the spheres of \"", group.name, "\" leave a gap in triangle ", gap.triangle,
                    " through which a sphere of radius ", gap.radius,
                    " m passes, larger than their own: ", "\"closed\": true or a larger radius closes it")});
    }
}

// Warns of crowds: each sphere is compared with all that share its cells, so many in one place cost the
// square of their number.
void warnOfCrowds(const Scene& scene, Plan& plan) {
    constexpr double many = 64;
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        const double reach = 2 * plan.contact.largestRadius;
        std::vector<size_t> cells;
        const size_t count = group.life ? size_t(group.life->atStart) : group.start.anchors.size();
        for (size_t m = 0; m < count; ++m) {
            const glm::dvec3 place =
                glm::floor((glm::dvec3(group.start.anchors[m]) +
                            glm::dvec3(group.start.positions[m * size_t(group.vertexCount)])) /
                           reach);
            cells.push_back(std::hash<double>()(place.x) ^ (std::hash<double>()(place.y) * 31) ^
                            (std::hash<double>()(place.z) * 1009));
        }
        std::sort(cells.begin(), cells.end());
        double others = 0;
        for (size_t first = 0, i = 0; i <= cells.size(); ++i) {
            if (i < cells.size() && cells[i] == cells[first]) continue;
            others += double(i - first) * double(i - first);
            first = i;
        }
        if (count == 0 || others / double(count) <= many) continue;
        plan.warnings.push_back(
            {scene.groups[group.index].contact->location,
             concat(
                 "the molecules of \"", group.name, "\" start crowded: one has about ",
                 std::round(others / double(count)), " others within ", reach,
                 " m, where their spheres may touch. Each pair is looked at, which takes long, and a sphere "
                 "keeps at most ",
                 plan.contact.listLength, " of them: a larger place or a smaller radius helps")});
    }
}

// Warns of the heaviest on the lightest that contact moves, where something makes them lie on one another.
void warnOfMasses(const Scene& scene, Plan& plan) {
    const ContactPlan& contact = plan.contact;
    if (!contact.remembers() || scene.gravity == glm::dvec3(0)) return;
    const ContactPlan::Masses masses = contact.masses();
    if (masses.ratio <= ContactPlan::carried(contact.settings.iterations)) return;
    constexpr int most = ContactSettings::mostIterations;
    int needed = 1;
    while (needed <= most && ContactPlan::carried(needed) < masses.ratio)
        ++needed;
    plan.warnings.push_back(
        {scene.groups[plan.groups[masses.heaviest->group].index].contact->location,
         concat("what contact moves of \"", plan.groups[masses.heaviest->group].name, "\" is ",
                upToTwoDigits(masses.ratio), " times as heavy as of \"",
                plan.groups[masses.lightest->group].name, "\": where it lies on that, it sinks in or sways",
                needed > most
                    ? concat(", since ", most, " \"iterations\", which are the most, carry ",
                             std::floor(ContactPlan::carried(most)), " times the mass")
                    : concat(" with less than ", needed, " \"iterations\", and in a tower with less than ",
                             ContactPlan::iterationsFor(masses.ratio, 0),
                             ", which a scene has that does not say how many"))});
}

// Warns of solid molecules whose springs are soft for the contact step. What contacts remember pushes as a
// force over the next step; of a solid that vibrates meanwhile it gives energy to stacks of three and more. A
// sheet gives way to what touches it, and a rigid body has no springs.
void warnOfSoftSolids(const Scene& scene, Plan& plan) {
    constexpr double most = 0.2;  // of the lowest frequency, rad/s, times the contact step
    if (!plan.contact.remembers() || scene.gravity == glm::dvec3(0)) return;
    const double frame = 1 / plan.frameRate;
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        const Group& source = scene.groups[group.index];
        if (group.rigid || source.school || group.musclePeriod > 0 ||
            group.solidFrequency * frame / plan.contact.steps <= most)
            continue;
        plan.warnings.push_back(
            {source.contact->location,
             concat("where three or more molecules of \"", group.name,
                    "\" stand on one another they shake, because their springs are soft (lowest frequency ",
                    hertz(group.solidFrequency), " Hz) and the contact step is long: ",
                    stepsThatHold(scene, plan, group.solidFrequency * frame / most))});
    }
}

// Warns of towers that lean further and further: of contact steps that are long for the time in which a level
// would tip over, and of fewer iterations than the load of all levels takes.
void warnOfTowers(const Scene& scene, Plan& plan) {
    const Tower& tower = plan.contact.tower;
    if (!plan.contact.remembers() || tower.levels <= Tower::alwaysStands) return;
    // of levels times g / height of a level times the square of the contact step (docs/contact-figures.md)
    constexpr double most = 0.0065;
    const double needed =
        std::sqrt(tower.levels * glm::length(scene.gravity) / tower.height / most) / plan.frameRate;
    const int iterations = ContactPlan::iterationsFor(1, tower.levels);
    std::string words;
    if (needed > plan.contact.steps) words = stepsThatHold(scene, plan, needed);
    if (plan.contact.settings.iterations < iterations)
        words += concat(words.empty() ? "" : ", with ", "\"iterations\" of at least ", iterations,
                        " instead of ", plan.contact.settings.iterations, words.empty() ? " hold it" : "");
    if (words.empty()) return;
    plan.warnings.push_back(
        {scene.groups[plan.groups[tower.group].index].contact->location,
         concat("a tower of ", tower.levels, " molecules on \"", plan.groups[tower.group].name,
                "\" leans more and more until it falls: ", words)});
}

// What falls at the start: how far, on how many layers of spheres.
struct Fall {
    double height = 0;  // m
    double layers = 0;  // if it lay there, three fifths of its room filled
    double radius = 0;  // m, of the smallest sphere
    double drag = 0;    // 1/s, the least
    const GroupContact* contact = nullptr;
};

Fall fallOf(const Scene& scene, const Plan& plan) {
    const glm::dmat3 axes = uprightAxes(scene.gravity);
    const glm::dvec3 up = axes[1];
    Fall out{.radius = 1e300, .drag = 1e300};
    glm::dvec3 low(1e300), high(-1e300);
    double volume = 0;  // m^3, of spheres
    for (const ContactGroup& contact : plan.contact.groups) {
        const GroupPlan& group = plan.groups[contact.group];
        const size_t count = group.life ? size_t(group.life->atStart) : group.start.anchors.size();
        for (size_t m = 0; m < count; ++m) {
            const glm::dvec3 place = glm::dvec3(group.start.anchors[m]) * axes;
            low = glm::min(low, place), high = glm::max(high, place);
        }
        volume += double(count) * contact.spheresOf * 4 / 3 * std::numbers::pi * std::pow(contact.radius, 3);
        out.radius = std::min(out.radius, contact.radius);
        out.drag = std::min({out.drag, group.drag.normal, group.drag.tangent});
        out.contact = &*scene.groups[group.index].contact;
    }
    double bottom = low.y;
    for (const Collider& collider : scene.colliders)
        if (const auto* plane = std::get_if<PlaneCollider>(&*collider.shape))
            if (glm::dot(plane->normal, up) > 0.7) bottom = std::min(bottom, glm::dot(plane->point, up));
    out.height = std::max(0.0, high.y - bottom);
    const glm::dvec3 room = glm::max(high - low, 0.0) + 2 * out.radius;
    out.layers = volume / (0.6 * room.x * room.z) / (2 * out.radius);
    return out;
}

// Warns of a tall pile that falls so fast that it is driven into itself: an iteration passes the impact of a
// layer on to the next one alone.
void warnOfFalls(const Scene& scene, Plan& plan) {
    constexpr double most = 110;  // layers times diameters that they fall in a contact step
    if (!plan.contact.remembers() || scene.gravity == glm::dvec3(0)) return;
    const Fall fall = fallOf(scene, plan);
    const double gravity = glm::length(scene.gravity);
    double speed = std::sqrt(2 * gravity * fall.height);
    if (fall.drag > 0) speed = std::min(speed, gravity / fall.drag);
    const double diameters = speed / plan.frameRate / plan.contact.steps / (2 * fall.radius);
    if (fall.layers * diameters <= most) return;
    plan.warnings.push_back(
        {fall.contact->location,
         concat("what falls from the top of the start reaches ", upToTwoDigits(speed), " m/s, ",
                upToTwoDigits(diameters), " diameters of a sphere in a contact step, and lies ",
                upToTwoDigits(fall.layers), " spheres high: the lowest are driven into one another; ",
                stepsThatHold(scene, plan, plan.contact.steps * fall.layers * diameters / most))});
}

}  // namespace

void warnOfContact(const Scene& scene, Plan& plan) {
    warnOfUnused(scene, plan);
    if (!plan.contact.any()) return;
    warnOfSpheres(scene, plan);
    warnOfMasses(scene, plan);
    warnOfSoftSolids(scene, plan);
    warnOfTowers(scene, plan);
    warnOfFalls(scene, plan);
    warnOfCrowds(scene, plan);
}

}  // namespace shoal
