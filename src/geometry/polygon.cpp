#include "geometry/polygon.h"

#include <cmath>
#include <numeric>

namespace shoal {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// The polygon seen along its normal, anticlockwise. Corners lie about the first one, because far from the
// origin products would lose their differences.
std::vector<glm::dvec2> flattened(const std::vector<glm::dvec3>& corners) {
    glm::dvec3 normal(0);
    for (size_t i = 1; i + 1 < corners.size(); ++i)
        normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    const glm::dvec3 size = glm::abs(normal);
    const int along = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const int u = (along + 1) % 3, v = (along + 2) % 3;
    std::vector<glm::dvec2> out;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 way = corner - corners[0];
        out.emplace_back(way[u], normal[along] < 0 ? -way[v] : way[v]);
    }
    return out;
}

class Ears {
  public:
    explicit Ears(const std::vector<glm::dvec3>& corners) : flat_(flattened(corners)) {
        rest_.resize(corners.size());
        std::iota(rest_.begin(), rest_.end(), 0);
        for (size_t i = 0; i < rest_.size(); ++i)
            convex_ = convex_ && turn(i) > 0;
    }

    std::vector<glm::ivec3> cut() {
        std::vector<glm::ivec3> out;
        size_t current = 1;  // the ear that is tried, in rest_
        while (rest_.size() >= 3) {
            size_t ear = current, tried = 0;
            while (tried < rest_.size() && !isEar(ear % rest_.size()))
                ++ear, ++tried;
            ear = tried < rest_.size() ? ear % rest_.size() : current % rest_.size();  // it crosses itself
            out.push_back(triangle(ear));
            rest_.erase(rest_.begin() + std::ptrdiff_t(ear));
            current = ear == 0 ? 1 : ear;
        }
        return out;
    }

  private:
    // With its neighbours, the lowest first.
    glm::ivec3 triangle(size_t ear) const {
        glm::ivec3 t = corner(ear);
        while (t.x > t.y || t.x > t.z)
            t = {t.y, t.z, t.x};
        return t;
    }

    double turn(size_t index) const {
        const glm::ivec3 t = corner(index);
        return cross(place(t.y) - place(t.x), place(t.z) - place(t.y));
    }

    // Whether a corner is convex, and none of the others that are not lies in its triangle.
    bool isEar(size_t index) const {
        if (rest_.size() == 3) return true;
        if (convex_) return true;
        if (!(turn(index) > 0)) return false;
        const glm::ivec3 t = corner(index);
        for (size_t other = 0; other < rest_.size(); ++other) {
            const int i = rest_[other];
            if (i == t.x || i == t.y || i == t.z || turn(other) > 0) continue;
            const glm::dvec2& p = place(i);
            if (p == place(t.x) || p == place(t.y) || p == place(t.z)) continue;
            if (cross(place(t.y) - place(t.x), p - place(t.x)) >= 0 &&
                cross(place(t.z) - place(t.y), p - place(t.y)) >= 0 &&
                cross(place(t.x) - place(t.z), p - place(t.z)) >= 0)
                return false;
        }
        return true;
    }

    glm::ivec3 corner(size_t index) const {
        const size_t count = rest_.size();
        return {rest_[(index + count - 1) % count], rest_[index], rest_[(index + 1) % count]};
    }
    const glm::dvec2& place(int corner) const { return flat_[size_t(corner)]; }

    std::vector<glm::dvec2> flat_;
    bool convex_ = true;     // as cutting leaves it
    std::vector<int> rest_;  // corners that are not cut off yet
};

}  // namespace

std::vector<glm::ivec3> cutPolygon(const std::vector<glm::dvec3>& corners) {
    if (corners.size() < 3) return {};
    if (corners.size() == 3) return {{0, 1, 2}};
    return Ears(corners).cut();
}

}  // namespace shoal
