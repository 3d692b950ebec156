// A bounding volume hierarchy over the triangles, built by median split along the widest axis of the
// centroids. Nodes lie in one array: a node's first child follows it, the second is named by `second`.
#include "scene/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace shoal {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class TriangleTree {
  public:
    explicit TriangleTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        centers_.reserve(order_.size());
        for (const glm::ivec3& t : mesh.triangles)
            centers_.push_back((at(t.x) + at(t.y) + at(t.z)) / 3.0);
        nodes_.reserve(order_.size());
        if (!order_.empty()) build(0, order_.size());
        for (const int t : order_)
            faces_.push_back(face(mesh.triangles[size_t(t)]));
    }

    // Distance from `from` along the unit `direction` to the first triangle left through its back.
    double exit(const glm::dvec3& from, const glm::dvec3& direction, double least) const {
        if (nodes_.empty()) return infinity;
        glm::dvec3 inverse;  // finite, so that no face that the ray runs along turns 0 * infinity into NaN
        for (int i = 0; i < 3; ++i)
            inverse[i] = direction[i] != 0 ? 1 / direction[i] : 1e300;
        double nearest = infinity;
        std::array<size_t, 64> stack;
        size_t depth = 0;
        stack[depth++] = 0;
        while (depth > 0) {
            const Node& node = nodes_[stack[--depth]];
            if (enter(node, from, inverse) >= nearest) continue;
            if (node.count > 0) {
                for (size_t i = node.first; i < node.first + node.count; ++i)
                    nearest = std::min(nearest, leave(faces_[i], from, direction, least));
                continue;
            }
            const size_t first = static_cast<size_t>(&node - nodes_.data()) + 1, second = node.second;
            const bool nearFirst = enter(nodes_[first], from, inverse) < enter(nodes_[second], from, inverse);
            stack[depth++] = nearFirst ? second : first;
            stack[depth++] = nearFirst ? first : second;
        }
        return nearest;
    }

  private:
    struct Node {
        glm::dvec3 low{infinity}, high{-infinity};
        size_t first = 0, count = 0;  // of a leaf's triangles; an inner node counts 0
        size_t second = 0;
    };
    struct Face {
        glm::dvec3 a, ab, ac;
    };

    const glm::dvec3& at(int vertex) const { return mesh_.positions[size_t(vertex)]; }
    Face face(const glm::ivec3& t) const { return {at(t.x), at(t.y) - at(t.x), at(t.z) - at(t.x)}; }

    // Halving keeps the depth at log2 of the count, far below the stack of exit().
    void build(size_t begin, size_t end) {
        const size_t index = nodes_.size();
        nodes_.emplace_back();
        Node node;
        glm::dvec3 low(infinity), high(-infinity);
        for (size_t i = begin; i < end; ++i) {
            const glm::ivec3& t = mesh_.triangles[size_t(order_[i])];
            for (int corner = 0; corner < 3; ++corner) {
                node.low = glm::min(node.low, at(t[corner]));
                node.high = glm::max(node.high, at(t[corner]));
            }
            low = glm::min(low, centers_[size_t(order_[i])]);
            high = glm::max(high, centers_[size_t(order_[i])]);
        }
        if (end - begin <= 4) {
            node.first = begin;
            node.count = end - begin;
        } else {
            const glm::dvec3 size = high - low;
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
            const size_t middle = begin + (end - begin) / 2;
            const auto first = order_.begin();
            std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                             first + static_cast<std::ptrdiff_t>(middle),
                             first + static_cast<std::ptrdiff_t>(end), [&](int a, int b) {
                                 const double ca = centers_[size_t(a)][axis], cb = centers_[size_t(b)][axis];
                                 return ca != cb ? ca < cb : a < b;
                             });
            build(begin, middle);
            node.second = nodes_.size();
            build(middle, end);
        }
        nodes_[index] = node;
    }

    // Where the ray enters the node's box, infinity when it misses.
    static double enter(const Node& node, const glm::dvec3& from, const glm::dvec3& inverse) {
        double enterAt = 0, leaveAt = infinity;
        for (int i = 0; i < 3; ++i) {
            const double a = (node.low[i] - from[i]) * inverse[i], b = (node.high[i] - from[i]) * inverse[i];
            enterAt = std::max(enterAt, std::min(a, b));
            leaveAt = std::min(leaveAt, std::max(a, b));
        }
        return enterAt <= leaveAt * (1 + 1e-12) ? enterAt : infinity;
    }

    // Moeller and Trumbore's test, for triangles seen from behind only.
    static double leave(const Face& f, const glm::dvec3& from, const glm::dvec3& direction, double least) {
        const glm::dvec3 p = glm::cross(direction, f.ac);
        const double determinant = glm::dot(f.ab, p);
        if (determinant >= 0) return infinity;  // entering, or along the triangle
        const glm::dvec3 t = from - f.a;
        const double u = glm::dot(t, p) / determinant;
        if (!(u >= -1e-9 && u <= 1 + 1e-9)) return infinity;
        const glm::dvec3 q = glm::cross(t, f.ab);
        const double v = glm::dot(direction, q) / determinant;
        if (!(v >= -1e-9 && u + v <= 1 + 1e-9)) return infinity;
        const double distance = glm::dot(f.ac, q) / determinant;
        return distance > least ? distance : infinity;
    }

    const Mesh& mesh_;
    std::vector<int> order_;
    std::vector<glm::dvec3> centers_;
    std::vector<Node> nodes_;
    std::vector<Face> faces_;  // in `order_`
};

}  // namespace

std::vector<double> localThickness(const Mesh& mesh) {
    const TriangleTree tree(mesh);
    // A vertex lies on its own triangles: hits closer than this are those.
    const double least = 1e-6 * glm::distance(mesh.low, mesh.high);
    const double cosine = std::cos(0.5235987755982988), sine = 0.5;

    std::vector<double> thickness(mesh.weldedPositions.size(), infinity);
    for (size_t v = 0; v < thickness.size(); ++v) {
        const glm::dvec3 inward = -mesh.weldedNormals[v];
        const glm::dvec3 other = std::abs(inward.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        const glm::dvec3 s = glm::normalize(glm::cross(inward, other)), t = glm::cross(inward, s);
        const glm::dvec3& from = mesh.weldedPositions[v];
        std::array<double, 5> lengths = {tree.exit(from, inward, least),
                                         tree.exit(from, cosine * inward + sine * s, least),
                                         tree.exit(from, cosine * inward - sine * s, least),
                                         tree.exit(from, cosine * inward + sine * t, least),
                                         tree.exit(from, cosine * inward - sine * t, least)};
        const double middle = lengths[0];
        std::nth_element(lengths.begin(), lengths.begin() + 2, lengths.end());
        thickness[v] = std::min(middle, lengths[2]);
    }
    return thickness;
}

}  // namespace shoal
