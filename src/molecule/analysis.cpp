// Eigenvalues of the mass-scaled stiffness A = M^-1/2 K M^-1/2 of the vertices that move, and of damping B
// likewise. Up to 300 vertices densely, beyond by power iteration.
//
// A bend is one of them, between weighted means (WeightedSpring).
//
// Why a bound: n n^T <= I for any direction n, and the transverse stiffness k (1 - L/l) of a stretched spring
// is below k, so K of any deformed shape is at most the weighted graph Laplacian times I. The Laplacian's
// largest eigenvalue therefore bounds the square of every frequency.
//
// Why those step conditions: with u a unit eigenvector, b = h^2 u*Au and a = h u*Bu, one step of
//   euler     gives  (z - 1)^2 + a (z - 1) + b z = 0,                              stable iff b + 2a < 4;
//   leapfrog  gives  z (z - 1)^2 + b z^2 + a z (z - 1) + a/2 (z - 1)^2 = 0,        stable iff b + 4a < 4
// (the Jury criterion). The largest eigenvalue of h^2 A + 2 h B covers every u at once.
#include "molecule/analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "molecule/linearised.h"

namespace shoal {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The largest eigenvalue of the same matrix without building it (power iteration, from above by 2 %, since it
// converges from below), or of the Laplacian that bounds it.
double largestByIteration(const Molecule& molecule, const Freedom& freedom,
                          double WeightedSpring::*coefficient, bool laplacian) {
    struct Link {
        WeightedSpring spring;  // its vertices: their rows, -1: held; its weights: scaled by the masses
        Eigen::Matrix3d block;
    };
    std::vector<Link> links;
    for (WeightedSpring spring : weightedSprings(molecule)) {
        Eigen::Matrix3d block = Eigen::Matrix3d::Identity();
        if (!laplacian) block = resisted(molecule, spring);
        block *= spring.*coefficient;
        for (size_t i = 0; i < size_t(spring.count); ++i) {
            spring.weights[i] *= inverseRootMass(molecule, spring.vertices[i]);
            spring.vertices[i] = freedom.index[size_t(spring.vertices[i])];
        }
        links.push_back({spring, block});
    }
    Eigen::Matrix3Xd x(3, freedom.count);
    for (int i = 0; i < freedom.count; ++i)
        for (int axis = 0; axis < 3; ++axis)
            x(axis, i) = std::sin(1.7 * i + 2.3 * axis + 1);  // no symmetry
    double largest = 0;
    for (int round = 0; round < 300; ++round) {
        x.normalize();
        Eigen::Matrix3Xd y = Eigen::Matrix3Xd::Zero(3, freedom.count);
        for (const auto& [spring, block] : links) {
            Eigen::Vector3d d = Eigen::Vector3d::Zero();
            for (size_t i = 0; i < size_t(spring.count); ++i)
                if (spring.vertices[i] >= 0) d += spring.weights[i] * x.col(spring.vertices[i]);
            d = block * d;
            for (size_t i = 0; i < size_t(spring.count); ++i)
                if (spring.vertices[i] >= 0) y.col(spring.vertices[i]) += spring.weights[i] * d;
        }
        const double before = largest;
        largest = y.norm();
        if (largest == 0 || std::abs(largest - before) < 1e-7 * largest) break;
        x = y;
    }
    return largest * 1.02;
}

MatrixXd scaledLaplacian(const Molecule& molecule, const Freedom& freedom) {
    MatrixXd out = MatrixXd::Zero(freedom.count, freedom.count);
    for (const WeightedSpring& spring : weightedSprings(molecule))
        for (size_t i = 0; i < size_t(spring.count); ++i)
            for (size_t j = 0; j < size_t(spring.count); ++j) {
                const int row = freedom.index[size_t(spring.vertices[i])],
                          column = freedom.index[size_t(spring.vertices[j])];
                if (row < 0 || column < 0) continue;
                out(row, column) += spring.stiffness * spring.weights[i] * spring.weights[j] *
                                    inverseRootMass(molecule, spring.vertices[i]) *
                                    inverseRootMass(molecule, spring.vertices[j]);
            }
    return out;
}

VectorXd eigenvalues(const MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

// The largest h for which h^2 A + factor h B stays below 4, found by bisection: the eigenvalues grow with h.
double stableStep(const MatrixXd& stiffness, const MatrixXd& damping, double factor, double mostA,
                  double mostB) {
    // h^2 mostA + factor h mostB = 4 is safe, since the two largest eigenvalues bound that of the sum.
    const double drag = factor * mostB;
    if (mostA <= 0 && drag <= 0) return std::numeric_limits<double>::infinity();
    const double safe = 8 / (drag + std::sqrt(drag * drag + 16 * mostA));
    if (stiffness.rows() == 0 || drag == 0) return safe;
    const MatrixXd four = 4 * MatrixXd::Identity(stiffness.rows(), stiffness.cols());
    double below = safe, above = mostA > 0 ? std::min(2 * safe, 2 / std::sqrt(mostA)) : safe;
    for (int i = 0; i < 30 && above > below; ++i) {
        const double h = 0.5 * (below + above);
        const Eigen::LLT<MatrixXd> positive(four - h * h * stiffness - factor * h * damping);
        (positive.info() == Eigen::Success ? below : above) = h;
    }
    return below;
}

// No root of z^2 + b z + a = 0 is larger.
double fastestRate(double mostA, double mostB) {
    return 0.5 * mostB + std::sqrt(0.25 * mostB * mostB + mostA);
}

void analyseDensely(const Molecule& molecule, const Freedom& freedom, Analysis& out) {
    const MatrixXd stiffness = assemble(molecule, freedom, &WeightedSpring::stiffness);
    const MatrixXd damping = assemble(molecule, freedom, &WeightedSpring::damping);
    const VectorXd values = eigenvalues(stiffness);
    const double most = std::max(0.0, values(values.size() - 1));
    const double mostDamping = std::max(0.0, eigenvalues(damping)(values.size() - 1));
    out.highestFrequency = std::sqrt(most);
    const VectorXd bound = eigenvalues(scaledLaplacian(molecule, freedom));
    out.frequencyBound = std::sqrt(std::max(0.0, bound(bound.size() - 1)));

    int zeros = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        if (values(i) <= zeroRelative * most) {
            ++zeros;
        } else {
            out.lowestFrequency = std::sqrt(values(i));
            break;
        }
    }
    out.zeroModes = std::max(0, zeros - out.rigidModes);
    out.stableStepEuler = stableStep(stiffness, damping, 2, most, mostDamping);
    out.stableStepLeapfrog = stableStep(stiffness, damping, 4, most, mostDamping);
    out.fastestRate = fastestRate(most, mostDamping);
}

void analyseByIteration(const Molecule& molecule, const Freedom& freedom, Analysis& out) {
    out.modesKnown = false;
    const double most = largestByIteration(molecule, freedom, &WeightedSpring::stiffness, false);
    const double mostDamping = largestByIteration(molecule, freedom, &WeightedSpring::damping, false);
    out.highestFrequency = std::sqrt(most);
    out.frequencyBound = std::sqrt(largestByIteration(molecule, freedom, &WeightedSpring::stiffness, true));
    out.stableStepEuler = stableStep({}, {}, 2, most, mostDamping);
    out.stableStepLeapfrog = stableStep({}, {}, 4, most, mostDamping);
    out.fastestRate = fastestRate(most, mostDamping);
}

}  // namespace

Analysis analyse(const Molecule& molecule, bool pinned) {
    Analysis out;
    out.vertices = static_cast<int>(molecule.vertices.size());
    out.springs = static_cast<int>(molecule.springs.size());
    out.bends = static_cast<int>(molecule.bends.size());
    out.triangles = static_cast<int>(molecule.triangles.size());
    out.stableStepEuler = out.stableStepLeapfrog = std::numeric_limits<double>::infinity();
    for (const Vertex& vertex : molecule.vertices)
        out.totalMass += vertex.mass;
    std::vector<glm::dvec3> places;
    for (const Vertex& vertex : molecule.vertices)
        places.push_back(vertex.position);
    for (const WeightedSpring& spring : weightedSprings(molecule)) {
        const double stretch = glm::length(spring.along(places)) - spring.restLength;
        out.restEnergy += 0.5 * spring.stiffness * stretch * stretch;
    }
    const Freedom freedom(molecule, pinned);
    if (freedom.count == 0) return out;
    if (molecule.vertices.size() > mostDense) {
        analyseByIteration(molecule, freedom, out);
        return out;
    }
    out.rigidModes = int(rigidMotions(molecule, freedom).cols());
    analyseDensely(molecule, freedom, out);
    return out;
}

// ---- Motions one by one

namespace {

Mode modeOf(const Molecule& molecule, const Freedom& freedom, const VectorXd& vector, double frequency) {
    Mode out{frequency, std::vector<glm::dvec3>(molecule.vertices.size(), glm::dvec3(0))};
    double largest = 0;
    for (size_t i = 0; i < out.shape.size(); ++i) {
        if (freedom.index[i] < 0) continue;
        const Eigen::Vector3d u = vector.segment<3>(3 * freedom.index[i]) * inverseRootMass(molecule, int(i));
        out.shape[i] = {u.x(), u.y(), u.z()};
        largest = std::max(largest, u.norm());
    }
    for (glm::dvec3& u : out.shape)
        u /= std::max(largest, 1e-300);
    return out;
}

}  // namespace

std::vector<Mode> modesOf(const Molecule& molecule, bool pinned, size_t most) {
    std::vector<Mode> out;
    const Freedom freedom(molecule, pinned);
    if (molecule.vertices.size() > mostDense || freedom.count == 0 || molecule.vertices.size() < 2)
        return out;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(
        assemble(molecule, freedom, &WeightedSpring::stiffness));
    const VectorXd& values = solver.eigenvalues();
    const double largest = std::max(0.0, values(values.size() - 1));
    Eigen::Index zeros = 0;
    while (zeros < values.size() && values(zeros) <= zeroRelative * largest)
        ++zeros;
    // what is left of the motions without stiffness when those of the whole are taken out
    const MatrixXd rigid = rigidMotions(molecule, freedom);
    MatrixXd soft = solver.eigenvectors().leftCols(zeros);
    soft -= rigid * (rigid.transpose() * soft);
    soft = basisOf(soft, 0.5);
    for (Eigen::Index i = 0; i < soft.cols() && out.size() < most; ++i)
        out.push_back(modeOf(molecule, freedom, soft.col(i), 0));
    for (Eigen::Index i = zeros; i < values.size() && out.size() < most; ++i)
        out.push_back(modeOf(molecule, freedom, solver.eigenvectors().col(i), std::sqrt(values(i))));
    return out;
}

double bendReach(const Molecule& molecule, const Spring& spring) {
    const glm::dvec3 a = molecule.vertices[size_t(spring.a)].position,
                     b = molecule.vertices[size_t(spring.b)].position;
    const double squared = glm::dot(b - a, b - a);
    if (squared == 0) return 0;
    // a fibre at x of a body that bends about y gets shorter by x times the curvature, on the inner side
    return -0.5 * (a.x + b.x) * (b.z - a.z) * (b.z - a.z) / squared;
}

}  // namespace shoal
