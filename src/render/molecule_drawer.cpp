#include "render/molecule_drawer.h"

#include <algorithm>

#include "render/leaf_image.h"
#include "render/molecule_state.h"

namespace shoal {

MoleculeDrawer::MoleculeDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene,
                               const Plan& plan, const Lighting& lighting, int slabs)
    : context_(&context), shaderRoot_(shaderRoot) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        if (group.count == 0) continue;
        groups_.push_back(make(scene.groups[group.index], group, lighting));
        groups_.back().index = g;
    }
    makeOrders(context, scene, plan, slabs);
}

MoleculeDrawer::Drawn MoleculeDrawer::make(const Group& group, const GroupPlan& plan,
                                           const Lighting& lighting) const {
    const Material& material = group.molecule.material;
    Drawn out;
    out.count = plan.count;
    out.vertexCount = plan.vertexCount;
    out.layout = plan.layout();
    out.rows = glm::ivec4(plan.texture.firstRow, plan.texture.slabRows, plan.texture.firstRecordRow, 0);
    out.color = glm::vec3(group.color.value_or(material.color));
    out.secondColor =
        glm::vec3(group.secondColor ? *group.secondColor
                                    : group.color.value_or(material.secondColor.value_or(material.color)));
    out.alphaCut = float(material.alphaCut);
    out.roughness = float(material.roughness);
    out.translucency = float(material.translucency);
    out.pointSize = float(material.pointSize);
    out.corners = gpu::VertexArray(*context_, group.name.c_str());

    out.blend = material.blend;
    out.opacity = float(material.opacity);

    const bool points = group.molecule.triangles.empty();
    if (!points) {
        std::vector<glm::vec2> uvs;
        for (const Vertex& vertex : group.molecule.vertices)
            uvs.emplace_back(vertex.uv);
        std::vector<uint32_t> indices;
        for (const Triangle& t : group.molecule.triangles) {
            for (const int corner : {t.a, t.b, t.c})
                indices.push_back(uint32_t(corner));
        }
        out.indexCount = int(indices.size());
        out.uvs =
            gpu::Buffer(*context_, gpu::Buffer::Use::vertex, std::span<const glm::vec2>(uvs), "molecule uvs");
        out.indices = gpu::Buffer(*context_, gpu::Buffer::Use::index, std::span<const uint32_t>(indices),
                                  "molecule triangles");
        out.corners.attribute(0, out.uvs, 2, sizeof(glm::vec2), 0);
        out.corners.indices(out.indices);
    }

    gpu::ProgramOptions& depth = out.depthOptions;
    if (!points && !material.texture.empty()) {
        out.image = loadLeafImage(*context_, group.molecule);
        depth.defines.push_back("TEXTURED");
    }
    depth.vertex = points ? "render/points.vert" : "render/molecule.vert";
    depth.fragment = points ? "render/points.frag" : "render/molecule.frag";
    out.litOptions = depth;
    for (const std::string& define : lighting.defines())
        out.litOptions.defines.push_back(define);
    if (out.blend != Blend::none) out.litOptions.defines.push_back("BLENDED");
    if (out.blend == Blend::multiplicative) out.litOptions.defines.push_back("FILTERS");
    out.litOptions.label = group.name + " (picture)";
    depth.defines.push_back("DEPTH_ONLY");
    if (!points) depth.fragment = "render/molecule_shadow.frag";
    depth.label = group.name + " (shadow)";
    return out;
}

// The variant that reads this kind of state.
const gpu::Program& MoleculeDrawer::program(const Drawn& group, std::array<gpu::Program, 2>& programs,
                                            const gpu::ProgramOptions& options,
                                            const StateView& state) const {
    gpu::Program& program = programs[state.textures ? 0 : 1];
    if (program) return program;
    gpu::ProgramOptions wanted = options;
    const std::vector<std::string> defines = stateDefines(state, group.layout);
    wanted.defines.insert(wanted.defines.end(), defines.begin(), defines.end());
    program = gpu::Program(*context_, shaderRoot_, wanted);
    return program;
}

void MoleculeDrawer::submit(const gpu::Program& program, const Drawn& group, const StateView& state) const {
    if (state.textures) {
        bindState(program, state, group.index, group.rows, nullptr);
        return drawInstances(group, group.count);
    }
    for (const GroupBuffers::Part& part : (*state.buffers)[group.index].parts()) {
        bindState(program, state, group.index, group.rows, &part);
        drawInstances(group, part.count);
    }
}

void MoleculeDrawer::drawInstances(const Drawn& group, int count) const {
    group.corners.bind();
    if (group.indexCount > 0) {
        glDrawElementsInstanced(GL_TRIANGLES, group.indexCount, GL_UNSIGNED_INT, nullptr, count);
    } else {
        glEnable(GL_PROGRAM_POINT_SIZE);
        glDrawArraysInstanced(GL_POINTS, 0, group.vertexCount, count);
        glDisable(GL_PROGRAM_POINT_SIZE);
    }
}

void MoleculeDrawer::drawShadows(const StateView& state, const ShadowMap& shadow) {
    for (Drawn& group : groups_) {
        if (group.blend != Blend::none) continue;
        const gpu::Program& program = this->program(group, group.depth, group.depthOptions, state);
        program.use();
        shadow.origin().apply(program);
        program.set("toClip", shadow.toClip());
        if (group.image) {
            program.texture("image", unit::image, group.image);
            program.set("alphaCut", group.alphaCut);
        }
        if (group.indexCount == 0) {
            program.set("pointSize", group.pointSize);
            program.set("pixelsPerMeter", shadow.pixelsPerMeter());
        }
        submit(program, group, state);
    }
}

const gpu::Program& MoleculeDrawer::useLit(Drawn& group, const StateView& state, const Eye& eye,
                                           const Lighting& lighting) {
    const gpu::Program& program = this->program(group, group.lit, group.litOptions, state);
    program.use();
    eye.origin.apply(program);
    lighting.apply(program, eye);
    program.set("toClip", eye.toClip);
    program.set("firstColor", group.color);
    program.set("secondColor", group.secondColor);
    program.set("roughness", group.roughness);
    if (group.image) {
        program.texture("image", unit::image, group.image);
        program.set("alphaCut", group.alphaCut);
    }
    if (group.indexCount > 0) {
        program.set("translucency", group.translucency);
    } else {
        program.set("pointSize", group.pointSize);
        program.set("pixelsPerMeter", eye.pixelsPerMeter);
        program.set("viewToScene", eye.viewToScene);
    }
    return program;
}

void MoleculeDrawer::draw(const StateView& state, const Eye& eye, const Lighting& lighting,
                          bool multisampled) {
    if (multisampled) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    for (Drawn& group : groups_)
        if (group.blend == Blend::none) submit(useLit(group, state, eye, lighting), group, state);
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

}  // namespace shoal
