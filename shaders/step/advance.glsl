// How the explicit solvers move a vertex over a substep. Needs `substep`, s, and `slips`. Read as C++ through GLM by the tests.

// Returns how far, in m, from its velocity v and what drag and gravity have made of it, both m/s.
vec3 driftOf(vec3 v, vec3 dragged)
{
#ifdef LEAPFROG
    // added at once: one rounding, so that contact can take a drift back exactly
    return ((slips != 0 ? dragged : v) + dragged) * (0.5f * substep);
#else
    return dragged * substep;
#endif
}

// Returns the velocity after it, m/s: with verlet what is left of it after positions are rounded. moved: m.
vec3 velocityAfter(vec3 dragged, vec3 moved)
{
#ifdef VERLET
    return moved / substep;
#else
    return dragged;
#endif
}
