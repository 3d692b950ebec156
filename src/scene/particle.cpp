#include "scene/particle.h"

namespace shoal {

const char* name(ParticleShape shape) {
    static constexpr const char* names[] = {"points", "sprites", "quads"};
    return names[size_t(shape)];
}

const char* name(ParticleFacing facing) {
    static constexpr const char* names[] = {"camera", "velocity", "free"};
    return names[size_t(facing)];
}

Molecule moleculeOf(const ParticleType& type) {
    Molecule out;
    out.name = "particle";
    Vertex vertex;
    vertex.mass = type.mass;
    out.vertices.push_back(vertex);
    out.material.color = type.colors.front().color;
    out.material.pointSize = 0.5 * (type.size.x + type.size.y);
    out.material.blend = type.blend;
    out.material.opacity = 1;
    out.material.sort = type.sort;
    out.material.spreadFrames = type.spreadFrames;
    return out;
}

}  // namespace shoal
