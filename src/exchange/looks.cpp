#include "exchange/looks.h"

#include <algorithm>

// GLSL converts and shadows as it likes; the project's own C++ does not.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wfloat-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"
#pragma GCC diagnostic ignored "-Wmissing-declarations"
namespace shoal::exchange {
namespace particle_shader {
using namespace glm;
namespace {
#include "particles/attributes.glsl"
}  // namespace
}  // namespace particle_shader
namespace molecule_shader {
using namespace glm;
namespace {
#include "render/looks.glsl"
}  // namespace
}  // namespace molecule_shader
}  // namespace shoal::exchange
#pragma GCC diagnostic pop

namespace shoal::exchange {

// Takes the mean velocity of evenly chosen vertices, as shaders/render/color_scale.glsl does.
static glm::vec3 colorBySpeed(const ColorScale& scale, std::span<const glm::dvec3> velocities) {
    constexpr size_t mostRead = 64;
    const size_t stride = (velocities.size() + mostRead - 1) / mostRead;
    glm::dvec3 sum(0);
    size_t count = 0;
    for (size_t v = 0; v < velocities.size(); v += stride, ++count)
        sum += velocities[v];
    glm::vec4 colors[mostScaleColors] = {};
    for (size_t i = 0; i < scale.colors.size(); ++i)
        colors[i] = glm::vec4(scale.colors[i], 1);
    return molecule_shader::colorOfQuantity(float(glm::length(sum) / double(count)), colors,
                                            int(scale.colors.size()) - 1,
                                            {float(scale.from), float(1 / (scale.to - scale.from))});
}

static Looks ofParticle(const ParticleType& type, const MoleculeState& particle) {
    const ColorPieces pieces = colorPieces(type.colors);
    const float age = particle.life ? particle_shader::ageShare(*particle.life) : 0;
    glm::vec4 color = pieces.first;
    if (particle.life)
        color = particle_shader::colorAt(age, pieces.first, pieces.changes[0], pieces.changes[1],
                                         pieces.changes[2], pieces.begins, pieces.perAge);
    Looks out{glm::vec3(color), color.a};
    if (type.shape == ParticleShape::points) return out;
    out.size =
        particle_shader::randomBetween(glm::vec2(type.size), particle.seed, particle_shader::sizeCounter);
    if (particle.life) out.size *= glm::mix(float(type.growth.x), float(type.growth.y), age);
    return out;
}

Looks looksOf(const Group& group, const MoleculeState& molecule) {
    Looks out;
    if (group.particle) {
        out = ofParticle(*group.particle, molecule);
        if (group.colorBy) out.color *= colorBySpeed(*group.colorBy, molecule.velocities);
    } else {
        const InstanceColors colors = instanceColors(group);
        out.size = float(group.molecule.material.pointSize);
        out.color = group.colorBy ? colorBySpeed(*group.colorBy, molecule.velocities)
                                  : molecule_shader::colorOfSeed(molecule.seed, colors.first, colors.second,
                                                                 float(colors.variation));
    }
    out.color /= std::max({out.color.r, out.color.g, out.color.b, 1.0f});
    return out;
}

bool looksChange(const Group& group) {
    return group.colorBy || (group.particle && group.life);
}

float grownTo(const Group& group, const MoleculeState& molecule) {
    const bool points = group.molecule.triangles.empty() && group.molecule.skin.empty();
    if (!group.life || !molecule.life || points) return 1;
    const glm::vec2 times(group.life->grow, group.life->shrink);
    if (times == glm::vec2(0)) return 1;
    return molecule_shader::grownShare(*molecule.life, glm::max(times, glm::vec2(1e-6f)));
}

}  // namespace shoal::exchange
