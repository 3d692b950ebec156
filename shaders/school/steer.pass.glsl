// Steers one school in the order of its grid, so that neighbours look into the same cells. In fragments one more pass (MOLECULES) brings what
// this writes to the molecules: a texel has a molecule of one group, and takes what stands at its slot.
#ifdef MOLECULES
#include "school/grid.glsl"
#include "sort/pairs.glsl"
#pragma reads bodies sorted starts steered

uniform ivec4 grid;         // first slot, slots, first key, keys
uniform float inverseCell;
uniform int firstBody;      // of the group
uniform int entries;        // of all grids

layout(location = 0) out vec4 newSteering[STEERING_ELEMENTS];

void main()
{
    // texels past the last molecule do what it does
    int molecule = min(int(gl_FragCoord.y) * STATE_WIDTH + int(gl_FragCoord.x), grid.y - 1);
    int body = firstBody + molecule;
    int key = grid.z + cellKey(cellOf(bodiesAt(body, 0).xyz, inverseCell), grid.w);
    int slot = placeOfNumber(sorted, uint(body), int(startsAt(key)), entries);
    vec4 own[STEERING_ELEMENTS];
    for (int e = 0; e < STEERING_ELEMENTS; ++e) own[e] = steeredAt(slot, e);
    newSteering = own;
}
#else
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
#endif
