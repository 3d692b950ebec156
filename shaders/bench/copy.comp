// Copies a buffer in the way the fused step moves its state: read as texels, written as storage, each element once.
layout(local_size_x = LANES) in;

uniform samplerBuffer source;
uniform int elements;

#ifdef PAIRED_STORES
layout(std430, binding = 0) writeonly buffer Target { dvec2 copied[]; };
#define STORED(value) dvec2(packDouble2x32(floatBitsToUint((value).xy)), packDouble2x32(floatBitsToUint((value).zw)))
#else
layout(std430, binding = 0) writeonly buffer Target { vec4 copied[]; };
#define STORED(value) (value)
#endif

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= elements) return;
    vec4 value = texelFetch(source, i);
    copied[i] = STORED(value);
}
