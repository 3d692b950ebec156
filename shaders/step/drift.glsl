// How euler, verlet and leapfrog move a vertex over a substep, from its velocity v and what drag and gravity have made of it,
// both m/s. Needs `substep`, s, and `slips`.

// Returns how far, in m. For leapfrog added at once: one rounding, so that contact can take a drift back exactly.
vec3 driftOf(vec3 v, vec3 dragged)
{
#ifdef LEAPFROG
    return ((slips != 0 ? dragged : v) + dragged) * (0.5 * substep);
#else
    return dragged * substep;
#endif
}

// Returns the velocity after it, m/s: of verlet what is left after positions are rounded. moved: m.
vec3 velocityAfter(vec3 dragged, vec3 moved)
{
#ifdef VERLET
    return moved / substep;
#else
    return dragged;
#endif
}
