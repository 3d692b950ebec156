#include "compile/contact_plan.h"

#include <algorithm>
#include <cmath>

#include "compile/glsl_text.h"
#include "compile/plan.h"
#include "compile/surface_pair.h"
#include "molecule/gap.h"

namespace shoal {

namespace {

// Molecules of a group, and groups, that the label of a sphere tells apart (shaders/contact/arrays.txt).
constexpr size_t mostGroups = 64;
constexpr int64_t mostSpheres = int64_t(1) << 27;
constexpr double mostMassRatio = 1e6;  // floats have 7 digits
constexpr double likeMasses = 10;

// Up to 5 significant bits.
double roundedUp(double length) {
    int exponent = 0;
    const double mantissa = std::frexp(length, &exponent);  // in [1/2, 1)
    return std::ldexp(std::ceil(mantissa * 32), exponent - 5);
}

void markClose(const Molecule& molecule, ContactGroup& group) {
    const std::vector<glm::dvec3> spheres = restSpheres(molecule, group.points);
    group.wordsOf = (group.spheresOf + 31) / 32;
    group.apart.assign(size_t(group.spheresOf) * size_t(group.wordsOf), 0);
    for (size_t a = 0; a < spheres.size(); ++a)
        for (size_t b = 0; b < spheres.size(); ++b)
            if (a == b || glm::distance(spheres[a], spheres[b]) < 2 * group.radius)
                group.apart[a * size_t(group.wordsOf) + b / 32] |= 1u << (b % 32);
}

std::vector<glm::vec4> shapesOf(const ContactGroup& group, const Molecule& molecule, bool held) {
    const size_t vertices = molecule.vertices.size();
    struct Around {
        int sphere;
        float weight;
    };
    std::vector<std::vector<Around>> around(vertices);
    for (size_t t = 0; t < group.points.size(); ++t) {
        const auto& [corners, parts] = group.points[t];
        for (int c = 0; c < 3; ++c)
            if (parts[c] > 0)
                around[size_t(corners[c])].push_back(
                    {int(vertices + t), float(parts[c]) / float(parts.x + parts.y + parts.z)});
    }
    std::vector<glm::vec4> out;
    int first = group.spheresOf;
    for (size_t v = 0; v < vertices; ++v) {
        const Vertex& vertex = molecule.vertices[v];
        const bool pinned = held && vertex.pinned;
        out.emplace_back(float(1 / vertex.mass), pinned ? 1.0f : 0.0f, float(first), float(around[v].size()));
        first += int(around[v].size());
    }
    for (const auto& [corners, parts] : group.points)
        out.emplace_back(glm::vec3(corners),
                         float(parts.x + 256 * parts.y + 65536 * (parts.x + parts.y + parts.z)));
    for (const std::vector<Around>& spheres : around)
        for (const auto& [sphere, weight] : spheres)
            out.emplace_back(float(sphere), weight, 0.0f, 0.0f);
    return out;
}

glm::dvec2 massesOf(const Molecule& molecule, const GroupPlan& plan) {
    if (plan.rigid && !plan.needs.pins) return glm::dvec2(molecule.mass());
    glm::dvec2 out(0);
    for (const Vertex& vertex : molecule.vertices) {
        if (plan.needs.pins && vertex.pinned) continue;
        out.x = out.x > 0 ? std::min(out.x, vertex.mass) : vertex.mass;
        out.y = std::max(out.y, vertex.mass);
    }
    return out;
}

ContactGroup groupOf(const Group& source, const GroupPlan& plan) {
    ContactGroup out;
    out.radius = source.contact->radius;
    out.points = trianglePoints(source.molecule, *source.contact);
    out.triangles = !out.points.empty();
    out.self = source.contact->self;
    if (source.particle && source.life) out.growth = source.particle->growth;
    out.spheresOf = plan.vertexCount + int(out.points.size());
    out.masses = massesOf(source.molecule, plan);
    out.soft = plan.vertexCount > 1 && !plan.rigid;
    out.shapes = shapesOf(out, source.molecule, plan.needs.pins);
    if (out.self) markClose(source.molecule, out);
    return out;
}

float smallestScale(const GroupPlan& group) {
    const std::vector<float>& scales = group.constants.scales;
    const float born = group.life ? float(group.life->cycle.scale.x) : scales.empty() ? 1 : scales[0];
    return scales.empty() ? 1 : std::min(born, *std::min_element(scales.begin(), scales.end()));
}

// As many of the smallest spheres as lie around the largest one, pushed together a little.
int listLength(double largest, double smallest) {
    const double ratio = (largest + smallest) / smallest;
    return int(std::clamp(std::ceil(6 * ratio * ratio), 24.0, 96.0));
}

Location settingOf(const Scene& scene, const char* key) {
    Location out = scene.contact.location;
    if (!out.path.empty()) out.path += concat(".", key);
    return out;
}

// Refuses a `rest` so large that a falling molecule would rest.
void checkRest(const Scene& scene, int steps) {
    const ContactSettings& settings = scene.contact;
    if (!settings.rest) return;
    if (settings.response != ContactResponse::simultaneous || settings.search != ContactSearch::exact)
        throw Error(settingOf(scene, "rest"),
                    "\"rest\" needs the exact search and the response of all that touch at once");
    const double fall = glm::length(scene.gravity) / (scene.frameRate * steps);
    if (fall > 0 && *settings.rest > fall)
        throw Error(settingOf(scene, "rest"),
                    concat("\"rest\" of ", *settings.rest,
                           " m/s is more than what falls gains in a contact step, ", fall, " m/s"));
}

// Refuses masses of which the larger leave nothing of the smaller in a float.
void checkMasses(const Scene& scene, const std::vector<GroupPlan>& plans, const ContactPlan::Masses& masses) {
    if (masses.ratio <= mostMassRatio) return;
    const GroupPlan& plan = plans[masses.heaviest->group];
    throw Error(scene.groups[plan.index].contact->location,
                concat("what contact moves of \"", plan.name, "\" is ", masses.ratio,
                       " times as heavy as of \"", plans[masses.lightest->group].name, "\": at most ",
                       mostMassRatio, " times can be told apart"));
}

}  // namespace

std::vector<std::string> ContactGroup::defines() const {
    return {concat("CONTACT_RADIUS ", glslLiteral(radius)),
            concat("CONTACT_GROWTH vec2(", glslLiteral(growth.x), ", ", glslLiteral(growth.y), ")")};
}

bool ContactPlan::mayRest(const GroupPlan& group) const {
    return settings.rest && !group.needs.actuation && !group.needs.steers;
}

float ContactPlan::momentum(int iteration, int iterations, bool unlikeMasses) {
    if (iteration == 0) return 0;
    const float first = std::max(std::min(0.8f, 1 - 1.6f / float(iterations)), 0.0f);
    return unlikeMasses ? std::max(first, float(iteration) / float(iteration + 3)) : first;
}

double ContactPlan::carried(int iterations) {
    const double n = iterations;
    return std::max(2.5 * n / (1 - double(momentum(1, iterations, true))), 0.25 * n * n);
}

int ContactPlan::iterationsFor(double massRatio, int levels) {
    const double needed = std::max(8 * std::sqrt(massRatio), 1.5 * levels);
    return int(std::min(std::ceil(needed), double(ContactSettings::mostIterations)));
}

ContactPlan::Masses ContactPlan::masses() const {
    Masses out;
    for (const ContactGroup& group : groups) {
        if (group.masses.x == 0) continue;  // it is held
        if (!out.lightest || group.masses.x < out.lightest->masses.x) out.lightest = &group;
        if (!out.heaviest || group.masses.y > out.heaviest->masses.y) out.heaviest = &group;
    }
    if (out.lightest) out.ratio = out.heaviest->masses.y / out.lightest->masses.x;
    return out;
}

double ContactPlan::safeSpeed(double frameTime) const {
    double least = largestRadius;
    for (const ContactGroup& group : groups)
        least = std::min(least, group.radius);
    return std::max(settings.fastest.value_or(0), 2 * least * steps / frameTime);
}

ContactPlan planContact(const Scene& scene, const std::vector<GroupPlan>& groups) {
    ContactPlan out;
    out.settings = scene.contact;
    int64_t spheres = 0;
    double smallest = 1e300;
    for (size_t g = 0; g < groups.size(); ++g) {
        const Group& source = scene.groups[groups[g].index];
        if (!source.contact) continue;
        ContactGroup group = groupOf(source, groups[g]);
        group.group = g;
        group.firstSphere = int(spheres);
        spheres += int64_t(groups[g].count) * group.spheresOf;
        if (spheres > mostSpheres)
            throw Error(source.contact->location, concat(spheres, " spheres of contact are more than the ",
                                                         mostSpheres, " that a scene may have"));
        const auto [slight, full] = std::minmax({group.growth.x, group.growth.y});
        out.largestRadius =
            std::max(out.largestRadius, group.radius * full * double(largestScale(groups[g])));
        smallest = std::min(smallest, group.radius * slight * double(smallestScale(groups[g])));
        out.groups.push_back(std::move(group));
        if (out.groups.size() > mostGroups)
            throw Error(source.contact->location, concat("more than ", mostGroups, " groups with contact"));
    }
    if (!out.any()) return out;
    out.spheres = int(spheres);
    const int substeps = scene.solver.substeps;
    out.steps = scene.contact.steps > 0 ? std::min(scene.contact.steps, substeps) : substeps;
    checkRest(scene, out.steps);
    const ContactPlan::Masses masses = out.masses();
    checkMasses(scene, groups, masses);
    out.unlikeMasses = masses.ratio > likeMasses;
    out.tower = tallestTower(scene, groups, out.groups);
    if (out.settings.iterations == 0)
        out.settings.iterations = ContactPlan::iterationsFor(masses.ratio, out.tower.levels);
    // a little more, so that rounding loses nothing
    out.reach = (1 + 1e-5) * std::max(2 * ContactPlan::near * out.largestRadius,
                                      2 * out.largestRadius +
                                          scene.contact.fastest.value_or(0) / (scene.frameRate * out.steps));
    const double needed = 2 * out.reach;
    if (scene.contact.cell && *scene.contact.cell < needed)
        throw Error(settingOf(scene, "cell"),
                    concat("cells of ", *scene.contact.cell, " m do not hold spheres of radius ",
                           out.largestRadius, " m", scene.contact.fastest ? " and their way in a step" : "",
                           ": without \"cell\" they are ", roundedUp(needed), " m wide"));
    out.cell = roundedUp(std::max(scene.contact.cell.value_or(needed), ContactPlan::finestCell));
    out.listLength = listLength(out.largestRadius, smallest);
    while ((int64_t(1) << out.tableBits) < 2 * spheres)
        ++out.tableBits;
    out.tableBits = std::max(out.tableBits, 4);
    for (const ContactGroup& a : out.groups) {
        for (const ContactGroup& b : out.groups) {
            const SurfacePair pair = surfacePair(scene, groups[a.group].index, groups[b.group].index);
            out.pairs.emplace_back(pair.restitution, pair.friction);
        }
    }
    return out;
}

std::vector<TrianglePoint> trianglePoints(const Molecule& molecule, const GroupContact& contact) {
    if (contact.closed) return closingPoints(molecule, contact.radius);
    return contact.triangles ? middlePoints(molecule) : std::vector<TrianglePoint>();
}

Gap largestGap(const Molecule& molecule, const GroupContact& contact) {
    return largestGap(molecule, restSpheres(molecule, trianglePoints(molecule, contact)), contact.radius);
}

}  // namespace shoal
