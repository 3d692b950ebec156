#include "compile/pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "compile/muscle_waves.h"
#include "compile/newton.h"
#include "compile/school_plan.h"
#include "core/random.h"

namespace shoal {

SplitPoint splitPoint(const glm::dvec3& point) {
    constexpr double enough = 1e-6;  // m
    const glm::dvec3 off = glm::abs(point - glm::dvec3(glm::vec3(point)));
    if (std::max({off.x, off.y, off.z}) <= enough) return {glm::dvec3(0), point};
    const glm::dvec3 lattice(glm::vec3(latticePoint(point)));
    return {lattice, point - lattice};
}

bool isFar(const Force& force) {
    const std::optional<glm::dvec3> own = placeOf(*force.shape);
    if (!own) return false;
    bool far = force.mouse || splitPoint(*own).isFar();
    if (force.path)
        for (const ForcePath::Keyframe& keyframe : force.path->keyframes)
            far = far || splitPoint(*own + keyframe.offset).isFar();
    return far;
}

// Sets the start state of the allocators on the CPU, which give the first places first.
static void packBooks(const Lifecycle& life, GroupState& start) {
    const bool stack = life.allocator == Allocator::stack;
    if (life.emitters.empty() || (!stack && life.allocator != Allocator::heap)) return;
    for (const glm::vec2& ageAndLife : start.lives)
        start.ends.push_back(ageAndLife.y > 0 ? double(ageAndLife.y - ageAndLife.x)
                                              : -std::numeric_limits<double>::infinity());
    for (size_t place = start.lives.size(); stack && place-- > 0;)
        if (start.lives[place].y <= 0) start.freed.push_back(uint32_t(place));
    if (stack) start.freed.resize(start.lives.size());
}

// Gives the molecules at the start their length of life from their seeds, as newborns have it, and full size;
// the other places are free.
static void packLives(const Group& source, GroupPlan& group) {
    GroupState& start = group.start;
    const size_t places = size_t(group.count);
    const double grown = source.life->grow;
    start.lives.reserve(places);
    start.looks.reserve(places);
    for (const uint32_t seed : group.constants.seeds)
        start.lives.emplace_back(float(grown), float(grown + lifeOf(source.life->life, seed)));
    start.positions.resize(places * size_t(group.vertexCount));
    start.velocities.resize(start.positions.size());
    start.anchors.resize(places);
    start.lives.resize(places);
    group.constants.seeds.resize(places);
    group.constants.scales.resize(places, 1.0f);
    group.constants.phases.resize(places, 0.0f);
    start.seeds = group.constants.seeds;
    for (size_t i = 0; i < places; ++i)
        start.looks.emplace_back(group.constants.scales[i], group.constants.phases[i]);
    packBooks(*source.life, start);
    start.clocks.resize(source.life->emitters.size());
    start.totals.resize(2);
}

std::vector<glm::vec4> unsteered(size_t molecules) {
    std::vector<glm::vec4> out;
    for (size_t m = 0; m < molecules; ++m)
        out.insert(out.end(), {glm::vec4(0), glm::vec4(0, 0, 0, 1), glm::vec4(0)});
    return out;
}

double lifeOf(const glm::dvec2& life, uint32_t seed) {
    return glm::mix(life.x, life.y, uniformFrom(hash(seed, bornLife)));
}

// Sets molecule m of the start state to where it is placed.
static void packOne(const Group& source, const Instance& instance, size_t m, GroupPlan& group) {
    GroupState& start = group.start;
    const auto arm = [&](const Vertex& vertex) {
        return instance.rotation * (instance.scale * vertex.position);
    };
    const glm::dvec3 anchor = latticePoint(instance.position + arm(source.molecule.vertices[0]));
    size_t i = m * source.molecule.vertices.size();
    for (const Vertex& vertex : source.molecule.vertices) {
        const glm::dvec3 offset = arm(vertex);
        const bool still = group.needs.pins && vertex.pinned;
        start.positions[i] = instance.position + offset - anchor;
        start.velocities[i++] = still ? glm::dvec3(0) : source.velocity + glm::cross(source.spin, offset);
    }
    start.anchors[m] = anchor;
    group.constants.seeds[m] = instance.seed >> 8;
    group.constants.scales[m] = float(instance.scale);
    group.constants.phases[m] = float(source.phaseSpread * double(instance.seed & 0xffff) / 65536);
}

void packStart(const Scene& scene, GroupPlan& group) {
    const Group& source = scene.groups[group.index];
    GroupState& start = group.start;
    const size_t placed = size_t(source.count), vertices = placed * size_t(group.vertexCount);
    start.positions.resize(vertices);
    start.velocities.resize(vertices);
    start.anchors.resize(placed);
    start.released.assign(size_t(group.count), 0);
    group.constants.seeds.resize(placed);
    group.constants.scales.resize(placed);
    group.constants.phases.resize(placed);
    if (placed > 0)
        forEachInstance(scene, group.index,
                        [&](size_t m, const Instance& instance) { packOne(source, instance, m, group); });
    if (group.needs.life) packLives(source, group);
    if (group.needs.steers) start.steering = unsteered(size_t(group.count));
    const auto differs = [](const std::vector<float>& values, float from) {
        return std::any_of(values.begin(), values.end(), [from](float value) { return value != from; });
    };
    const bool newbornsScaled = source.life && source.life->scale != glm::dvec2(1);
    const bool newbornsPhased = source.life && source.phaseSpread != 0;
    group.needs.scale =
        (group.needs.springs || source.contact) && (newbornsScaled || differs(group.constants.scales, 1));
    group.needs.phase = group.needs.actuation && (newbornsPhased || differs(group.constants.phases, 0));
}

// Tells a spring's muscle: see compile/plan.h.
static glm::vec4 muscleOf(const Molecule& molecule, const GroupPlan& group, const MuscleWaves& waves,
                          const Spring& spring) {
    const Actuation actuation = spring.actuation.value_or(Actuation{});
    const auto number =
        group.needs.steers ? bendOf(molecule, spring) : double(muscleNumber(group.muscles, spring));
    if (const std::optional<MuscleWaves::Share> share = waves.shareOf(spring))
        return {share->amplitude, share->wave, 0, number};
    return {actuation.amplitude, 2 * std::numbers::pi * actuation.frequency, actuation.phase, number};
}

// Lists the elements at each vertex, in their order; `cornersOf` returns the vertices of one.
template <typename Element, typename Corners>
static std::vector<std::vector<size_t>> around(size_t vertices, const std::vector<Element>& elements,
                                               const Corners& cornersOf) {
    std::vector<std::vector<size_t>> out(vertices);
    for (size_t i = 0; i < elements.size(); ++i)
        for (const int vertex : cornersOf(elements[i]))
            out[size_t(vertex)].push_back(i);
    return out;
}

int packTopology(const Molecule& molecule, const GroupPlan& group, std::vector<glm::vec4>& topology) {
    const size_t base = topology.size(), count = molecule.vertices.size();
    const double mass = molecule.mass();
    const MuscleWaves waves(molecule, group.needs);
    const auto cornersOf = [](const Triangle& t) { return std::array{t.a, t.b, t.c}; };
    const auto springs = around(count, molecule.springs, [](const Spring& spring) {
        return std::array{spring.a, spring.b};
    });
    const auto triangles = around(count, molecule.triangles, cornersOf);
    topology.resize(base + 2 * count);
    for (const Triangle& t : molecule.triangles)
        topology.emplace_back(t.a, t.b, t.c, 0);
    if (solver(group.solver).spread) addNewtonTable(molecule, group.matrix, topology);
    for (size_t v = 0; v < count; ++v) {
        const Vertex& vertex = molecule.vertices[v];
        const bool pinned = group.needs.pins && vertex.pinned;
        topology[base + count + v] =
            glm::vec4(1 / vertex.mass, pinned ? 1 : 0, vertex.mass, vertex.mass / mass);

        const size_t firstSpring = topology.size();
        for (const size_t i : springs[v]) {
            const Spring& spring = molecule.springs[i];
            topology.emplace_back(spring.a == int(v) ? spring.b : spring.a, spring.stiffness, spring.damping,
                                  molecule.restLength(spring));
            topology.push_back(muscleOf(molecule, group, waves, spring));
        }
        const size_t firstTriangle = topology.size();
        for (const size_t i : triangles[v]) {
            const std::array<int, 3> corners = cornersOf(molecule.triangles[i]);
            const auto k = size_t(std::find(corners.begin(), corners.end(), int(v)) - corners.begin());
            topology.emplace_back(corners[(k + 1) % 3], corners[(k + 2) % 3], k, i);
        }
        topology[base + v] = glm::vec4(firstSpring, springs[v].size(), firstTriangle, triangles[v].size());
    }
    return int(base);
}

void repackTopology(const Molecule& molecule, size_t group, Plan& plan) {
    const auto base = plan.topology.begin() + plan.groups[group].topologyBase;
    std::vector<glm::vec4> table(plan.topology.begin(), base);
    packTopology(molecule, plan.groups[group], table);
    std::copy(table.begin() + plan.groups[group].topologyBase, table.end(), base);
}

}  // namespace shoal
