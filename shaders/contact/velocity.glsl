// Velocities of slots in contact, as the totals of the impulses make them: `impulses` of the last iteration, `earlier` of
// the one before, from which the next goes on beyond the last by `momentum` (Nesterov).
#ifdef TRIANGLES
uniform FLOATS velocities;  // written by contact/spread.comp
#endif
uniform FLOATS impulses;
uniform FLOATS earlier;
uniform float momentum;

vec3 impulseOf(int slot)
{
    vec3 impulse = fetch(impulses, slot).xyz;
#ifdef RELAX
    impulse += (impulse - fetch(earlier, slot).xyz) * momentum;
#endif
    return impulse;
}

vec3 velocityOf(int slot, vec3 start, float weight)
{
#ifdef TRIANGLES
    return fetch(velocities, slot).xyz;
#else
    return start + impulseOf(slot) * weight;
#endif
}
