// A lane a slot: places and cells in the order of the sorted keys, and where each cell of the table begins.
#include "sort/starts.glsl"

layout(local_size_x = 64) in;

uniform int count;
uniform int keyMask;
uniform usamplerBuffer spherePlaces;
uniform usamplerBuffer sphereCells;

layout(std430, binding = 1) writeonly buffer Places { uvec4 newPlaces[]; };
layout(std430, binding = 2) writeonly buffer Slots { uint slots[]; };
layout(std430, binding = 3) writeonly buffer Active { uint groupsX; uint groupsY; uint groupsZ; uint actives; };
layout(std430, binding = 4) writeonly buffer Cells { uvec4 newCells[]; };

void main()
{
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    uvec2 pair = texelFetch(sorted, slot).xy;
    int sphere = int(pair.y);
    newPlaces[slot] = texelFetch(spherePlaces, sphere);
    newCells[slot] = texelFetch(sphereCells, sphere);
    slots[sphere] = uint(slot);
    writeStarts(slot, pair.x, count, keyMask + 1);
    bool last = slot == count - 1;
    // none yet (contact/touch.glsl)
    while (last) {
        groupsX = 0u;
        groupsY = 1u;
        groupsZ = 1u;
        actives = 0u;
        last = false;
    }
}
