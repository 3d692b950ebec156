// A bounding volume hierarchy over the triangles, built by median split along the widest axis of the
// centroids. Nodes lie in one array: a node's first child follows it, the second is named by `second`.
#include "geometry/thickness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

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

    // Distance from `from` along the unit `direction` to the first triangle further than `least`;
    // infinite when there is none or when the ray meets its front, so that it started outside.
    double exit(const glm::dvec3& from, const glm::dvec3& direction, double least) const {
        if (nodes_.empty()) return infinity;
        glm::dvec3 inverse;  // finite, so that no face that the ray runs along turns 0 * infinity into NaN
        for (int i = 0; i < 3; ++i)
            inverse[i] = direction[i] != 0 ? 1 / direction[i] : 1e300;
        Hit hit;
        struct Entry {
            size_t node;
            double distance;
        };
        std::array<Entry, 64> stack;
        size_t depth = 0;
        stack[depth++] = {0, enter(nodes_[0], from, inverse)};
        while (depth > 0) {
            const Entry entry = stack[--depth];
            if (entry.distance >= hit.distance) continue;
            const Node& node = nodes_[entry.node];
            if (node.count > 0) {
                for (size_t i = node.first; i < node.first + node.count; ++i)
                    meet(faces_[i], from, direction, least, hit);
                continue;
            }
            Entry close{entry.node + 1, enter(nodes_[entry.node + 1], from, inverse)};
            Entry far{node.second, enter(nodes_[node.second], from, inverse)};
            if (far.distance < close.distance) std::swap(close, far);
            if (far.distance < hit.distance) stack[depth++] = far;
            if (close.distance < hit.distance) stack[depth++] = close;
        }
        return hit.leaving ? hit.distance : infinity;
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
    struct Hit {
        double distance = infinity;
        bool leaving = false;
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

    // Moeller and Trumbore's test.
    static void meet(const Face& f, const glm::dvec3& from, const glm::dvec3& direction, double least,
                     Hit& hit) {
        const glm::dvec3 p = glm::cross(direction, f.ac);
        const double determinant = glm::dot(f.ab, p);  // below 0 when the ray leaves through the back
        if (determinant == 0) return;
        const glm::dvec3 t = from - f.a;
        const double u = glm::dot(t, p) / determinant;
        if (!(u >= -1e-9 && u <= 1 + 1e-9)) return;
        const glm::dvec3 q = glm::cross(t, f.ab);
        const double v = glm::dot(direction, q) / determinant;
        if (!(v >= -1e-9 && u + v <= 1 + 1e-9)) return;
        const double distance = glm::dot(f.ac, q) / determinant;
        if (distance > least && distance < hit.distance) hit = {distance, determinant < 0};
    }

    const Mesh& mesh_;
    std::vector<int> order_;
    std::vector<glm::dvec3> centers_;
    std::vector<Node> nodes_;
    std::vector<Face> faces_;  // in `order_`
};

}  // namespace

std::vector<double> localThickness(const Mesh& mesh, const std::vector<char>& wanted) {
    const TriangleTree tree(mesh);
    // A vertex lies on its own triangles: hits closer than this are those.
    const double least = 1e-6 * glm::distance(mesh.low, mesh.high);

    // In a frame with z inward: the middle, three at 15 degrees, four at 30.
    std::array<glm::dvec3, 8> fan = {glm::dvec3(0, 0, 1)};
    for (size_t i = 1; i < fan.size(); ++i) {
        const double angle = (i < 4 ? 15 : 30) * std::numbers::pi / 180;
        const double round = 2 * std::numbers::pi * (i < 4 ? double(i) / 3 + 0.05 : double(i) / 4);
        fan[i] = {std::sin(angle) * std::cos(round), std::sin(angle) * std::sin(round), std::cos(angle)};
    }

    std::vector<double> thickness(mesh.weldedPositions.size(), infinity);
    for (size_t v = 0; v < thickness.size(); ++v) {
        if (!wanted.empty() && !wanted[v]) continue;
        const glm::dvec3 inward = -mesh.weldedNormals[v];
        const glm::dvec3 other = std::abs(inward.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
        const glm::dvec3 s = glm::normalize(glm::cross(inward, other)), t = glm::cross(inward, s);
        std::array<double, fan.size()> lengths;
        for (size_t i = 0; i < fan.size(); ++i)
            lengths[i] =
                tree.exit(mesh.weldedPositions[v], fan[i].x * s + fan[i].y * t + fan[i].z * inward, least);
        const double middle = lengths[0];
        std::sort(lengths.begin(), lengths.end());
        const auto found = std::lower_bound(lengths.begin(), lengths.end(), infinity) - lengths.begin();
        if (found > 0) thickness[v] = std::min(middle, lengths[size_t(found - 1) / 2]);
    }
    return thickness;
}

}  // namespace shoal
