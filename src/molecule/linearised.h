// A molecule linearised about its drawn shape, as matrices: M x'' + C x' + K x = 0, scaled by the masses to
// A = M^-1/2 K M^-1/2, of the vertices that move. For this room and those who look for soft motions.
#pragma once

#include <vector>

#include <Eigen/Dense>

#include "molecule/molecule.h"

namespace shoal {

constexpr size_t mostDense = 300;      // vertices of which matrices are made
constexpr double zeroRelative = 1e-9;  // an eigenvalue below this share of the largest is zero

// The row of each vertex's first coordinate in the matrices; -1 where it is pinned.
struct Freedom {
    std::vector<int> index;
    int count = 0;

    Freedom(const Molecule& molecule, bool pinned);
};

inline Eigen::Vector3d toEigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

inline glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

// Unit, from b to a; zero for coincident vertices, where a spring has no direction.
Eigen::Vector3d direction(const Molecule& molecule, int a, int b);
// n n^T, n the unit direction of a spring; zero where its ends coincide. The identity for a bend that is flat
// at rest, which resists all directions alike.
Eigen::Matrix3d resisted(const Molecule& molecule, const WeightedSpring& spring);
double inverseRootMass(const Molecule& molecule, int vertex);

// Sum of coefficient * n n^T over the springs and bends, scaled by the masses. `coefficient`: stiffness or
// damping.
Eigen::MatrixXd assemble(const Molecule& molecule, const Freedom& freedom,
                         double WeightedSpring::*coefficient);

// Orthonormal columns that span the same, but for what is shorter than `least`.
Eigen::MatrixXd basisOf(const Eigen::MatrixXd& columns, double least);

// Rigid motions of the whole that hold every pinned vertex still, an orthonormal basis of them scaled by the
// roots of the masses, as eigenvectors of A are.
Eigen::MatrixXd rigidMotions(const Molecule& molecule, const Freedom& freedom);

}  // namespace shoal
