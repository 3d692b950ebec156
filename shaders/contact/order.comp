// Spheres in the order of their keys and, in a cell, of their numbers: where each cell begins, and places and cells by slot.
//   without COUNTED: a lane a slot, after a stable sort
//   COUNTED: a lane a sphere of `members`; its slot follows from its number, so that a repeat gives the same slots
#ifdef COUNTED
uniform usamplerBuffer arrivals;  // by sphere: x key
uniform usamplerBuffer starts;
uniform usamplerBuffer members;   // the spheres of a cell beside one another
uniform bool onlyOrder;           // of a second grid

layout(std430) writeonly buffer Sorted { uvec2 sorted[]; };
layout(std430) writeonly buffer Places { uvec4 newPlaces[]; };
layout(std430) writeonly buffer Cells { uvec4 newCells[]; };
#else
#include "contact/old_starts.glsl"

uniform int keyMask;

// A 4-vector as two doubles, because a CPU rasteriser makes its stores one by one.
layout(std430) writeonly buffer Places { dvec2 newPlaces[]; };
layout(std430) writeonly buffer Cells { dvec2 newCells[]; };
#endif
layout(std430) writeonly buffer Slots { uint slots[]; };
#ifdef RESTING
#include "contact/marked.glsl"

layout(std430) writeonly buffer Marks { uint marks[]; };
#endif
#include "contact/touching_groups.glsl"

layout(local_size_x = 64) in;

uniform usamplerBuffer spherePlaces;
uniform usamplerBuffer sphereCells;
uniform int count;

void main()
{
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
#ifdef COUNTED
    uint sphere = texelFetch(members, slot).x;
    uint key = texelFetch(arrivals, int(sphere)).x;
    int first = int(texelFetch(starts, int(key)).x);
    int end = int(texelFetch(starts, int(key) + 1).x);
    slot = first;
    for (int i = first; i < end; ++i) slot += int(texelFetch(members, i).x < sphere);
    sorted[slot] = uvec2(key, sphere);
    if (onlyOrder) return;
    newPlaces[slot] = texelFetch(spherePlaces, int(sphere));
    newCells[slot] = texelFetch(sphereCells, int(sphere));
#else
    uvec2 pair = texelFetch(sorted, slot).xy;
    uint sphere = pair.y;
    uvec4 place = texelFetch(spherePlaces, int(sphere));
    uvec4 cell = texelFetch(sphereCells, int(sphere));
    newPlaces[slot] = dvec2(packDouble2x32(place.xy), packDouble2x32(place.zw));
    newCells[slot] = dvec2(packDouble2x32(cell.xy), packDouble2x32(cell.zw));
    writeStarts(slot, pair.x, count, keyMask + 1);
#endif
    slots[sphere] = uint(slot);
#ifdef RESTING
    marks[slot] = 0u;
#endif
    if (gl_GlobalInvocationID.x == 0u) {
        noneTouches();
#ifdef RESTING
        noneMarked();
#endif
    }
}
