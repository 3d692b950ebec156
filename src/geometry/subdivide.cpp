#include "geometry/subdivide.h"

#include <algorithm>
#include <map>
#include <utility>

namespace shoal {

namespace {

using Edge = std::pair<int, int>;  // of welded vertices, the lower first

class Subdivision {
  public:
    explicit Subdivision(Mesh& mesh) : mesh_(mesh) {
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            triangles_.push_back(mesh.triangles[t]);
            sources_.push_back(t);
            changes_.push_back(0);
            addEdges(t);
        }
    }

    bool mayGoOn(size_t mostTriangles) const {
        return !edges_.empty() && triangles_.size() + longest()->second.count <= mostTriangles;
    }
    void halveLongest() {
        const auto entry = longest();
        const Edge edge = entry->first;
        std::vector<size_t> sides;
        for (const Side& side : entry->second.sides)
            if (side.change == changes_[side.triangle]) sides.push_back(side.triangle);
        halves_.clear();
        welded_ = int(mesh_.weldedPositions.size());
        mesh_.weldedPositions.push_back(
            0.5 * (mesh_.weldedPositions[size_t(edge.first)] + mesh_.weldedPositions[size_t(edge.second)]));
        for (const size_t t : sides)
            halve(t, edge);
    }

    // The triangles in the order of those that they came from.
    void finish() {
        std::vector<size_t> order(triangles_.size());
        for (size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return sources_[a] < sources_[b]; });
        std::vector<int> before(mesh_.triangles.size() + 1, 0);  // triangles that came from earlier ones
        for (const size_t source : sources_)
            ++before[source + 1];
        for (size_t t = 0; t < mesh_.triangles.size(); ++t)
            before[t + 1] += before[t];
        const auto renumber = [&](auto& piece) {
            const int end = before[size_t(piece.firstTriangle + piece.triangleCount)];
            piece.firstTriangle = before[size_t(piece.firstTriangle)];
            piece.triangleCount = end - piece.firstTriangle;
        };
        std::for_each(mesh_.objects.begin(), mesh_.objects.end(), renumber);
        std::for_each(mesh_.parts.begin(), mesh_.parts.end(), renumber);
        mesh_.triangles.clear();
        for (const size_t t : order)
            mesh_.triangles.push_back(triangles_[t]);
    }

  private:
    // A triangle that has an edge, unless it has changed since.
    struct Side {
        size_t triangle;
        int change;
    };
    // What has changed stays in the list, so that a triangle leaves an edge of many in no time.
    struct Sides {
        std::vector<Side> sides;
        size_t count = 0;  // of those that have not
    };
    using Edges = std::map<Edge, Sides>;

    Edges::const_iterator longest() const {
        return std::max_element(edges_.begin(), edges_.end(), [&](const auto& a, const auto& b) {
            return lengthOf(a.first) < lengthOf(b.first);
        });
    }
    int weldOf(int corner) const { return mesh_.weld[size_t(corner)]; }
    double lengthOf(const Edge& edge) const {
        return glm::distance(mesh_.weldedPositions[size_t(edge.first)],
                             mesh_.weldedPositions[size_t(edge.second)]);
    }
    Edge edgeOf(const glm::ivec3& triangle, int side) const {
        return std::minmax({weldOf(triangle[side]), weldOf(triangle[(side + 1) % 3])});
    }
    // A triangle with two corners in one place has no side to halve.
    bool degenerate(size_t t) const {
        const glm::ivec3& corners = triangles_[t];
        const int a = weldOf(corners.x), b = weldOf(corners.y), c = weldOf(corners.z);
        return a == b || b == c || c == a;
    }
    void addEdges(size_t t) {
        for (int side = 0; side < 3 && !degenerate(t); ++side) {
            Sides& edge = edges_[edgeOf(triangles_[t], side)];
            edge.sides.push_back({t, changes_[t]});
            ++edge.count;
        }
    }
    void removeEdges(size_t t) {
        for (int side = 0; side < 3; ++side) {
            const auto found = edges_.find(edgeOf(triangles_[t], side));
            if (--found->second.count == 0) edges_.erase(found);
        }
        ++changes_[t];
    }

    // A corner in the middle of two, which are the edge's: each pair of corners has its own.
    int middle(int a, int b) {
        const auto [found, fresh] = halves_.try_emplace(std::minmax(a, b), int(mesh_.positions.size()));
        if (!fresh) return found->second;
        const auto half = [&](auto& values) {
            if (!values.empty()) values.push_back(0.5 * (values[size_t(a)] + values[size_t(b)]));
        };
        half(mesh_.positions);
        half(mesh_.normals);
        half(mesh_.colors);
        half(mesh_.uvs);
        if (!mesh_.bones.empty()) mesh_.bones.push_back(mesh_.bones[size_t(a)]);
        glm::dvec3& normal = mesh_.normals.back();
        normal = glm::length(normal) > 0 ? glm::normalize(normal) : mesh_.normals[size_t(a)];
        mesh_.weld.push_back(welded_);
        return found->second;
    }

    void halve(size_t t, const Edge& edge) {
        removeEdges(t);
        const glm::ivec3 whole = triangles_[t];
        int side = 0;
        while (edgeOf(whole, side) != edge)
            ++side;
        const int a = whole[side], b = whole[(side + 1) % 3], c = whole[(side + 2) % 3], m = middle(a, b);
        triangles_[t] = {a, m, c};
        triangles_.push_back({m, b, c});
        sources_.push_back(sources_[t]);
        changes_.push_back(0);
        addEdges(t);
        addEdges(triangles_.size() - 1);
    }

    Mesh& mesh_;
    std::vector<glm::ivec3> triangles_;
    std::vector<size_t> sources_;  // of each: the triangle that it came from
    std::vector<int> changes_;     // of each: how often it was halved
    Edges edges_;
    std::map<std::pair<int, int>, int> halves_;  // of the edge that is being halved
    int welded_ = 0;                             // its middle
};

}  // namespace

void subdivide(Mesh& mesh, size_t weldedVertices, size_t mostTriangles) {
    if (mesh.triangles.empty() || mesh.weldedPositions.size() >= weldedVertices) return;
    Subdivision subdivision(mesh);
    while (subdivision.mayGoOn(mostTriangles) && mesh.weldedPositions.size() < weldedVertices)
        subdivision.halveLongest();
    subdivision.finish();
    completeMesh(mesh);
}

}  // namespace shoal
