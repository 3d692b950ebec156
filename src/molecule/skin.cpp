#include "molecule/skin.h"

namespace shoal {

namespace {

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

glm::dvec3 sum(const std::vector<SkinWeight>& weights, const std::vector<glm::dvec3>& values) {
    glm::dvec3 out(0);
    for (const SkinWeight& w : weights)
        out += w.weight * values[size_t(w.vertex)];
    return out;
}

}  // namespace

void sumNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                std::vector<glm::dvec3>& out) {
    out.assign(positions.size(), glm::dvec3(0));
    for (const Triangle& t : molecule.triangles) {
        const glm::dvec3 a = positions[size_t(t.a)];
        const glm::dvec3 area = glm::cross(positions[size_t(t.b)] - a, positions[size_t(t.c)] - a);
        for (const int corner : {t.a, t.b, t.c})
            out[size_t(corner)] += area;
    }
    for (glm::dvec3& n : out)
        n = unit(n);
}

std::vector<glm::dvec3> vertexNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions) {
    std::vector<glm::dvec3> out;
    sumNormals(molecule, positions, out);
    return out;
}

std::vector<glm::dvec3> skinPositions(const Molecule& molecule, const std::vector<glm::dvec3>& positions) {
    const std::vector<glm::dvec3> normals = vertexNormals(molecule, positions);
    std::vector<glm::dvec3> out;
    for (const SkinVertex& vertex : molecule.skin.vertices) {
        glm::dvec3 at = sum(vertex.weights, positions);
        if (vertex.offset != 0) at += vertex.offset * unit(sum(vertex.weights, normals));
        out.push_back(at);
    }
    return out;
}

void placeSkin(Molecule& molecule) {
    std::vector<glm::dvec3> rest;
    for (const Vertex& vertex : molecule.vertices)
        rest.push_back(vertex.position);
    const std::vector<glm::dvec3> places = skinPositions(molecule, rest);
    for (size_t i = 0; i < places.size(); ++i)
        molecule.skin.vertices[i].position = places[i];
}

}  // namespace shoal
