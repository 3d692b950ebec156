#include "render/molecule_state.h"

#include "render/lighting.h"

namespace shoal {

std::vector<std::string> stateDefines(const StateView& state, const BufferLayout& layout) {
    std::vector<std::string> out;
    if (layout.life) out.emplace_back("LIFE");
    if (state.textures) {
        out.push_back(concat("STATE_WIDTH ", stateWidth));
        return out;
    }
    out.insert(out.end(), {"STATE_BUFFERS", concat("BLOCK ", BufferLayout::block),
                           concat("POSITION_ELEMENTS ", layout.positionElements()),
                           concat("STATE_ELEMENTS ", layout.stateElements())});
    if (layout.lifeApart()) out.emplace_back("LIFE_APART");
    return out;
}

void bindState(const gpu::Program& program, const StateView& state, size_t index, const glm::ivec4& rows,
               const GroupBuffers::Part* part) {
    if (state.textures) {
        const TextureState& textures = *state.textures;
        program.texture("positions", unit::positions, textures.position.read(index));
        program.texture("velocities", unit::velocities, textures.velocity.read(index));
        program.texture("records", unit::records, textures.record.read(index));
        program.texture("constants", unit::constants, textures.constant);
        if (textures.normal) program.texture("normals", unit::normals, textures.normal);
        program.set("groupRows", rows);
        return;
    }
    const GroupBuffers& buffers = (*state.buffers)[index];
    program.texture("states", unit::positions, buffers.oldState(*part));
    program.texture("records", unit::records, part->record);
    if (buffers.hasNormals()) program.texture("normals", unit::normals, part->normal);
}

}  // namespace shoal
