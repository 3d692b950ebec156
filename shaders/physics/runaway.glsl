// Detects a runaway state (src/simulate/watchdog.h): faster than FASTEST_SQUARED says, or not finite.
// Read as C++ through GLM by the tests.

// Returns the bits of a vector's square. Those of infinity and NaN are larger, as whole numbers, than those of every finite one. A
// comparison of floats would not do: compilers may assume that there are no NaNs.
uint squareBits(vec3 value)
{
    return floatBitsToUint(dot(value, value));
}

bool isRunaway(uint speed, uint place)
{
    return speed >= floatBitsToUint(float(FASTEST_SQUARED)) || place >= 0x7f800000u;
}
