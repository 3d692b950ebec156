// Depth of particles that are not blended, cut out.

#include "particles/cover.glsl"

void main()
{
    if (shownAt(inSquare()).a < leastCover) discard;
}
