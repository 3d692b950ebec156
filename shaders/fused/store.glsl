// The buffers to which a lane writes a molecule: the whole state, and its record.
#ifdef PAIRED_STORES
// Half as many stores, which a CPU rasteriser makes one by one.
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
layout(std430, binding = 0) writeonly buffer NewState { ELEMENT newState[]; };
#ifdef RECORDS
layout(std430, binding = 1) writeonly buffer NewRecords { vec4 newRecords[]; };
#endif
