// Returns the place, m, that tells the watchdog (src/simulate/watchdog.cpp) that a molecule's loops ended early.
vec3 cutShort()
{
    return vec3(uintBitsToFloat(0x7f800000u));
}
