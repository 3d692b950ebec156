// A 4-vector as it is written to a buffer of ELEMENT. With SOFTWARE, for rasterisers on a CPU, as two doubles: half as
// many stores, which they make one by one.
#ifdef SOFTWARE
#define ELEMENT dvec2
dvec2 stored(vec4 value)
{
    return dvec2(packDouble2x32(floatBitsToUint(value.xy)), packDouble2x32(floatBitsToUint(value.zw)));
}
#else
#define ELEMENT vec4
vec4 stored(vec4 value)
{
    return value;
}
#endif
