#include <algorithm>

#include "geometry/mesh_levels.h"
#include "gpu/shader_source.h"
#include "molecule/skin.h"
#include "render/group_drawer.h"

namespace shoal {

template <typename Triangles>
static std::vector<uint32_t> cornersOf(const Triangles& triangles) {
    std::vector<uint32_t> out;
    for (const auto& t : triangles)
        for (const int corner : {t.a, t.b, t.c})
            out.push_back(uint32_t(corner));
    return out;
}

// All of it where there are few triangles in all: ordering the molecules would cost about as much.
static std::vector<MeshLevel> levelsOf(const Skin& skin, int molecules) {
    constexpr int64_t few = 20000;
    if (int64_t(skin.triangles.size()) * molecules < few) return {{cornersOf(skin.triangles), 0}};
    std::vector<glm::dvec3> positions;
    for (const SkinVertex& vertex : skin.vertices)
        positions.push_back(vertex.position);
    return levelsOf(positions, skinNormals(skin), cornersOf(skin.triangles));
}

MoleculeDrawer::MoleculeDrawer(gpu::Context& context, gpu::Programs& programs, const Group& group,
                               const GroupPlan& plan, size_t index, const Lighting& lighting)
    : GroupDrawer(context, programs, plan, index),
      material_(group.molecule.material),
      points_(group.molecule.triangles.empty() && group.molecule.skin.empty()) {
    if (group.life && !points_) grow_ = group.life->grow, shrink_ = group.life->shrink;
    change(group);
    if (points_)
        streams_ = {{plan.vertexCount, false}};
    else if (!group.molecule.skin.empty())
        makeSkinCorners(group.molecule);
    else
        makeCorners(group.molecule.vertices, cornersOf(group.molecule.triangles));
    if (!points_ && !material_.texture.empty()) image_ = loadImage(context, group.molecule);
    chooseShaders(lighting);
}

bool MoleculeDrawer::change(const Group& group) {
    if (group.life && !points_) {
        if (grows() != (group.life->grow > 0 || group.life->shrink > 0)) return false;  // another program
        grow_ = group.life->grow;
        shrink_ = group.life->shrink;
    }
    const Material& looks = group.molecule.material;
    material_.roughness = looks.roughness;
    material_.translucency = looks.translucency;
    material_.opacity = looks.opacity;
    colors_ = instanceColors(group);
    return true;
}

template <typename Vertices>
void MoleculeDrawer::makeCorners(const Vertices& vertices, const std::vector<uint32_t>& indices) {
    std::vector<glm::vec2> uvs;
    for (const auto& vertex : vertices)
        uvs.emplace_back(vertex.uv);
    using Use = gpu::Buffer::Use;
    uvs_ = gpu::Buffer(*context_, Use::vertex, std::span<const glm::vec2>(uvs), "molecule uvs");
    indices_ = gpu::Buffer(*context_, Use::index, std::span<const uint32_t>(indices), "molecule triangles");
    corners_.attribute(0, uvs_, 2, sizeof(glm::vec2), 0);
    corners_.indices(indices_);
    streams_ = {{int(indices.size()), true}};
}

void MoleculeDrawer::makeSkinCorners(const Molecule& molecule) {
    std::vector<uint32_t> indices;
    std::vector<DrawStream> streams;
    for (const MeshLevel& level : levelsOf(molecule.skin, count())) {
        streams.push_back({.corners = int(level.corners.size()),
                           .indexed = true,
                           .first = int(indices.size()),
                           .error = level.error});
        indices.insert(indices.end(), level.corners.begin(), level.corners.end());
    }
    makeCorners(molecule.skin.vertices, indices);
    streams_ = std::move(streams);
    // offsets, then as many influences as any vertex has; a weight of 0 changes nothing
    struct Corner {
        glm::vec3 offsets{0};
        glm::vec4 influences[Skin::mostWeights] = {};
    };
    const std::vector<SkinFrame> frames = skinFrames(molecule);
    std::vector<Corner> corners(frames.size());
    size_t most = 1;
    bool offsets = false;
    for (size_t i = 0; i < frames.size(); ++i) {
        const SkinVertex& vertex = molecule.skin.vertices[i];
        const SkinFrame& frame = frames[i];
        corners[i].offsets = glm::vec3(vertex.offset, frame.alongOffset, frame.acrossOffset);
        offsets = offsets || corners[i].offsets != glm::vec3(0);
        most = std::max(most, vertex.weights.size());
        for (size_t k = 0; k < vertex.weights.size(); ++k)
            corners[i].influences[k] = glm::vec4(vertex.weights[k].vertex, vertex.weights[k].weight,
                                                 frame.along[k], frame.across[k]);
    }
    skin_ =
        gpu::Buffer(*context_, gpu::Buffer::Use::vertex, std::span<const Corner>(corners), "skin weights");
    corners_.attribute(1, skin_, 3, sizeof(Corner), offsetof(Corner, offsets));
    for (int k = 0; k < int(most); ++k)
        corners_.attribute(2 + k, skin_, 4, sizeof(Corner),
                           int(offsetof(Corner, influences)) + k * int(sizeof(glm::vec4)));
    skinWeights_ = int(most);
    skinOffsets_ = offsets;
}

void MoleculeDrawer::chooseShaders(const Lighting& lighting) {
    gpu::ProgramOptions& depth = depthOptions_;
    depth.defines = {gpu::constant("TEXTURED", bool(image_)), gpu::constant("GROWS", grows()),
                     concat("SKIN_WEIGHTS ", skinWeights_), gpu::constant("SKIN_OFFSETS", skinOffsets_)};
    depth.vertex = points_            ? "render/points.vert"
                   : skinWeights_ > 0 ? "render/skinned.vert"
                                      : "render/molecule.vert";
    depth.fragment = points_ ? "render/points_shadow.frag" : "render/molecule_shadow.frag";
    litOptions_ = depth;
    litOptions_.fragment = points_ ? "render/points.frag" : "render/molecule.frag";
    for (const std::string& define : lighting.defines())
        litOptions_.defines.push_back(define);
    litOptions_.defines.push_back(gpu::constant("METALLIC", material_.metallic > 0));
    litOptions_.defines.push_back(blendDefine(material_.blend));
    litOptions_.label = name_ + " (picture)";
    depth.label = name_ + " (shadow)";
}

void MoleculeDrawer::setShape(const gpu::Program& program, float pixelsPerMeter) const {
    if (image_) {
        program.texture("image", image_);
        program.set("alphaCut", float(material_.alphaCut));
    }
    constexpr float atOnce = 1e-6f;  // s
    if (grows()) program.set("growTimes", glm::max(glm::vec2(grow_, shrink_), glm::vec2(atOnce)));
    if (!points_) return;
    program.set("pointSize", float(material_.pointSize));
    program.set("pixelsPerMeter", pixelsPerMeter);
}

const gpu::Program& MoleculeDrawer::useDepth(const StateView& state, const ShadowMap& shadow, double) {
    const gpu::Program& program = beginDepth(state, shadow);
    setShape(program, shadow.pixelsPerMeter());
    return program;
}

const gpu::Program& MoleculeDrawer::useLit(const StateView& state, const DrawInputs& inputs) {
    const gpu::Program& program = beginLit(state, inputs);
    if (!scale_) {
        program.set("firstColor", glm::vec3(colors_.first));
        program.set("secondColor", glm::vec3(colors_.second));
        program.set("variation", float(colors_.variation));
    }
    program.set("roughness", float(material_.roughness));
    program.set("metallic", float(material_.metallic));
    program.set("opacity", float(material_.opacity));
    setShape(program, inputs.eye.pixelsPerMeter);
    program.set("translucency", float(material_.translucency));
    if (points_) program.set("viewToScene", inputs.eye.viewToScene);
    return program;
}

}  // namespace shoal
