// A spring as a substep takes it. Needs `stiffnessFactor` and `dampingFactor`.
#include "physics/spring.glsl"

#if defined(VERLET) && defined(FUSED)
// Returns the stiffness of a distance constraint, N/m, between ends of such inverse masses together, 1/kg (solver/verlet.glsl).
float constraintStiffness(float weights)
{
    return 1.0 / (weights * (substep * substep));
}
#endif

// Returns the force on an end, N: d (m) and relative (m/s) are from the other end to it, stiffness in N/m, damping in kg/s.
// most: N/m, of the stiffness with verlet, where a spring is a distance constraint (solver/verlet.glsl).
vec3 sprung(vec3 d, vec3 relative, float stiffness, float damping, float restLength, float most)
{
    stiffness *= stiffnessFactor;
#ifdef VERLET
    stiffness = min(stiffness, most);
#endif
    return springForce(d, relative, stiffness, damping * dampingFactor, restLength);
}
