#include "render/spring_lines.h"

#include "gpu/gl.h"
#include "render/molecule_state.h"

namespace shoal {

SpringLines::SpringLines(gpu::Context& context, const std::string& shaderRoot, const Scene& scene,
                         const Plan& plan)
    : context_(&context), shaderRoot_(shaderRoot) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        const Molecule& molecule = scene.groups[group.index].molecule;
        if (molecule.springs.empty() || group.count == 0) continue;
        std::vector<glm::vec3> ends;
        for (const Spring& spring : molecule.springs) {
            const float rest = float(molecule.restLength(spring));
            for (int corner = 0; corner < 6; ++corner)
                ends.emplace_back(float(spring.a), float(spring.b), rest);
        }
        Drawn drawn;
        drawn.index = g;
        drawn.count = group.count;
        drawn.corners = int(ends.size());
        drawn.scaled = group.needs.scale || group.needs.phase;
        drawn.rows =
            glm::ivec4(group.texture.firstRow, group.texture.slabRows, group.texture.firstRecordRow, 0);
        drawn.layout = group.layout();
        drawn.name = group.name;
        drawn.ends =
            gpu::Buffer(context, gpu::Buffer::Use::vertex, std::span<const glm::vec3>(ends), "springs");
        drawn.array = gpu::VertexArray(context, "springs");
        drawn.array.attribute(0, drawn.ends, 3, sizeof(glm::vec3), 0);
        groups_.push_back(std::move(drawn));
    }
}

void SpringLines::draw(const StateView& state, const DrawInputs& inputs, double strainShown, double width) {
    for (Drawn& group : groups_)
        draw(group, state, inputs, strainShown, width, {});
}

void SpringLines::drawOne(const StateView& state, const DrawInputs& inputs, double strainShown, double width,
                          size_t group, int molecule) {
    for (Drawn& drawn : groups_)
        if (drawn.index == group) draw(drawn, state, inputs, strainShown, width, molecule);
}

const gpu::Program& SpringLines::program(Drawn& group, const StateView& state, const DrawInputs& inputs) {
    gpu::Program& program = group.programs[state.textures ? 0 : 1];
    if (program) return program;
    gpu::ProgramOptions options{"render/spring_lines.vert",
                                "render/lines.frag",
                                inputs.lighting.toneDefines(),
                                {},
                                group.name + " (springs)"};
    for (const std::string& define : stateDefines(state, group.layout))
        options.defines.push_back(define);
    if (group.scaled) options.defines.emplace_back("SCALED");
    program = gpu::Program(*context_, shaderRoot_, options);
    return program;
}

void SpringLines::draw(Drawn& group, const StateView& state, const DrawInputs& inputs, double strainShown,
                       double width, std::optional<int> only) {
    const gpu::Program& lines = program(group, state, inputs);
    lines.use();
    inputs.eye.origin.apply(lines);
    lines.set("toClip", inputs.eye.toClip);
    lines.set("strainShown", float(strainShown));
    lines.set("halfWidth", glm::vec2(float(width)) / inputs.eye.size);
    const auto submit = [&](const GroupBuffers::Part* part, int first, int count) {
        const bool here = !only || (*only >= first && *only < first + count);
        if (!here) return;
        bindState(lines, state, group.index, group.rows, part);
        if (part && group.scaled) lines.texture("constants", unit::constants, part->constant);
        lines.set("firstMolecule", only ? *only - first : 0);
        group.array.bind();
        glDrawArraysInstanced(GL_TRIANGLES, 0, group.corners, only ? 1 : count);
    };
    if (state.textures) return submit(nullptr, 0, group.count);
    for (const GroupBuffers::Part& part : (*state.buffers)[group.index].parts())
        submit(&part, part.first, part.count);
}

}  // namespace shoal
