#include "molecule/linearised.h"

#include <algorithm>
#include <cmath>

namespace shoal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Freedom::Freedom(const Molecule& molecule, bool pinned) {
    for (const Vertex& vertex : molecule.vertices)
        index.push_back(pinned && vertex.pinned ? -1 : count++);
}

Eigen::Vector3d direction(const Molecule& molecule, int a, int b) {
    return toEigen(unit(molecule.vertices[size_t(a)].position - molecule.vertices[size_t(b)].position));
}

Eigen::Matrix3d resisted(const Molecule& molecule, const WeightedSpring& spring) {
    if (spring.restLength == 0) return Eigen::Matrix3d::Identity();
    glm::dvec3 d(0);
    for (size_t i = 0; i < size_t(spring.count); ++i)
        d += spring.weights[i] * molecule.vertices[size_t(spring.vertices[i])].position;
    const Eigen::Vector3d n = toEigen(unit(d));
    return n * n.transpose();
}

double inverseRootMass(const Molecule& molecule, int vertex) {
    return 1 / std::sqrt(molecule.vertices[size_t(vertex)].mass);
}

MatrixXd assemble(const Molecule& molecule, const Freedom& freedom, double WeightedSpring::*coefficient) {
    MatrixXd out = MatrixXd::Zero(3 * freedom.count, 3 * freedom.count);
    for (const WeightedSpring& spring : weightedSprings(molecule)) {
        const Eigen::Matrix3d block = spring.*coefficient * resisted(molecule, spring);
        for (size_t i = 0; i < size_t(spring.count); ++i)
            for (size_t j = 0; j < size_t(spring.count); ++j) {
                const int row = freedom.index[size_t(spring.vertices[i])],
                          column = freedom.index[size_t(spring.vertices[j])];
                const double share = spring.weights[i] * spring.weights[j] *
                                     inverseRootMass(molecule, spring.vertices[i]) *
                                     inverseRootMass(molecule, spring.vertices[j]);
                if (row >= 0 && column >= 0) out.block<3, 3>(3 * row, 3 * column) += share * block;
            }
    }
    return out;
}

MatrixXd basisOf(const MatrixXd& columns, double least) {
    if (columns.rows() == 0 || columns.cols() == 0) return MatrixXd(columns.rows(), 0);
    const Eigen::JacobiSVD<MatrixXd> svd(columns, Eigen::ComputeThinU);
    Eigen::Index rank = 0;
    while (rank < svd.singularValues().size() && svd.singularValues()(rank) > least)
        ++rank;
    return svd.matrixU().leftCols(rank);
}

namespace {

// Rows of three of every vertex: what the six motions of the whole do to it. Lengths are shares of the size.
MatrixXd motionsOfWhole(const Molecule& molecule) {
    glm::dvec3 centre(0);
    for (const Vertex& vertex : molecule.vertices)
        centre += vertex.position / double(molecule.vertices.size());
    const double size = molecule.size();
    MatrixXd out = MatrixXd::Zero(3 * Eigen::Index(molecule.vertices.size()), 6);
    for (size_t i = 0; i < molecule.vertices.size(); ++i) {
        const Eigen::Index row = 3 * Eigen::Index(i);
        const Eigen::Vector3d p = toEigen((molecule.vertices[i].position - centre) / size);
        out.block<3, 3>(row, 0).setIdentity();
        for (int axis = 0; axis < 3; ++axis)
            out.block<3, 1>(row, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(p);
    }
    return out;
}

MatrixXd rowsOf(const MatrixXd& motions, const Freedom& freedom, bool moving) {
    MatrixXd out(3 * Eigen::Index(freedom.index.size()), 6);
    Eigen::Index rows = 0;
    for (size_t i = 0; i < freedom.index.size(); ++i) {
        if ((freedom.index[i] >= 0) != moving) continue;
        out.middleRows<3>(rows) = motions.middleRows<3>(3 * Eigen::Index(i));
        rows += 3;
    }
    return out.topRows(rows);
}

}  // namespace

MatrixXd rigidMotions(const Molecule& molecule, const Freedom& freedom) {
    const MatrixXd motions = motionsOfWhole(molecule);
    // the combinations that leave what is pinned where it is
    MatrixXd held = MatrixXd::Identity(6, 6);
    const MatrixXd pinned = rowsOf(motions, freedom, false);
    if (pinned.rows() > 0) {
        const Eigen::JacobiSVD<MatrixXd> svd(pinned, Eigen::ComputeFullV);
        Eigen::Index rank = 0;
        while (rank < svd.singularValues().size() && svd.singularValues()(rank) > 1e-7)
            ++rank;
        held = svd.matrixV().rightCols(6 - rank);
    }
    MatrixXd out = basisOf(rowsOf(motions, freedom, true) * held, 1e-7);
    double largest = 0;
    for (size_t i = 0; i < freedom.index.size(); ++i) {
        const int block = freedom.index[i];
        if (block < 0) continue;
        const double root = 1 / inverseRootMass(molecule, int(i));
        out.middleRows<3>(3 * block) *= root;
        largest = std::max(largest, root);
    }
    return basisOf(out, 1e-9 * largest);
}

}  // namespace shoal
