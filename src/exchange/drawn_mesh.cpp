#include "exchange/drawn_mesh.h"

#include <algorithm>
#include <filesystem>

#include "scene/collider_mesh.h"

namespace shoal::exchange {

namespace {

template <typename Triangles>
std::vector<uint32_t> cornersOf(const Triangles& triangles) {
    std::vector<uint32_t> out;
    for (const auto& t : triangles)
        for (const int corner : {t.a, t.b, t.c})
            out.push_back(uint32_t(corner));
    return out;
}

template <typename Vertices>
std::vector<glm::vec2> uvsOf(const Vertices& vertices) {
    std::vector<glm::vec2> out;
    for (const auto& vertex : vertices)
        out.emplace_back(vertex.uv);
    return out;
}

SurfaceMaterial materialOf(const Material& looks) {
    SurfaceMaterial out;
    out.roughness = looks.roughness;
    out.metallic = looks.metallic;
    out.alphaCut = looks.alphaCut;
    out.color.a = looks.blend == Blend::none ? 1 : looks.opacity;
    if (!looks.texture.empty()) {
        out.colorImage = 0;
        out.alpha = SurfaceMaterial::Alpha::cut;
    }
    if (looks.blend != Blend::none) out.alpha = SurfaceMaterial::Alpha::blend;
    return out;
}

}  // namespace

GroupMesh::GroupMesh(const Group& group) : group_(&group), material_(materialOf(group.molecule.material)) {
    const Molecule& molecule = group.molecule;
    if (molecule.skin.empty()) {
        corners_ = cornersOf(molecule.triangles);
        uvs_ = uvsOf(molecule.vertices);
    } else {
        corners_ = cornersOf(molecule.skin.triangles);
        uvs_ = uvsOf(molecule.skin.vertices);
        frames_ = skinFrames(molecule);
    }
    if (points() || molecule.material.texture.empty()) {
        material_.colorImage = -1;
        if (material_.alpha == SurfaceMaterial::Alpha::cut) material_.alpha = SurfaceMaterial::Alpha::opaque;
        return;
    }
    const std::filesystem::path folder = std::filesystem::path(molecule.file).parent_path();
    images_.push_back(readPng(folder / molecule.material.texture));
}

void GroupMesh::place(const MoleculeState& state, std::vector<glm::dvec3>& positions,
                      std::vector<glm::vec3>& normals) const {
    const Molecule& molecule = group_->molecule;
    std::vector<glm::dvec3> simulated(state.positions.begin(), state.positions.end());
    const double grown = grownTo(*group_, state);
    if (grown < 1)
        for (glm::dvec3& x : simulated)
            x = glm::mix(state.positions[0], x, grown);
    if (molecule.skin.empty()) {
        positions.insert(positions.end(), simulated.begin(), simulated.end());
        for (const glm::dvec3& n : vertexNormals(molecule, simulated))
            normals.emplace_back(n);
        return;
    }
    const std::vector<glm::dvec3> skin = skinPositions(molecule, simulated);
    positions.insert(positions.end(), skin.begin(), skin.end());
    for (const glm::dvec3& n : skinNormals(molecule, frames_, simulated))
        normals.emplace_back(n);
}

void GroupMesh::addVelocities(std::span<const glm::dvec3> simulated,
                              std::vector<glm::vec3>& velocities) const {
    const Skin& skin = group_->molecule.skin;
    if (skin.empty())
        for (const glm::dvec3& v : simulated)
            velocities.emplace_back(v);
    for (const SkinVertex& vertex : skin.vertices) {
        glm::dvec3 sum(0);
        for (const SkinWeight& weight : vertex.weights)
            sum += weight.weight * simulated[size_t(weight.vertex)];
        velocities.emplace_back(sum);
    }
}

DrawnMesh GroupMesh::mesh(std::span<const MoleculeState> molecules) const {
    DrawnMesh out;
    out.name = name();
    out.images = images_;
    for (size_t i = 0; i < molecules.size(); ++i) {
        const Looks looks = looksOf(*group_, molecules[i]);
        out.uvs.insert(out.uvs.end(), uvs_.begin(), uvs_.end());
        out.colors.insert(out.colors.end(), uvs_.size(), looks.color);
        if (group_->particle && group_->particle->blend != Blend::none)
            out.opacities.insert(out.opacities.end(), uvs_.size(), looks.opacity);
        if (points() && looks.size > 0) out.sizes.insert(out.sizes.end(), uvs_.size(), looks.size);
        for (const uint32_t corner : corners_)
            out.corners.push_back(uint32_t(i * uvs_.size()) + corner);
    }
    out.pieces.push_back({0, out.corners.size(), material_});
    return out;
}

std::vector<glm::dvec3> GroupMesh::restPlaces() const {
    std::vector<glm::dvec3> out;
    for (const Vertex& vertex : group_->molecule.vertices)
        out.push_back(vertex.position);
    return out;
}

DrawnMesh modelMesh(const Model& model) {
    const Mesh& mesh = model.mesh;
    DrawnMesh out;
    out.name = model.name;
    out.images = mesh.images;
    recentre(out, mesh.positions);
    for (const glm::dvec3& n : mesh.normals)
        out.normals.emplace_back(n);
    for (const glm::dvec2& uv : mesh.uvs)
        out.uvs.emplace_back(uv);
    // Other programs take colours up to 1.
    for (const glm::dvec3& color : mesh.colors)
        out.colors.emplace_back(glm::min(color * model.color, 1.0));
    for (const MeshPiece& alike : piecesByLook(mesh, out.corners)) {
        SurfaceMaterial material;
        if (alike.look >= 0) material = mesh.materials[size_t(alike.look)];
        if (mesh.colors.empty()) material.color *= glm::dvec4(model.color, 1);
        material.color = glm::min(material.color, 1.0);
        if (model.roughness) material.roughness = *model.roughness;
        out.pieces.push_back({alike.first, alike.count, material});
    }
    return out;
}

DrawnMesh colliderMesh(const Collider& collider, const glm::dvec3& eye, double time) {
    DrawnMesh out;
    if (!collider.draw) return out;
    out.name = collider.name.empty() ? kindName(*collider.shape) : collider.name;
    const ColliderMesh mesh = shoal::colliderMesh(collider);
    const Pose pose = collider.path ? poseAt(*collider.path, time) : Pose{};
    glm::dvec3 origin = pose.rotation * mesh.origin + pose.position;
    double scale = 1;
    const auto* plane = kindOf<PlaneCollider>(*collider.shape);
    if (plane) {
        const PlaneDisc disc =
            seenOf({pose.rotation * plane->point + pose.position, pose.rotation * plane->normal}, eye);
        origin = disc.foot;
        scale = disc.radius;
    }
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& x : mesh.positions)
        positions.push_back(origin + pose.rotation * (scale * glm::dvec3(x)));
    recentre(out, positions);
    for (const glm::vec3& n : mesh.normals)
        out.normals.emplace_back(pose.rotation * glm::dvec3(n));
    out.corners = mesh.corners;
    SurfaceMaterial material;
    material.color = glm::dvec4(collider.color, 1);
    if (!plane) material.roughness = 0.5;
    out.pieces.push_back({0, out.corners.size(), material});
    return out;
}

glm::dvec3 originOf(const std::vector<glm::dvec3>& positions) {
    constexpr double near = 64;  // m: a float's digits are below 4 micrometres
    if (positions.empty()) return glm::dvec3(0);
    glm::dvec3 low = positions[0], high = low;
    for (const glm::dvec3& p : positions)
        low = glm::min(low, p), high = glm::max(high, p);
    const glm::dvec3 middle = glm::round(0.5 * (low + high));
    return glm::length(middle) > near ? middle : glm::dvec3(0);
}

void recentre(DrawnMesh& mesh, const std::vector<glm::dvec3>& positions) {
    mesh.origin = originOf(positions);
    mesh.positions.clear();
    for (const glm::dvec3& p : positions)
        mesh.positions.emplace_back(p - mesh.origin);
}

glm::dmat3 directionsOf(const Camera& camera) {
    const glm::dvec3 away = camera.eye - camera.target;
    const glm::dvec3 back = glm::length(away) > 0 ? glm::normalize(away) : glm::dvec3(0, 0, 1);
    const glm::dvec3 up = std::abs(back.y) < 0.999 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

}  // namespace shoal::exchange
