// One molecule's equations of motion in double precision: the baseline of every error.
//
//   m dv/dt = sum of spring forces + m g + m a(x, t) + m thrust(V) + m drag(u(x, t) - v),   dx/dt = v
//
// A spring's force on its end a is -[k (l - L(t)) + c n.(va - vb)] n, n = (xa - xb) / l; none where l
// vanishes. Bends are springs between weighted means (WeightedSpring). Drag is gamma (u - v), or with two
// rates gamma_n across and gamma_t along the surface at the vertex. The scene's forces are a, thrust, which
// pushes along the mean velocity V, and wind, a part of u. A pinned vertex has infinite mass: it neither
// moves nor accelerates, and its velocity counts as 0.
#pragma once

#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/scene.h"

namespace shoal::reference {

struct Problem {
    const Molecule* molecule = nullptr;  // borrowed
    double scale = 1;                    // of the rest lengths
    double stiffness = 1, damping = 1;   // factors on every spring and bend
    double phase = 0;                    // rad, added to every actuation
    bool held = true;                    // pinned vertices hold
    glm::dvec3 gravity{0};               // m/s^2
    Drag drag{};
    std::vector<Field> fields{};
    std::vector<Force> forces{};        // those that act on it (reference/forces.h)
    std::vector<Collider> colliders{};  // pinned vertices pass through them

    // m, what errors are shares of: of the molecule, or 1 where it is a point.
    double size() const {
        const double own = scale * molecule->size();
        return own > 0 ? own : 1;
    }
    bool pinned(size_t vertex) const { return held && molecule->vertices[vertex].pinned; }
};

// World coordinates, one entry per vertex.
struct State {
    double time = 0;  // s
    std::vector<glm::dvec3> position, velocity;
};

using Vectors = std::vector<glm::dvec3>;

// m, with the muscle's share at that time.
double restLength(const Problem& problem, const Spring& spring, double time);
double kineticEnergy(const Problem& problem, const State& state);  // J
double springEnergy(const Problem& problem,
                    const State& state);  // J, of springs and bends, with rest lengths of that moment
// Kinetic + spring + gravity (0 at the origin), in J.
double energy(const Problem& problem, const State& state);
glm::dvec3 momentum(const Problem& problem, const State& state);         // kg m/s
glm::dvec3 angularMomentum(const Problem& problem, const State& state);  // kg m^2/s, about the origin

}  // namespace shoal::reference
