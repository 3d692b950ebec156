#include "geometry/polygons.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "geometry/model_reader.h"
#include "geometry/polygon.h"

namespace shoal {

namespace {

// A vertex has one place in the mesh's arrays for each texture coordinate and colour that its corners give
// it: the first is its own, more are listed behind one another.
class Copies {
  public:
    Copies(Mesh& mesh, bool uvs, bool colors, const std::string& file)
        : mesh_(mesh), uvs_(uvs), colors_(colors), file_(file), vertices_(mesh.positions.size()) {
        if (uvs) mesh.uvs.assign(vertices_, glm::dvec2(0));
        if (colors) mesh.colors.assign(vertices_, glm::dvec3(1));
        if (!any()) return;
        used_.assign(vertices_, 0);
        copies_.assign(vertices_, {});
    }

    bool any() const { return uvs_ || colors_; }

    int placeOf(int vertex, const glm::dvec2& uv, const glm::dvec3& color) {
        int index = vertex;
        if (used_[size_t(vertex)]) {
            for (; index >= 0; index = copies_[size_t(index)].next)
                if ((!uvs_ || mesh_.uvs[size_t(index)] == uv) &&
                    (!colors_ || mesh_.colors[size_t(index)] == color))
                    return index;
            index = copyOf(vertex);
        }
        used_[size_t(vertex)] = 1;
        if (uvs_) mesh_.uvs[size_t(index)] = uv;
        if (colors_) mesh_.colors[size_t(index)] = color;
        return index;
    }

    // Where the file has no normals, a vertex has one for all of its copies: a seam of texture coordinates is
    // no edge.
    void smoothSeams() {
        if (mesh_.positions.size() == vertices_) return;
        std::vector<glm::dvec3> sums(vertices_, glm::dvec3(0));
        for (const glm::ivec3& t : mesh_.triangles) {
            const glm::dvec3& a = mesh_.positions[size_t(t.x)];
            const glm::dvec3 normal =
                glm::cross(mesh_.positions[size_t(t.y)] - a, mesh_.positions[size_t(t.z)] - a);
            for (int i = 0; i < 3; ++i)
                sums[vertexAt(size_t(t[i]))] += normal;
        }
        for (size_t i = 0; i < mesh_.normals.size(); ++i) {
            const glm::dvec3& sum = sums[vertexAt(i)];
            const double length = glm::length(sum);
            if (mesh_.normals[i] == glm::dvec3(0) && length > 0 && std::isfinite(length))
                mesh_.normals[i] = sum / length;
        }
    }

  private:
    struct Copy {
        int next = -1, vertex = 0;
    };

    size_t vertexAt(size_t place) const { return place < vertices_ ? place : size_t(copies_[place].vertex); }

    int copyOf(int vertex) {
        const size_t from = size_t(vertex);
        const int copy = int(mesh_.positions.size());
        if (size_t(copy) >= mostElements)
            throw Error(Location{file_}, "has more than 2^28 vertices, the most that is read");
        copies_.push_back({copies_[from].next, vertex});
        copies_[from].next = copy;
        mesh_.positions.push_back(glm::dvec3(mesh_.positions[from]));
        mesh_.normals.push_back(glm::dvec3(mesh_.normals[from]));
        if (!mesh_.colors.empty()) mesh_.colors.push_back(glm::dvec3(mesh_.colors[from]));
        if (!mesh_.uvs.empty()) mesh_.uvs.push_back(glm::dvec2(mesh_.uvs[from]));
        return copy;
    }

    Mesh& mesh_;
    bool uvs_, colors_;
    const std::string& file_;
    size_t vertices_;
    std::vector<char> used_;    // by vertex
    std::vector<Copy> copies_;  // by place
};

}  // namespace

void Polygons::close(size_t count, int look, const std::string& file) {
    if (corners.size() > mostElements)
        throw Error(Location{file}, "has more than 2^28 corners, the most that is read");
    polygons.push_back({corners.size() - count, count, look});
}

void Polygons::tellFlat(Mesh& mesh) const {
    if (flat == 0) return;
    mesh.notes.push_back(concat(many(flat, "face has", "faces have"), " fewer than three corners and ",
                                flat == 1 ? "is" : "are", " left out"));
}

std::vector<int> Polygons::addTo(Mesh& mesh, const std::string& file) {
    Copies copies(mesh, !cornerUvs.empty(), !cornerColors.empty(), file);
    if (copies.any()) {
        cornerUvs.resize(corners.size(), glm::dvec2(0));
        cornerColors.resize(corners.size(), glm::dvec3(1));
    }
    std::stable_sort(polygons.begin(), polygons.end(),
                     [](const Polygon& a, const Polygon& b) { return a.look < b.look; });
    std::vector<int> looks;
    std::vector<glm::dvec3> places;
    for (const Polygon& polygon : polygons) {
        if (looks.empty() || looks.back() != polygon.look) {
            mesh.parts.push_back({"", "", int(mesh.triangles.size()), 0, -1});
            looks.push_back(polygon.look);
        }
        places.clear();
        for (size_t i = 0; i < polygon.count; ++i)
            places.push_back(mesh.positions[size_t(corners[polygon.first + i])]);
        for (glm::ivec3 triangle : cutPolygon(places)) {
            for (int i = 0; i < 3; ++i) {
                const size_t corner = polygon.first + size_t(triangle[i]);
                triangle[i] = copies.any()
                                  ? copies.placeOf(corners[corner], cornerUvs[corner], cornerColors[corner])
                                  : corners[corner];
            }
            mesh.triangles.push_back(triangle);
        }
        mesh.parts.back().triangleCount = int(mesh.triangles.size()) - mesh.parts.back().firstTriangle;
    }
    copies.smoothSeams();
    return looks;
}

}  // namespace shoal
