// What tests of molecules from meshes share.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "author/from_mesh.h"
#include "geometry/mesh.h"
#include "molecule/analysis.h"
#include "molecule/skin.h"
#include "support/bent.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace shoal::test {

inline constexpr double degree = std::numbers::pi / 180;

inline MadeMolecule made(const Mesh& mesh, FromMesh options = {}) {
    if (options.name.empty()) options.name = "made";
    return makeMolecule(mesh, options);
}

inline std::string refused(const Mesh& mesh, const FromMesh& options) {
    return messageOf([&] { makeMolecule(mesh, options); });
}

inline std::vector<glm::dvec3> restOf(const Molecule& molecule) {
    std::vector<glm::dvec3> out;
    for (const Vertex& vertex : molecule.vertices)
        out.push_back(vertex.position);
    return out;
}

inline std::vector<glm::ivec3> trianglesOf(const Skin& skin) {
    std::vector<glm::ivec3> out;
    for (const SkinTriangle& t : skin.triangles)
        out.emplace_back(t.a, t.b, t.c);
    return out;
}

// The skin of simulated vertices that were moved, beside the skin's rest shape moved likewise.
template <typename Move>
SkinFigures moved(const Molecule& molecule, const Move& move) {
    std::vector<glm::dvec3> vertices = restOf(molecule), shape;
    for (glm::dvec3& p : vertices)
        p = move(p);
    for (const SkinVertex& vertex : molecule.skin.vertices)
        shape.push_back(move(vertex.position));
    return compareSkin(skinPositions(molecule, vertices), shape, trianglesOf(molecule.skin));
}

inline void checkBraced(const Molecule& molecule) {
    const Analysis analysis = analyse(molecule, false);
    CHECK(analysis.rigidModes == 6);
    CHECK(analysis.zeroModes == 0);
    CHECK(analysis.lowestFrequency > 0.01 * analysis.highestFrequency);
}

// A strip of paper in the xy plane, n x 2 n squares; y from 0 to 0.2.
inline Mesh strip(int n) {
    Mesh mesh;
    for (int j = 0; j <= 2 * n; ++j)
        for (int i = 0; i <= n; ++i) {
            mesh.positions.emplace_back(0.1 * i / n - 0.05, 0.1 * j / n, 0);
            mesh.uvs.emplace_back(double(i) / n, 0.5 * j / n);
        }
    for (int j = 0; j < 2 * n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    mesh.objects = {{"strip", 0, int(mesh.triangles.size())}};
    completeMesh(mesh);
    return mesh;
}

}  // namespace shoal::test
