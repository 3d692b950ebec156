// Places and velocities, which members of a school read of one another, in the order of the sorted keys.
#include "state/lanes.glsl"
#pragma reads sorted bodies
#pragma writes places velocities
#ifndef TEXTURES
#include "sort/starts.glsl"

uniform int keyCount;
#endif

void main()
{
    int slot = ownLane();
    uvec2 pair = sortedAt(slot);
    vec4 place = bodiesAt(int(pair.y), 0);
    vec3 velocity = bodiesAt(int(pair.y), 1).xyz;
    putPlaces(slot, place.w > 0.0 ? place : vec4(vec3(1e18), 0.0));
    putVelocities(slot, vec4(velocity, dot(velocity, bodiesAt(int(pair.y), 2).xyz)));
#ifndef TEXTURES
    writeStarts(slot, pair.x, numbers, keyCount);
#endif
}
