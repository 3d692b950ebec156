#include "render/molecule_drawer.h"

#include "render/leaf_image.h"

namespace shoal {

MoleculeDrawer::MoleculeDrawer(gpu::Context& context, const std::string& shaderRoot, const Scene& scene,
                               const Plan& plan, const Lighting& lighting, const ShadowMap* shadow)
    : context_(&context) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        if (group.count == 0) continue;
        groups_.push_back(make(shaderRoot, scene.groups[group.index], group, lighting, shadow != nullptr));
        groups_.back().index = g;
    }
}

MoleculeDrawer::Drawn MoleculeDrawer::make(const std::string& shaderRoot, const Group& group,
                                           const GroupPlan& plan, const Lighting& lighting,
                                           bool casts) const {
    const Material& material = group.molecule.material;
    Drawn out;
    out.count = plan.count;
    out.vertexCount = plan.vertexCount;
    out.rows = glm::ivec4(plan.firstRow, plan.slabRows, plan.firstRecordRow, 0);
    out.color = glm::vec3(group.color.value_or(material.color));
    out.secondColor =
        glm::vec3(group.secondColor ? *group.secondColor
                                    : group.color.value_or(material.secondColor.value_or(material.color)));
    out.alphaCut = float(material.alphaCut);
    out.roughness = float(material.roughness);
    out.translucency = float(material.translucency);
    out.pointSize = float(material.pointSize);
    out.corners = gpu::VertexArray(*context_, group.name.c_str());

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

    gpu::ProgramOptions options;
    options.defines = {concat("STATE_WIDTH ", stateWidth)};
    if (!points && !material.texture.empty()) {
        out.image = loadLeafImage(*context_, group.molecule);
        options.defines.push_back("TEXTURED");
    }
    const std::vector<std::string> common = options.defines;
    for (const std::string& define : lighting.defines())
        options.defines.push_back(define);
    options.vertex = points ? "render/points.vert" : "render/molecule.vert";
    options.fragment = points ? "render/points.frag" : "render/molecule.frag";
    options.label = group.name + " (picture)";
    out.lit = gpu::Program(*context_, shaderRoot, options);
    if (casts) {
        options.defines = common;
        options.defines.push_back("DEPTH_ONLY");
        if (!points) options.fragment = "render/molecule_shadow.frag";
        options.label = group.name + " (shadow)";
        out.depth = gpu::Program(*context_, shaderRoot, options);
    }
    return out;
}

void MoleculeDrawer::bindState(const gpu::Program& program, const Drawn& group, const State& state) const {
    program.texture("positions", unit::positions, state.position.read(group.index));
    program.texture("records", unit::records, state.record.read(group.index));
    program.texture("constants", unit::constants, state.constant);
    if (state.normal) program.texture("normals", unit::normals, state.normal);
    program.set("groupRows", group.rows);
}

void MoleculeDrawer::submit(const Drawn& group) const {
    group.corners.bind();
    if (group.indexCount > 0) {
        glDrawElementsInstanced(GL_TRIANGLES, group.indexCount, GL_UNSIGNED_INT, nullptr, group.count);
    } else {
        glEnable(GL_PROGRAM_POINT_SIZE);
        glDrawArraysInstanced(GL_POINTS, 0, group.vertexCount, group.count);
        glDisable(GL_PROGRAM_POINT_SIZE);
    }
}

void MoleculeDrawer::drawShadows(const State& state, const ShadowMap& shadow) const {
    for (const Drawn& group : groups_) {
        const gpu::Program& program = group.depth;
        program.use();
        bindState(program, group, state);
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
        submit(group);
    }
}

void MoleculeDrawer::draw(const State& state, const Eye& eye, const Lighting& lighting,
                          bool multisampled) const {
    if (multisampled) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    for (const Drawn& group : groups_) {
        const gpu::Program& program = group.lit;
        program.use();
        bindState(program, group, state);
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
        submit(group);
    }
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

}  // namespace shoal
