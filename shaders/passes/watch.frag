// watch: the last pass of a frame. A texel is discarded unless its state has run away, and nothing is written: a query
// tells whether a texel was left.
#include "state/textures.glsl"
#include "physics/runaway.glsl"

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    uint speed = squareBits(texelFetch(velocities, texel, 0).xyz);
    uint place = squareBits(texelFetch(positions, texel, 0).xyz);
    if (isPadding(ownAddress().y) || !isRunaway(speed, place)) discard;
}
