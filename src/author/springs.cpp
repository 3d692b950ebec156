#include "author/springs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace shoal {

namespace {

constexpr double folded = 0.94;  // cosine between normals: flatter than 20 degrees is one plane
constexpr double inBody = 0.85;  // share of a brace that must lie inside

glm::dvec3 areaVector(const CoarseMesh& mesh, const glm::ivec3& t) {
    const glm::dvec3& a = mesh.positions[size_t(t.x)];
    return glm::cross(mesh.positions[size_t(t.y)] - a, mesh.positions[size_t(t.z)] - a);
}

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

void addAcross(const CoarseMesh& mesh, SpringPairs& out) {
    std::map<Pair, std::vector<std::pair<size_t, int>>>
        edges;  // triangle, and the corner that faces the edge
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::ivec3& corners = mesh.triangles[t];
        for (int i = 0; i < 3; ++i)
            edges[std::minmax({corners[i], corners[(i + 1) % 3]})].emplace_back(t, corners[(i + 2) % 3]);
    }
    for (const auto& [ends, sides] : edges) {
        if (sides.size() != 2) continue;
        const double cosine = glm::dot(unit(areaVector(mesh, mesh.triangles[sides[0].first])),
                                       unit(areaVector(mesh, mesh.triangles[sides[1].first])));
        out.add(cosine > folded ? out.shears : out.bends, sides[0].second, sides[1].second);
    }
}

// Each vertex to the one that lies most straight through the body.
void addThrough(const CoarseMesh& mesh, const Inside& inside, SpringPairs& out) {
    std::vector<glm::dvec3> normals(mesh.positions.size(), glm::dvec3(0));
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            normals[size_t(t[i])] += areaVector(mesh, t);
    const int count = int(mesh.positions.size());
    for (int a = 0; a < count; ++a) {
        const glm::dvec3 n = unit(normals[size_t(a)]);
        double best = 0;
        int far = -1;
        for (int b = 0; b < count; ++b) {
            const glm::dvec3 d = mesh.positions[size_t(b)] - mesh.positions[size_t(a)];
            const double length = glm::length(d);
            // straight and short
            const double through = length > 0 ? -glm::dot(n, d) / length : 0;
            const double score = through > 0.4 ? through * through * through / length : 0;
            if (score <= best) continue;
            if (inside.share(mesh.positions[size_t(a)], mesh.positions[size_t(b)]) < inBody) continue;
            best = score, far = b;
        }
        if (far >= 0) out.add(out.braces, a, far);
    }
}

}  // namespace

void SpringPairs::add(std::vector<Pair>& kind, int a, int b) {
    if (a == b) return;
    const Pair pair = std::minmax({a, b});
    if (all.insert(pair).second) kind.push_back(pair);
}

SpringPairs springsOf(const CoarseMesh& coarse, const Inside* inside) {
    SpringPairs out;
    for (const glm::ivec3& t : coarse.triangles)
        for (int i = 0; i < 3; ++i)
            out.add(out.edges, t[i], t[(i + 1) % 3]);
    addAcross(coarse, out);
    if (inside) addThrough(coarse, *inside, out);
    return out;
}

SpringPairs springsOfRings(int rings) {
    SpringPairs out;
    for (int here = 0; here < 4 * rings; ++here) {
        const int beside = here % 4 == 3 ? here - 3 : here + 1;
        out.add(out.edges, here, beside);
        if (here % 4 < 2) out.add(out.braces, here, here + 2);
        if (here + 4 >= 4 * rings) continue;
        out.add(out.edges, here, here + 4);
        out.add(out.shears, here, beside + 4);
        out.add(out.shears, beside, here + 4);
    }
    return out;
}

}  // namespace shoal
