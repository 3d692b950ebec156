// Copies a buffer in the way the fused step moves its state: read as texels, written as storage, each element once.
#include "state/stored.glsl"

layout(local_size_x = LANES) in;

uniform samplerBuffer source;
uniform int elements;

layout(std430) writeonly buffer Target { ELEMENT copied[]; };

void main()
{
    int i = int(gl_GlobalInvocationID.x);
    if (i >= elements) return;
    copied[i] = stored(texelFetch(source, i));
}
