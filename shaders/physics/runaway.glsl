// Detects a runaway state (src/simulate/watchdog.h): faster than FASTEST_SQUARED says, or not finite.
// Read as C++ through GLM by the tests.

// The bits of a square, of which those of what is not finite are larger than all others. As whole numbers, because a
// compiler may take a comparison of floats for one without NaNs.
uint squareBits(vec3 value)
{
    return floatBitsToUint(dot(value, value));
}

bool isRunaway(uint speed, uint place)
{
    return speed >= floatBitsToUint(float(FASTEST_SQUARED)) || place >= 0x7f800000u;
}
