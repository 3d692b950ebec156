#include "compile/scene_warnings.h"

#include <algorithm>
#include <optional>

#include "compile/contact_warnings.h"
#include "core/error.h"
#include "molecule/gap.h"
#include "scene/force_kinds.h"
#include "scene/known_colliders.h"

namespace shoal {

namespace {

// Fields and winds move what has drag, and nothing else. What has a velocity of its own may drift without.
void warnOfStillAir(const Scene& scene, const Group& group, const GroupPlan& plan,
                    std::vector<Warning>& warnings) {
    const bool wind = std::any_of(scene.forces.begin(), scene.forces.end(), [&](const Force& force) {
        return std::holds_alternative<WindForce>(*force.shape) && actsOn(force, group.name);
    });
    if (plan.needs.drag || group.velocity != glm::dvec3(0) || (scene.fields.empty() && !wind)) return;
    warnings.push_back({group.location, concat("\"", plan.name, "\" has no \"drag\", through which ",
                                               wind ? "wind" : "fields", " would move it: it feels none")});
}

// Triangles do not touch colliders, but for the spheres of contact at their middles: what is thinner than the
// gap that is left passes through.
void warnOfThinColliders(const Scene& scene, const Group& group, const GroupPlan& plan,
                         std::vector<Warning>& warnings) {
    constexpr int many = 1000;  // vertices, whose gaps take too long to look at
    if (!plan.needs.collide || group.molecule.triangles.empty() || plan.vertexCount > many) return;
    const double scale = largestScale(plan), radius = group.contact ? group.contact->radius * scale : 0;
    std::vector<TrianglePoint> points;
    if (group.contact && scene.contact.response == ContactResponse::simultaneous)
        points = trianglePoints(group.molecule, *group.contact);
    std::optional<Gap> gap;
    std::string names;
    size_t count = 0;
    double needed = 0;  // m, of a radius
    for (const Collider& collider : scene.colliders) {
        const std::optional<double> girth = girthOf(*collider.shape);
        if (!girth) continue;
        if (!gap) gap = largestGap(group.molecule, restSpheres(group.molecule, points), 0);
        if (*girth + std::max(collider.thickness, radius) >= gap->radius * scale) continue;
        needed = std::max(needed, gap->radius - *girth / scale);
        if (++count > 3) continue;
        names += concat(count > 1 ? ", " : "", "the ", kindName(*collider.shape),
                        collider.name.empty() ? "" : concat(" \"", collider.name, "\""), " with a radius of ",
                        *girth, " m");
    }
    if (count == 0) return;
    if (count > 3) names += concat(" and ", count - 3, " more");
    warnings.push_back(
        {group.location,
         concat(names, count > 1 ? " pass" : " passes", " through triangle ", gap->triangle, " of \"",
                plan.name, "\": its vertices", points.empty() ? "" : " and the spheres on its triangles",
                " alone touch colliders, and leave a gap of ", gap->radius * scale,
                " m: a finer molecule, or \"contact\" with \"radius\": ", upToTwoDigits(needed),
                " holds them")});
}

// Warns of a swimmer that does not lie along +Z or has no muscles; a point has neither.
void warnOfSwimmers(const Scene& scene, const Group& group, const GroupPlan& plan,
                    std::vector<Warning>& warnings) {
    const Molecule& molecule = group.molecule;
    if (!group.school || plan.vertexCount < 2) return;
    glm::dvec3 low(1e300), high(-1e300);
    for (const Vertex& vertex : molecule.vertices)
        low = glm::min(low, vertex.position), high = glm::max(high, vertex.position);
    const glm::dvec3 extent = high - low;
    const int across = extent.x > extent.y ? 0 : 1;
    if (extent[across] > extent.z)
        warnings.push_back(
            {group.school->location, concat("the molecule of \"", plan.name, "\" is ", extent[across],
                                            " m long along ", "XY"[across], " and ", extent.z,
                                            " m along +Z, the way it swims: it swims across its length "
                                            "(\"molecule from-mesh --forward\" turns a mesh)")});
    if (std::none_of(molecule.springs.begin(), molecule.springs.end(), [](const Spring& spring) {
            return spring.actuation && spring.actuation->amplitude != 0;
        }))
        warnings.push_back(
            {group.school->location,
             concat("the molecule of \"", plan.name,
                    "\" has no muscle to swim and turn with, and is pushed "
                    "along: \"actuation\" of its springs is one (\"molecule new --shape fish\" has them)")});
    if (!scene.water) return;
    const std::vector<glm::vec3>& anchors = plan.start.anchors;
    const auto above = std::count_if(anchors.begin(), anchors.end(), [&](const glm::vec3& anchor) {
        return anchor.y > scene.water->surface + molecule.size();
    });
    constexpr double few = 0.05;  // which leap
    if (double(above) > few * double(anchors.size()))
        warnings.push_back(
            {group.location, concat(above, " of ", anchors.size(), " molecules of \"", plan.name,
                                    "\" start in the air, above the water's \"surface\" at y = ",
                                    scene.water->surface, " m, and swim there")});
}

// A point touches at its middle, however large it is drawn, unless contact gives it a radius.
void warnOfSizes(const Scene& scene, const Group& group, const GroupPlan& plan,
                 std::vector<Warning>& warnings) {
    constexpr double seen = 0.02;  // m, below which nobody sees what sinks
    const bool drawn = !group.particle || (group.particle->blend == Blend::none &&
                                           group.particle->shape != ParticleShape::points);
    if (!plan.needs.collide || group.contact || plan.vertexCount > 1 || !group.molecule.skin.empty() ||
        !drawn)
        return;
    const double radius = 0.5 * group.molecule.material.pointSize;
    double sunk = 0;  // m, the most
    for (const Collider& collider : scene.colliders)
        sunk = std::max(sunk, radius - collider.thickness);
    if (sunk <= std::max(seen, 0.5 * radius)) return;
    warnings.push_back(
        {group.location, concat("the points of \"", plan.name, "\" are drawn ", 2 * radius,
                                " m wide and touch colliders with their middle, in which they sink by ", sunk,
                                " m: \"contact\": {\"radius\": ", radius, "} gives them their size")});
}

// The anchors' lattice of 1/16 m is one of floats only so far out.
void warnOfFar(const Group& group, const GroupPlan& plan, std::vector<Warning>& warnings) {
    constexpr float farthest = 1 << 20;  // m
    const std::vector<glm::vec3>& anchors = plan.start.anchors;
    const auto beyond = std::count_if(anchors.begin(), anchors.end(), [](const glm::vec3& anchor) {
        return glm::any(glm::greaterThan(glm::abs(anchor), glm::vec3(farthest)));
    });
    if (beyond > 0)
        warnings.push_back(
            {group.location, concat(beyond, " of ", anchors.size(), " molecules of \"", plan.name,
                                    "\" start more than ", int(farthest),
                                    " m from the origin, where positions are rounded to an eighth of a "
                                    "metre and more")});
}

}  // namespace

void warnOf(const Scene& scene, Plan& plan) {
    for (const GroupPlan& group : plan.groups) {
        const Group& source = scene.groups[group.index];
        warnOfFar(source, group, plan.warnings);
        warnOfStillAir(scene, source, group, plan.warnings);
        warnOfSwimmers(scene, source, group, plan.warnings);
        warnOfThinColliders(scene, source, group, plan.warnings);
        warnOfSizes(scene, source, group, plan.warnings);
    }
    warnOfContact(scene, plan);
}

}  // namespace shoal
