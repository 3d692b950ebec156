// Finding what is soft, and what would hold it.
//
// With K the mass-scaled stiffness of molecule/linearised.h, soft motions are its eigenvectors of eigenvalues
// near zero, less the rigid motions. A spring between a and b with direction n adds k (n . (u_a - u_b))^2 to
// the energy of a motion u: the pair is taken of which that is largest for its length.
#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "author/springs.h"
#include "molecule/linearised.h"

namespace shoal {

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
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(assemble(m, all, &Spring::stiffness));
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
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(assemble(m, all, &Spring::stiffness));
    const VectorXd& values = solver.eigenvalues();
    const double most = values(values.size() - 1);
    for (Eigen::Index i = 0; i < values.size(); ++i)
        if (values(i) > soft * most) return {solver.eigenvectors().col(i), values(i) / most};
    return {};
}

}  // namespace

Bracing brace(Molecule m, const Inside* inside) {
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
    if (out.left > 0 || m.vertices.size() > mostVertices) return out;
    Softest now = softest(m);
    for (size_t i = 0; i < std::min(most, m.vertices.size() / 2) && now.value < wanted; ++i) {
        const Pair pair = finder.find(now.motion);
        if (pair.first < 0) break;
        add(pair);
        const Softest then = softest(m);
        if (then.value < gain * now.value) {
            out.added.pop_back();
            break;
        }
        now = then;
    }
    return out;
}

}  // namespace shoal
