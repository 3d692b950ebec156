// Stages 0 to 3 of the classical Runge-Kutta method. Needs `substep`, s.

// Returns the share of a stage's rates in the substep.
float shareOf(int stage)
{
    return stage == 0 || stage == 3 ? 1.0 / 6.0 : 1.0 / 3.0;
}

// Returns where a rate leads from the substep's start: to the next stage, or from the last with the sum of all shares to the end.
vec3 afterStage(int stage, vec3 start, vec3 rate, vec3 sum)
{
    return start + (stage == 3 ? sum * substep : rate * (stage == 2 ? substep : 0.5 * substep));
}
