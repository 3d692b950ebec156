#include "compile/pack.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal {

// The lattice point of 1/16 m nearest to a position: what shaders/physics/anchor.glsl keeps to.
static glm::dvec3 anchorOf(const glm::dvec3& position) {
    return glm::floor(position * 16.0 + 0.5) / 16.0;
}

void packStart(const Scene& scene, GroupPlan& group) {
    const Group& source = scene.groups[group.index];
    GroupState& start = group.start;
    const size_t molecules = size_t(group.count), vertices = molecules * size_t(group.vertexCount);
    start.positions.reserve(vertices);
    start.velocities.reserve(vertices);
    start.anchors.reserve(molecules);
    start.released.assign(molecules, 0);
    for (const Instance& instance : place(scene, group.index)) {
        const auto arm = [&](const Vertex& vertex) {
            return instance.rotation * (instance.scale * vertex.position);
        };
        const glm::dvec3 anchor = anchorOf(instance.position + arm(source.molecule.vertices[0]));
        for (const Vertex& vertex : source.molecule.vertices) {
            const glm::dvec3 offset = arm(vertex);
            const bool still = group.needs.pins && vertex.pinned;
            const glm::dvec3 velocity =
                still ? glm::dvec3(0) : source.velocity + glm::cross(source.spin, offset);
            start.positions.emplace_back(instance.position + offset - anchor);
            start.velocities.emplace_back(velocity);
        }
        start.anchors.emplace_back(anchor);
        group.constants.seeds.push_back(instance.seed >> 8);
        group.constants.scales.push_back(float(instance.scale));
        group.constants.phases.push_back(float(source.phaseSpread * double(instance.seed & 0xffff) / 65536));
    }
    const auto differs = [](const std::vector<float>& values, float from) {
        return std::any_of(values.begin(), values.end(), [from](float value) { return value != from; });
    };
    group.needs.scale = group.needs.springs && differs(group.constants.scales, 1);
    group.needs.phase = group.needs.actuation && differs(group.constants.phases, 0);
}

int packTopology(const Molecule& molecule, bool held, std::vector<glm::vec4>& topology) {
    const size_t base = topology.size(), count = molecule.vertices.size();
    topology.resize(base + 2 * count);
    for (size_t v = 0; v < count; ++v) {
        const Vertex& vertex = molecule.vertices[v];
        const bool pinned = held && vertex.pinned;
        topology[base + count + v] = glm::vec4(1 / vertex.mass, pinned ? 1 : 0, vertex.mass, 0);

        const size_t firstSpring = topology.size();
        int springs = 0;
        for (const Spring& spring : molecule.springs) {
            if (spring.a != int(v) && spring.b != int(v)) continue;
            const Actuation actuation = spring.actuation.value_or(Actuation{});
            topology.emplace_back(spring.a == int(v) ? spring.b : spring.a, spring.stiffness, spring.damping,
                                  molecule.restLength(spring));
            topology.emplace_back(actuation.amplitude, 2 * std::numbers::pi * actuation.frequency,
                                  actuation.phase, 0);
            ++springs;
        }
        const size_t firstTriangle = topology.size();
        int triangles = 0;
        for (const Triangle& t : molecule.triangles) {
            const int corners[3] = {t.a, t.b, t.c};
            for (int k = 0; k < 3; ++k) {
                if (corners[k] != int(v)) continue;
                topology.emplace_back(corners[(k + 1) % 3], corners[(k + 2) % 3], 0, 0);
                ++triangles;
            }
        }
        topology[base + v] = glm::vec4(firstSpring, springs, firstTriangle, triangles);
    }
    return int(base);
}

}  // namespace shoal
