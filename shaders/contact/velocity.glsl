// Velocities of slots in contact, of the iteration before.
#ifdef TRIANGLES
uniform samplerBuffer velocities;  // written by contact/spread.comp
#endif
uniform samplerBuffer impulses;

vec3 impulseOf(int slot)
{
    return texelFetch(impulses, slot).xyz;
}

vec3 velocityOf(int slot, vec3 start, float weight)
{
#ifdef TRIANGLES
    return texelFetch(velocities, slot).xyz;
#else
    return start + impulseOf(slot) * weight;
#endif
}
