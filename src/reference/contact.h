// Motion with contact, in continuous time: the limit that shaders/physics/collide.glsl aims at.
//
// A vertex that is not pinned stays outside every collider's rest surface (its thickness off the drawn one).
// With n the surface's normal, v_n = v . n, e the restitution and mu the friction:
//
//   impact    v_n becomes -e v_n; the rest of v loses min(mu (1 + e) |v_n|, itself) along its direction
//             (Coulomb). Found as an event: where the distance crosses 0 within a step.
//   rest      a rebound below 1e-8 m/s, or of less than 1e-13 m, ends bouncing. While the other forces press
//   the vertex into the surface
//             it has no acceleration along n but that of following the surface; N is the force that this
//             takes.
//   stick     at speed 0 it stays where it is while the other forces along the surface are within mu N.
//   slide     otherwise mu N acts against its velocity, until that is 0.
//   release   when N would have to pull.
//
// Start and end of sticking, sliding and resting are events too. Between events the motion is smooth and
// every step is one of RungeKutta, so that the order survives contact. Up to three surfaces may hold a vertex
// at once.
#pragma once

#include "reference/deadline.h"
#include "reference/problem.h"

namespace shoal::reference {

struct ContactRun {
    State state;
    int64_t events = 0;
    // False when the events did not come to an end (bounces without number, contact that flickers) or the
    // state is not finite: the rest of the run was done without bounces, and is no solution.
    bool settled = true;
};

// `steps` equal steps over `duration`, each cut where something happens. What starts inside a collider is put
// onto its rest surface first.
// OutOfTime: the deadline has passed.
ContactRun integrateWithContact(const Problem& problem, const State& start, double duration, int64_t steps,
                                const Deadline& deadline = Deadline());

// Impact with a surface of unit normal n: the velocity after it.
glm::dvec3 afterImpact(const glm::dvec3& velocity, const glm::dvec3& n, double restitution, double friction);

}  // namespace shoal::reference
