// place: a texel each of the first that are set, ascending: all deaths (DEATHS), or as many free places as are asked for.
#include "births/ranks.glsl"
#include "births/words.glsl"

uniform usampler2D control;
uniform int controlBase;
uniform int firstRow;  // of the list

layout(location = 0) out uvec4 place;

void main()
{
    int rank = (int(gl_FragCoord.y) - firstRow) * STATE_WIDTH + int(gl_FragCoord.x);
#ifdef DEATHS
    uint count = wordOfControl(control, controlBase + controlDeaths);
#else
    uint count = wordOfControl(control, controlBase + controlBorn);
#endif
    place = uvec4(0u);
    if (uint(rank) < count) place.x = uint(placeOfRank(uint(rank)));
}
