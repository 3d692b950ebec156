#include "molecule/statics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "molecule/analysis.h"
#include "molecule/linearised.h"

namespace shoal {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The mass-scaled stiffness A with its Cholesky factor. Rigid motions are made stiff and taken out again.
class Scaled {
  public:
    Scaled(const Molecule& molecule, bool pinned) : molecule_(molecule), freedom_(molecule, pinned) {
        if (molecule.vertices.size() > mostDense)
            throw Error("a molecule of more than ", mostDense, " vertices is not loaded");
        if (freedom_.count == 0) throw Error("no vertex of the molecule moves");
        stiffness_ = assemble(molecule, freedom_, &WeightedSpring::stiffness);
        rigid_ = rigidMotions(molecule, freedom_);
        factor_.compute(stiffness_ + stiffness_.diagonal().maxCoeff() * rigid_ * rigid_.transpose());
        constexpr double least = 1e-12;  // of a pivot, by the largest
        const VectorXd pivots = factor_.matrixLLT().diagonal();
        if (factor_.info() != Eigen::Success || pivots.minCoeff() < std::sqrt(least) * pivots.maxCoeff())
            throw Error("nothing resists some motion of the molecule");
    }

    const Freedom& freedom() const { return freedom_; }
    const MatrixXd& stiffness() const { return stiffness_; }
    const Eigen::LLT<MatrixXd>& factor() const { return factor_; }
    MatrixXd solve(const MatrixXd& loads) const { return without(factor_.solve(without(loads))); }
    MatrixXd without(const MatrixXd& vectors) const {
        return vectors - rigid_ * (rigid_.transpose() * vectors);
    }

    // Of vectors of the vertices, times a power of the root of the mass: -1 of loads, 1 of motions.
    VectorXd scaled(const VertexVectors& vectors, int power) const {
        VectorXd out(3 * freedom_.count);
        for (size_t i = 0; i < vectors.size(); ++i)
            if (freedom_.index[i] >= 0)
                out.segment<3>(3 * freedom_.index[i]) =
                    toEigen(vectors[i]) * std::pow(inverseRootMass(molecule_, int(i)), -power);
        return out;
    }
    VertexVectors motion(const VectorXd& vector) const {
        VertexVectors out(molecule_.vertices.size(), glm::dvec3(0));
        for (size_t i = 0; i < out.size(); ++i) {
            if (freedom_.index[i] < 0) continue;
            const Eigen::Vector3d u =
                vector.segment<3>(3 * freedom_.index[i]) * inverseRootMass(molecule_, int(i));
            out[i] = {u.x(), u.y(), u.z()};
        }
        return out;
    }

  private:
    const Molecule& molecule_;
    Freedom freedom_;
    MatrixXd stiffness_, rigid_;
    Eigen::LLT<MatrixXd> factor_;
};

// S of the tensions that `motion` makes, scaled by the masses.
MatrixXd stiffnessOfTension(const Molecule& molecule, const Freedom& freedom, const VertexVectors& motion) {
    MatrixXd out = MatrixXd::Zero(3 * freedom.count, 3 * freedom.count);
    for (const Spring& spring : molecule.springs) {
        const Eigen::Vector3d n = direction(molecule, spring.a, spring.b);
        const double length = glm::distance(molecule.vertices[size_t(spring.a)].position,
                                            molecule.vertices[size_t(spring.b)].position);
        const double tension =
            spring.stiffness * n.dot(toEigen(motion[size_t(spring.a)] - motion[size_t(spring.b)]));
        const Eigen::Matrix3d block = tension / length * (Eigen::Matrix3d::Identity() - n * n.transpose());
        const int a = freedom.index[size_t(spring.a)], b = freedom.index[size_t(spring.b)];
        const double ra = inverseRootMass(molecule, spring.a), rb = inverseRootMass(molecule, spring.b);
        if (a >= 0) out.block<3, 3>(3 * a, 3 * a) += ra * ra * block;
        if (b >= 0) out.block<3, 3>(3 * b, 3 * b) += rb * rb * block;
        if (a < 0 || b < 0) continue;
        out.block<3, 3>(3 * a, 3 * b) -= ra * rb * block;
        out.block<3, 3>(3 * b, 3 * a) -= ra * rb * block;
    }
    return out;
}

}  // namespace

VertexVectors displacements(const Molecule& molecule, bool pinned, const VertexVectors& loads) {
    const Scaled scaled(molecule, pinned);
    return scaled.motion(scaled.solve(scaled.scaled(loads, -1)));
}

std::vector<double> frequenciesLike(const Molecule& molecule, bool pinned,
                                    const std::vector<VertexVectors>& shapes) {
    const std::vector<Mode> modes = modesOf(molecule, pinned, 3 * molecule.vertices.size());
    const auto product = [&](const VertexVectors& a, const VertexVectors& b) {
        double sum = 0;
        for (size_t i = 0; i < a.size(); ++i)
            sum += molecule.vertices[i].mass * glm::dot(a[i], b[i]);
        return sum;
    };
    std::vector<double> out;
    for (const VertexVectors& shape : shapes) {
        std::vector<double> shares;
        for (const Mode& mode : modes)
            shares.push_back(std::pow(product(mode.shape, shape), 2) / product(mode.shape, mode.shape));
        const double most = shares.empty() ? 0 : *std::max_element(shares.begin(), shares.end());
        const auto first =
            std::find_if(shares.begin(), shares.end(), [&](double share) { return share >= 0.5 * most; });
        out.push_back(shares.empty() ? 0 : modes[size_t(first - shares.begin())].frequency);
    }
    return out;
}

double bucklingFactor(const Molecule& molecule, const VertexVectors& loads) {
    const Scaled scaled(molecule, true);
    const VertexVectors motion = scaled.motion(scaled.solve(scaled.scaled(loads, -1)));
    const MatrixXd tension = stiffnessOfTension(molecule, scaled.freedom(), motion);
    // K v = -factor S v; with K = L L^T, 1 / factor are the eigenvalues of -L^-1 S L^-T.
    const auto lower = scaled.factor().matrixL();
    const MatrixXd half = lower.solve(tension);
    const MatrixXd inner = lower.solve(half.transpose());
    const VectorXd values =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(-inner, Eigen::EigenvaluesOnly).eigenvalues();
    const double most = values(values.size() - 1);
    return most > 0 ? 1 / most : std::numeric_limits<double>::infinity();
}

}  // namespace shoal
