#include "molecule/gap.h"

#include <algorithm>

namespace shoal {

std::vector<glm::dvec3> restSpheres(const Molecule& molecule, bool triangles) {
    std::vector<glm::dvec3> out;
    for (const Vertex& vertex : molecule.vertices)
        out.push_back(vertex.position);
    for (const Triangle& t : molecule.triangles)
        if (triangles) out.push_back((out[size_t(t.a)] + out[size_t(t.b)] + out[size_t(t.c)]) / 3.0);
    return out;
}

// On a lattice over each triangle: a hole's middle is a Voronoi vertex of the spheres, and a step of 1/64 of
// an edge is within what a radius is known to.
Gap largestGap(const Molecule& molecule, const std::vector<glm::dvec3>& spheres, double radius) {
    Gap out;
    // a shape with many spheres has small triangles
    const int cuts = spheres.size() > 200 ? 8 : 32;
    for (size_t t = 0; t < molecule.triangles.size(); ++t) {
        const Triangle& triangle = molecule.triangles[t];
        const glm::dvec3 &a = spheres[size_t(triangle.a)], &b = spheres[size_t(triangle.b)],
                         &c = spheres[size_t(triangle.c)];
        for (int i = 0; i <= cuts; ++i) {
            for (int k = 0; k + i <= cuts; ++k) {
                const glm::dvec3 p = a + (b - a) * (double(i) / cuts) + (c - a) * (double(k) / cuts);
                // its own corners are mostly the nearest
                double nearest = std::min({glm::distance(p, a), glm::distance(p, b), glm::distance(p, c)});
                for (size_t s = 0; s < spheres.size() && nearest - radius > out.radius; ++s)
                    nearest = std::min(nearest, glm::distance(p, spheres[s]));
                if (nearest - radius > out.radius) out = {nearest - radius, int(t)};
            }
        }
    }
    return out;
}

double closingRadius(const Molecule& molecule, bool triangles) {
    const std::vector<glm::dvec3> spheres = restSpheres(molecule, triangles);
    if (spheres.size() == 1) return molecule.material.pointSize / 2;
    if (!molecule.triangles.empty()) return largestGap(molecule, spheres, 0).radius / 2;
    double out = 0;
    for (size_t a = 0; a < spheres.size(); ++a) {
        double nearest = 1e300;
        for (size_t b = 0; b < spheres.size(); ++b)
            if (b != a) nearest = std::min(nearest, glm::distance(spheres[a], spheres[b]));
        out = std::max(out, nearest / 2);
    }
    return out;
}

}  // namespace shoal
