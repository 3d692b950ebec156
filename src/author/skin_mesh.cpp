#include "author/from_mesh.h"
#include "geometry/mesh_levels.h"

#include <algorithm>
#include <cmath>

#include "author/coarse.h"
#include "molecule/molecule_file.h"
#include "molecule/skin.h"

namespace shoal {

namespace {

constexpr double crease = 0.766;  // cosine of 40 degrees, as in skinNormals()

// Corners of the file that look alike are one vertex.
SkinMesh joined(const Mesh& mesh) {
    SkinMesh out;
    std::vector<std::vector<size_t>> verticesAt(mesh.weldedPositions.size());
    std::vector<glm::dvec3> normals;
    std::vector<int> numbers;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::dvec2 uv = mesh.uvs.empty() ? glm::dvec2(0) : mesh.uvs[v];
        std::vector<size_t>& here = verticesAt[size_t(mesh.weld[v])];
        const auto same = [&](size_t s) {
            return glm::distance(out.uvs[s], uv) < 1e-6 && glm::dot(normals[s], mesh.normals[v]) > crease;
        };
        const auto found = std::find_if(here.begin(), here.end(), same);
        numbers.push_back(int(found != here.end() ? *found : out.positions.size()));
        if (found != here.end()) continue;
        here.push_back(out.positions.size());
        out.positions.push_back(mesh.weldedPositions[size_t(mesh.weld[v])]);
        out.uvs.push_back(uv);
        normals.push_back(mesh.normals[v]);
    }
    for (const glm::ivec3& t : mesh.triangles) {
        const SkinTriangle triangle{numbers[size_t(t.x)], numbers[size_t(t.y)], numbers[size_t(t.z)]};
        if (triangle.a != triangle.b && triangle.b != triangle.c && triangle.c != triangle.a)
            out.triangles.push_back(triangle);
    }
    return out;
}

void simplify(SkinMesh& mesh, const glm::dvec3& middle, size_t triangles) {
    std::vector<glm::vec3> positions;  // about the middle, whatever the distance from the origin
    for (const glm::dvec3& p : mesh.positions)
        positions.emplace_back(p - middle);
    std::vector<unsigned> corners;
    for (const SkinTriangle& t : mesh.triangles)
        for (const int corner : {t.a, t.b, t.c})
            corners.push_back(unsigned(corner));
    const std::vector<unsigned> few = collapseEdges(corners, positions, triangles);
    mesh.triangles.clear();
    for (size_t t = 0; t < few.size(); t += 3)
        mesh.triangles.push_back({int(few[t]), int(few[t + 1]), int(few[t + 2])});
}

// Without vertices that no triangle has.
SkinMesh packed(const SkinMesh& mesh) {
    std::vector<int> kept(mesh.positions.size(), -1);
    SkinMesh out;
    for (SkinTriangle t : mesh.triangles) {
        for (int* corner : {&t.a, &t.b, &t.c}) {
            int& number = kept[size_t(*corner)];
            if (number < 0) {
                number = int(out.positions.size());
                out.positions.push_back(mesh.positions[size_t(*corner)]);
                out.uvs.push_back(mesh.uvs[size_t(*corner)]);
            }
            *corner = number;
        }
        out.triangles.push_back(t);
    }
    return out;
}

}  // namespace

Skin bindToCells(const Molecule& molecule, const SkinMesh& mesh,
                 const std::vector<std::array<int, 4>>& cells) {
    // A cell's first corner and the matrix from which a point's weights follow.
    struct Frame {
        glm::dvec3 first{0};
        glm::dmat3 toWeights{1};
    };
    std::vector<Frame> frames;
    const auto place = [&](int v) { return molecule.vertices[size_t(v)].position; };
    for (const std::array<int, 4>& cell : cells) {
        const glm::dvec3 first = place(cell[0]);
        frames.push_back({first, glm::inverse(glm::dmat3(place(cell[1]) - first, place(cell[2]) - first,
                                                         place(cell[3]) - first))});
    }
    Skin out;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        std::array<double, 4> best{};
        size_t bestCell = 0;
        double least = 1e300;  // the sum of the weights' sizes: 1 inside
        for (size_t c = 0; c < cells.size(); ++c) {
            const glm::dvec3 w = frames[c].toWeights * (mesh.positions[i] - frames[c].first);
            const double first = 1 - w.x - w.y - w.z;
            const double sum = std::abs(first) + std::abs(w.x) + std::abs(w.y) + std::abs(w.z);
            if (sum >= least - 1e-9) continue;
            least = sum;
            bestCell = c;
            best = {first, w.x, w.y, w.z};
        }
        SkinVertex vertex;
        vertex.uv = mesh.uvs[i];
        double rest = 1;
        for (size_t k = 1; k < 4; ++k) {
            const double weight = std::round(best[k] * 1e7) / 1e7;
            vertex.weights.push_back({cells[bestCell][k], weight});
            rest -= weight;
        }
        vertex.weights.push_back({cells[bestCell][0], std::round(rest * 1e7) / 1e7});
        out.vertices.push_back(std::move(vertex));
    }
    out.triangles = mesh.triangles;
    return out;
}

SkinMesh skinMeshOf(const Mesh& mesh, std::optional<int> triangles) {
    SkinMesh out = joined(mesh);
    if (triangles) simplify(out, 0.5 * (mesh.low + mesh.high), size_t(*triangles));
    out = packed(out);
    if (out.positions.size() > size_t(maxSkinVertices) || out.triangles.size() > size_t(maxSkinTriangles))
        throw Error("a skin of ", out.positions.size(), " vertices and ", out.triangles.size(),
                    " triangles is larger than a molecule file holds, ", maxSkinVertices, " and ",
                    maxSkinTriangles, ": ask for fewer triangles of the skin, or leave it out");
    return out;
}

}  // namespace shoal
