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
    const glm::dvec3 d = molecule.vertices[size_t(a)].position - molecule.vertices[size_t(b)].position;
    const double length = glm::length(d);
    return length > 0 ? toEigen(d / length) : Eigen::Vector3d::Zero();
}

double inverseRootMass(const Molecule& molecule, int vertex) {
    return 1 / std::sqrt(molecule.vertices[size_t(vertex)].mass);
}

MatrixXd assemble(const Molecule& molecule, const Freedom& freedom, double Spring::*coefficient) {
    MatrixXd out = MatrixXd::Zero(3 * freedom.count, 3 * freedom.count);
    for (const Spring& spring : molecule.springs) {
        const int a = freedom.index[size_t(spring.a)], b = freedom.index[size_t(spring.b)];
        const Eigen::Vector3d n = direction(molecule, spring.a, spring.b);
        const Eigen::Matrix3d block = spring.*coefficient * n * n.transpose();
        const double ra = inverseRootMass(molecule, spring.a), rb = inverseRootMass(molecule, spring.b);
        if (a >= 0) out.block<3, 3>(3 * a, 3 * a) += ra * ra * block;
        if (b >= 0) out.block<3, 3>(3 * b, 3 * b) += rb * rb * block;
        if (a >= 0 && b >= 0) {
            out.block<3, 3>(3 * a, 3 * b) -= ra * rb * block;
            out.block<3, 3>(3 * b, 3 * a) -= ra * rb * block;
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
