// The net of light that waves throw on what lies below: a grid over the surface, each corner moved to where the light
// that enters there arrives. It is larger than the tile by a margin, from which light comes in. Set by C++: CELLS of the
// grid along a side, and MARGIN, tiles.

#include "water/waves.glsl"

out vec2 before;  // place on the surface, tiles

void main()
{
    ivec2 node = ivec2(gl_VertexID % (CELLS + 1), gl_VertexID / (CELLS + 1));
    before = mix(vec2(-MARGIN), vec2(1.0 + MARGIN), vec2(node) / float(CELLS));
    vec2 after = before - waveSlope(before);
    gl_Position = vec4(after * 2.0 - 1.0, 0.0, 1.0);
}
