// Steers one school in the order of its grid, so that neighbours look into the same cells. In fragments school/steered.pass.glsl brings
// what this writes to the molecules.
#include "state/lanes.glsl"
#include "state/packed.glsl"
#include "school/steer.glsl"
#pragma reads sorted
#ifdef TEXTURES
#pragma writes steered

uniform sampler2DArray steering;
#else
layout(std430) buffer Steering { vec4 steering[]; };
#endif

void main()
{
#ifndef TEXTURES
    if (isBehindLast()) return;  // a lane overwrites what it has read
#endif
    int slot = grids[0].x + ownLane();
    int body = int(sortedAt(slot).y);
    vec4 own[STEERING_ELEMENTS];
#ifdef TEXTURES
    steer(body, slot, element(steering, body - firstBody, 2), own);
    putAllSteered(slot, own);
#else
    int first = firstElement(body - firstBody, STEERING_ELEMENTS);
    steer(body, slot, steering[first + 2 * BLOCK], own);
    for (int e = 0; e < STEERING_ELEMENTS; ++e) steering[first + e * BLOCK] = own[e];
#endif
}
