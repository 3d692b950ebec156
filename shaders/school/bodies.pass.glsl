// The bodies of the molecules of one group.
#include "state/lanes.glsl"
#include "school/body.glsl"
#pragma writes bodies

uniform int firstBody;  // of these molecules

void main()
{
    int molecule = ownLane();
    vec4 body[BODY_ELEMENTS];
    findBody(molecule, body);
    putAllBodies(firstBody + molecule, body);
}
