#include "author/springs.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Dense>

#include "molecule/linearised.h"

namespace shoal {

namespace {

constexpr double folded = 0.94;  // cosine between normals: flatter than 20 degrees is one plane
constexpr double inBody = 0.85;  // share of a brace that must lie inside

glm::dvec3 areaVector(const CoarseMesh& mesh, const glm::ivec3& t) {
    const glm::dvec3& a = mesh.positions[size_t(t.x)];
    return glm::cross(mesh.positions[size_t(t.y)] - a, mesh.positions[size_t(t.z)] - a);
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

// ---- Finding what is soft, and what would hold it
//
// With K the mass-scaled stiffness of molecule/linearised.h, soft motions are its eigenvectors of eigenvalues
// near zero, less the rigid motions. A spring between a and b with direction n adds k (n . (u_a - u_b))^2 to
// the energy of a motion u. The pair is chosen that adds most for its length.

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double soft = 1e-6;    // eigenvalue by the largest
constexpr double noHelp = 1e-7;  // of a pair to a motion of length 1

// Returns the row r of a spring of stiffness 1, which adds (r . u)^2 to u^T K u for the mass-scaled motion u
// and stiffness matrix K.
VectorXd row(const Molecule& m, int a, int b) {
    VectorXd out = VectorXd::Zero(3 * Eigen::Index(m.vertices.size()));
    const Eigen::Vector3d n = direction(m, a, b);
    out.segment<3>(3 * a) = inverseRootMass(m, a) * n;
    out.segment<3>(3 * b) = -inverseRootMass(m, b) * n;
    return out;
}

// Motions that nothing resists, orthonormal; none is rigid.
MatrixXd softMotions(const Molecule& m) {
    const Freedom all(m, false);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(assemble(m, all, &WeightedSpring::stiffness));
    const VectorXd& values = solver.eigenvalues();
    Eigen::Index count = 0;
    while (count < values.size() && values(count) <= soft * values(values.size() - 1))
        ++count;
    if (count == 0) return MatrixXd(values.size(), 0);
    const MatrixXd rigid = rigidMotions(m, all);
    MatrixXd found = solver.eigenvectors().leftCols(count);
    found -= rigid * (rigid.transpose() * found);
    return basisOf(found, 0.1);
}

// Removes from orthonormal motions their combination with the coefficients `held`, which is resisted: a
// Householder reflection of the coefficients takes it to the first column, which is dropped.
MatrixXd without(const MatrixXd& motions, VectorXd held) {
    held(0) += held(0) < 0 ? -held.norm() : held.norm();
    const VectorXd v = held.normalized();
    const MatrixXd turned = motions - 2 * (motions * v) * v.transpose();
    return turned.rightCols(turned.cols() - 1);
}

// The pair that resists a motion most for its length; {-1, -1} when none does.
class Finder {
  public:
    Finder(const Molecule& m, const Inside* inside) : m_(m), inside_(inside) {
        for (const Spring& spring : m.springs)
            sprung_.insert(std::minmax({spring.a, spring.b}));
    }

    Pair find(const VectorXd& motion) const {
        const int count = int(m_.vertices.size());
        double best = 0;
        Pair pair{-1, -1};
        for (int a = 0; a < count; ++a)
            for (int b = a + 1; b < count; ++b) {
                if (sprung_.contains({a, b})) continue;
                const Eigen::Vector3d n = direction(m_, a, b);
                const double ra = inverseRootMass(m_, a), rb = inverseRootMass(m_, b);
                const double work = n.dot(ra * motion.segment<3>(3 * a) - rb * motion.segment<3>(3 * b));
                if (std::abs(work) < noHelp * (ra + rb)) continue;
                const glm::dvec3 &p = m_.vertices[size_t(a)].position, &q = m_.vertices[size_t(b)].position;
                double score = work * work / glm::distance(p, q);
                if (inside_ && inside_->share(p, q) < 0.6) score *= 0.3;
                if (score > best) best = score, pair = {a, b};
            }
        return pair;
    }
    void take(const Pair& pair) { sprung_.insert(pair); }

  private:
    const Molecule& m_;
    const Inside* inside_;
    std::set<Pair> sprung_;
};

// The softest motion that is not rigid, and its eigenvalue by the largest.
struct Softest {
    VectorXd motion;
    double value = 1;
};

Softest softest(const Molecule& m) {
    const Freedom all(m, false);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(assemble(m, all, &WeightedSpring::stiffness));
    const VectorXd& values = solver.eigenvalues();
    const double most = values(values.size() - 1);
    for (Eigen::Index i = 0; i < values.size(); ++i)
        if (values(i) > soft * most) return {solver.eigenvectors().col(i), values(i) / most};
    return {};
}

}  // namespace

Bracing brace(Molecule m, const Inside* inside, bool hardly) {
    Bracing out;
    if (m.vertices.size() < 2 || m.vertices.size() > mostDense) return out;
    double strength = 0;  // as other springs have it on the average
    for (const Spring& spring : m.springs)
        strength += spring.stiffness / double(m.springs.size());
    if (strength == 0) strength = 1;
    Finder finder(m, inside);
    const auto add = [&](const Pair& pair) {
        finder.take(pair);
        out.added.push_back(pair);
        m.springs.push_back({pair.first, pair.second, strength, 0, {}, {}});
    };
    for (int round = 0; round < 64; ++round) {
        MatrixXd motions = softMotions(m);
        bool helped = false;
        while (motions.cols() > 0) {
            const Pair pair = finder.find(motions.col(0));
            if (pair.first < 0) {
                motions = MatrixXd(motions.rightCols(motions.cols() - 1));
                continue;
            }
            helped = true;
            add(pair);
            motions = without(motions, motions.transpose() * row(m, pair.first, pair.second));
        }
        if (!helped) break;
    }
    out.left = int(softMotions(m).cols());

    // what is held, but hardly: as long as it helps
    constexpr double wanted = 2e-4, gain = 1.2;
    constexpr size_t mostVertices = 100, most = 24;
    if (!hardly || out.left > 0 || m.vertices.size() > mostVertices) return out;
    Softest current = softest(m);
    for (size_t i = 0; i < std::min(most, m.vertices.size() / 2) && current.value < wanted; ++i) {
        const Pair pair = finder.find(current.motion);
        if (pair.first < 0) break;
        add(pair);
        const Softest next = softest(m);
        if (next.value < gain * current.value) {
            out.added.pop_back();
            break;
        }
        current = next;
    }
    return out;
}

}  // namespace shoal
