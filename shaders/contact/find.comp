// A lane a slot: the list of the spheres that it touches.
#include "contact/search.glsl"

void main()
{
    bool inside = int(gl_GlobalInvocationID.x) < count;
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    search(slot);
    if (inside) finish(slot);
}
