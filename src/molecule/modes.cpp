#include "molecule/analysis.h"

#include <algorithm>
#include <cmath>

#include "molecule/linearised.h"

namespace shoal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(assemble(molecule, freedom, &Spring::stiffness));
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

}  // namespace shoal
