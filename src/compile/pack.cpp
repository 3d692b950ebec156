#include "compile/pack.h"

#include <cmath>
#include <numbers>

namespace shoal {

// The lattice point of 1/16 m nearest to a position: what shaders/physics/anchor.glsl keeps to.
static glm::dvec3 anchorOf(const glm::dvec3& position) {
    return glm::floor(position * 16.0 + 0.5) / 16.0;
}

void packState(const Scene& scene, const GroupPlan& group, Plan& plan) {
    const Group& source = scene.groups[group.index];
    const std::vector<Instance> instances = place(scene, group.index);
    for (int m = 0; m < group.count; ++m) {
        const Instance& instance = instances[size_t(m)];
        const int column = m % stateWidth, slabRow = m / stateWidth;
        const auto arm = [&](const Vertex& vertex) {
            return instance.rotation * (instance.scale * vertex.position);
        };
        const glm::dvec3 anchor = anchorOf(instance.position + arm(source.molecule.vertices[0]));
        for (int v = 0; v < group.vertexCount; ++v) {
            const glm::dvec3 offset = arm(source.molecule.vertices[size_t(v)]);
            const size_t texel =
                size_t(group.firstRow + v * group.slabRows + slabRow) * stateWidth + size_t(column);
            const bool still = group.needs.pins && source.molecule.vertices[size_t(v)].pinned;
            const glm::dvec3 velocity =
                still ? glm::dvec3(0) : source.velocity + glm::cross(source.spin, offset);
            plan.positions[texel] = glm::vec4(glm::vec3(instance.position + offset - anchor), 0);
            plan.velocities[texel] = glm::vec4(glm::vec3(velocity), 0);
        }
        const size_t record = size_t(group.firstRecordRow + slabRow) * stateWidth + size_t(column);
        plan.records[record] = glm::vec4(glm::vec3(anchor), 0);
        const double phase = source.phaseSpread * double(instance.seed & 0xffff) / 65536;
        plan.constants[record] = glm::vec4(float(instance.seed >> 8), float(instance.scale), float(phase), 0);
    }
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
