// A lane an entry.
#include "school/keys.glsl"

layout(local_size_x = 64) in;

uniform int count;

layout(std430) writeonly buffer Sorted { uvec2 pairs[]; };

void main()
{
    int entry = min(int(gl_GlobalInvocationID.x), count - 1);
    pairs[entry] = pairOf(entry);
}
