// Molecules and problems made in code for the tests. The cases of the table of solvers, with +Y up.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "reference/discrete.h"

namespace shoal::test {

inline Molecule point(double mass) {
    Molecule out;
    out.name = "point";
    out.vertices.push_back({.position = {0, 0, 0}, .mass = mass});
    return out;
}

// Two vertices 1 m apart along x with the masses given.
inline Molecule pair(double first, double second, double stiffness, double damping) {
    Molecule out;
    out.name = "pair";
    out.vertices.push_back({.position = {0, 0, 0}, .mass = first});
    out.vertices.push_back({.position = {1, 0, 0}, .mass = second});
    out.springs.push_back({0, 1, stiffness, damping, {}, {}});
    return out;
}

// The folded leaf: a unit square folded by 0.12 at every corner, all six pairs sprung, masses 1.
inline Molecule leaf(double stiffness, double damping) {
    Molecule out;
    out.name = "leaf";
    const double x[] = {-0.5, 0.5, 0.5, -0.5}, z[] = {0.5, 0.5, -0.5, -0.5}, y[] = {0.12, -0.12, 0.12, -0.12};
    for (int i = 0; i < 4; ++i)
        out.vertices.push_back({.position = {x[i], y[i], z[i]}});
    for (int a = 0; a < 4; ++a) {
        for (int b = a + 1; b < 4; ++b) {
            out.springs.push_back({a, b, stiffness, damping, {}, {}});
        }
    }
    out.triangles = {{0, 1, 2}, {0, 2, 3}};
    return out;
}

// A chain of vertices of 0.01 kg that hangs down from the first, which is pinned; 0.1 m from one to the next.
inline Molecule hangingChain(int vertices, double stiffness, double damping) {
    Molecule out;
    out.name = "chain";
    for (int i = 0; i < vertices; ++i)
        out.vertices.push_back({.position = {0, -0.1 * i, 0}, .mass = 0.01, .pinned = i == 0});
    for (int i = 1; i < vertices; ++i)
        out.springs.push_back({i - 1, i, stiffness, damping, {}, {}});
    return out;
}

// A tetrahedron with edges of 0.1 m and vertices of 0.01 kg, about the origin.
inline Molecule regularTetrahedron(double stiffness, double damping) {
    Molecule out;
    out.name = "tetrahedron";
    const double a = 0.1 / std::sqrt(8.0);
    for (const glm::dvec3 corner : {glm::dvec3{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}})
        out.vertices.push_back({.position = corner, .mass = 0.01});
    for (int i = 1; i < 4; ++i)
        for (int j = 0; j < i; ++j)
            out.springs.push_back({i, j, stiffness, damping, {}, {}});
    return out;
}

// The largest |length / rest length - 1| of a spring.
inline double worstStrain(const Molecule& molecule, const reference::State& state) {
    double out = 0;
    for (const Spring& spring : molecule.springs) {
        const double length =
            glm::distance(state.position[size_t(spring.a)], state.position[size_t(spring.b)]);
        out = std::max(out, std::abs(length / molecule.restLength(spring) - 1));
    }
    return out;
}

// By 0.7 rad about (1, 2, 3), written with z up.
inline glm::dquat turned() {
    return glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 3, -2)));
}

// (x, y, z) with z up is (x, z, -y) with y up.
inline glm::dvec3 yUp(double x, double y, double z) {
    return {x, z, -y};
}

inline Field field(Boxed<FieldShape> shape) {
    Field out;
    out.shape = std::move(shape);
    return out;
}

}  // namespace shoal::test
