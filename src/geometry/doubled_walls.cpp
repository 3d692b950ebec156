#include "geometry/doubled_walls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "geometry/closest_point.h"
#include "geometry/opposite_walls.h"

namespace shoal {

namespace {

struct Piece {
    std::vector<size_t> triangles;
    std::vector<int> vertices;  // welded, each once
    glm::dvec3 low{0}, high{0};
    double area = 0, volume = 0;  // m^2, m^3; the volume is negative where it faces inwards
    bool closed = true;
};

class Pieces {
  public:
    explicit Pieces(const Mesh& mesh) : mesh_(mesh), doubled_(coincidentTriangles(mesh)) { gather(); }

    // Larger ones first, so that of two that lie on one another the larger stays.
    std::vector<char> run() {
        std::vector<size_t> order(pieces_.size());
        std::iota(order.begin(), order.end(), size_t(0));
        std::stable_sort(order.begin(), order.end(),
                         [&](size_t a, size_t b) { return pieces_[a].area > pieces_[b].area; });
        std::vector<char> gone(pieces_.size(), 0);
        for (size_t i = 0; i < order.size(); ++i) {
            if (gone[order[i]]) continue;
            const Piece& outer = pieces_[order[i]];
            const double near = 0.003 * glm::distance(outer.low, outer.high);
            std::unique_ptr<Mesh> alone;
            std::unique_ptr<ClosestPoints> surface;
            for (size_t k = i + 1; k < order.size(); ++k) {
                const Piece& inner = pieces_[order[k]];
                if (gone[order[k]] || !within(inner, outer, near)) continue;
                if (outer.closed) {
                    const bool hollow = inner.closed && inner.volume * outer.volume < 0;
                    if (hollow || !encloses(outer, inner)) continue;
                } else {
                    if (inner.closed) continue;
                    if (!surface) {
                        alone = std::make_unique<Mesh>(meshOf(outer));
                        surface = std::make_unique<ClosestPoints>(*alone);
                    }
                    if (!liesOn(*surface, inner, near)) continue;
                }
                gone[order[k]] = 1;
                for (const size_t t : inner.triangles)
                    doubled_[t] = 1;
            }
        }
        return std::move(doubled_);
    }

  private:
    glm::ivec3 welded(size_t triangle) const {
        const glm::ivec3& t = mesh_.triangles[triangle];
        return {mesh_.weld[size_t(t.x)], mesh_.weld[size_t(t.y)], mesh_.weld[size_t(t.z)]};
    }
    const glm::dvec3& place(int vertex) const { return mesh_.weldedPositions[size_t(vertex)]; }

    void gather() {
        std::vector<int> root(mesh_.weldedPositions.size());
        std::iota(root.begin(), root.end(), 0);
        const auto find = [&](int v) {
            while (root[size_t(v)] != v)
                v = root[size_t(v)] = root[size_t(root[size_t(v)])];
            return v;
        };
        std::map<std::pair<int, int>, int> sides;  // of an edge, those one way less those the other way
        for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
            if (doubled_[i]) continue;
            const glm::ivec3 t = welded(i);
            root[size_t(find(t.x))] = find(t.y);
            root[size_t(find(t.y))] = find(t.z);
            for (int k = 0; k < 3; ++k) {
                const int a = t[k], b = t[(k + 1) % 3];
                sides[std::minmax({a, b})] += a < b ? 1 : -1;
            }
        }
        std::map<int, size_t> numbers;
        for (size_t i = 0; i < mesh_.triangles.size(); ++i) {
            if (doubled_[i]) continue;
            const glm::ivec3 t = welded(i);
            const auto [number, fresh] = numbers.try_emplace(find(t.x), pieces_.size());
            if (fresh) pieces_.emplace_back();
            Piece& piece = pieces_[number->second];
            if (fresh) piece.low = piece.high = place(t.x);
            piece.triangles.push_back(i);
            const glm::dvec3 &a = place(t.x), &b = place(t.y), &c = place(t.z);
            piece.area += 0.5 * glm::length(glm::cross(b - a, c - a));
            piece.volume += glm::dot(a - mesh_.low, glm::cross(b - mesh_.low, c - mesh_.low)) / 6;
            for (int k = 0; k < 3; ++k) {
                piece.low = glm::min(piece.low, place(t[k]));
                piece.high = glm::max(piece.high, place(t[k]));
                piece.vertices.push_back(t[k]);
                piece.closed = piece.closed && sides[std::minmax({t[k], t[(k + 1) % 3]})] == 0;
            }
        }
        for (Piece& piece : pieces_) {
            std::sort(piece.vertices.begin(), piece.vertices.end());
            piece.vertices.erase(std::unique(piece.vertices.begin(), piece.vertices.end()),
                                 piece.vertices.end());
        }
    }

    static bool within(const Piece& inner, const Piece& outer, double near) {
        return glm::all(glm::greaterThanEqual(inner.low, outer.low - near)) &&
               glm::all(glm::lessThanEqual(inner.high, outer.high + near));
    }

    // At most so many vertices of a piece, from all over it.
    template <typename Holds>
    static bool allOf(const Piece& piece, size_t most, const Holds& holds) {
        const size_t count = piece.vertices.size(), step = std::max<size_t>(1, count / most);
        for (size_t i = 0; i < count; i += step)
            if (!holds(piece.vertices[i])) return false;
        return true;
    }

    // Whether the winding number about a piece's vertices is not 0, by solid angles [van Oosterom 1983].
    bool encloses(const Piece& outer, const Piece& inner) const {
        return allOf(inner, 24, [&](int vertex) {
            double angle = 0;
            for (const size_t triangle : outer.triangles) {
                const glm::ivec3 t = welded(triangle);
                const glm::dvec3 a = place(t.x) - place(vertex), b = place(t.y) - place(vertex),
                                 c = place(t.z) - place(vertex);
                const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
                angle += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), la * lb * lc + glm::dot(a, b) * lc +
                                                                           glm::dot(b, c) * la +
                                                                           glm::dot(c, a) * lb);
            }
            return std::abs(angle) > 2 * std::numbers::pi;  // half way from outside to inside
        });
    }

    bool liesOn(const ClosestPoints& surface, const Piece& inner, double near) const {
        return allOf(inner, 400, [&](int vertex) { return surface.find(place(vertex), near).triangle >= 0; });
    }

    Mesh meshOf(const Piece& piece) const {
        Mesh out;
        out.positions = mesh_.weldedPositions;
        for (const size_t triangle : piece.triangles)
            out.triangles.push_back(welded(triangle));
        completeMesh(out);
        return out;
    }

    const Mesh& mesh_;
    std::vector<char> doubled_;
    std::vector<Piece> pieces_;
};

}  // namespace

std::vector<char> doubledWalls(const Mesh& mesh) {
    return Pieces(mesh).run();
}

}  // namespace shoal
