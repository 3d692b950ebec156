// A spring as a substep takes it. Needs `stiffnessFactor` and `dampingFactor`, with verlet `substep`, s.
#include "physics/spring.glsl"

// Returns the force on an end, N: d (m) and relative (m/s) are from the other end to it, stiffness in N/m, damping in kg/s.
// inverseMasses: 1/kg, the sum of the ends'; with verlet, where a spring is a distance constraint, it bounds the stiffness
// (solver/verlet.glsl).
vec3 sprung(vec3 d, vec3 relative, float stiffness, float damping, float restLength, float inverseMasses)
{
    stiffness *= stiffnessFactor;
#ifdef VERLET
    stiffness = min(stiffness, 1.0 / (inverseMasses * (substep * substep)));
#endif
    return springForce(d, relative, stiffness, damping * dampingFactor, restLength);
}

// Returns what the springs' force (N) on a vertex adds to its velocity over a time (s), m/s.
vec3 springKick(vec3 force, float inverseMass, float time)
{
    return force * (inverseMass * time);
}
