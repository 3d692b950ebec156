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

// Returns when stage 0 to 3 of rk4 takes its rates, s after the substep's start.
float stageTime(int stage)
{
    return stage == 0 ? 0.0f : stage == 3 ? substep : 0.5f * substep;
}

// Returns the share of the rates of stage 0 to 3 of rk4 in the substep.
float shareOf(int stage)
{
    return stage == 0 || stage == 3 ? 1.0f / 6.0f : 1.0f / 3.0f;
}

// Returns where a rate leads from the substep's start: to rk4's next stage, or from its last with the sum of shares to the end.
vec3 afterStage(int stage, vec3 start, vec3 rate, vec3 sum)
{
    return start + (stage == 3 ? sum : rate) * (stage < 2 ? 0.5f * substep : substep);
}
