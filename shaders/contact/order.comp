// A lane a slot: places and cells in the order of the sorted keys, and where each cell begins: cell k of the table has the slots
// starts[k] to starts[k + 1] - 1. No slot is given out by an atomic: the sort is stable, and the first sphere of a cell
// writes the starts of all cells since the one before it.
layout(local_size_x = 64) in;

uniform int count;
uniform int keyMask;
uniform usamplerBuffer sorted;  // x key, y sphere
uniform usamplerBuffer spherePlaces;
uniform usamplerBuffer sphereCells;

layout(std430, binding = 0) writeonly buffer Starts { uint starts[]; };
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
    uint next = slot == 0 ? 0u : texelFetch(sorted, slot - 1).x + 1u;
    while (next <= pair.x) {
        starts[next] = uint(slot);
        ++next;
    }
    bool last = slot == count - 1;
    uint end = pair.x + 1u;
    while (last && end <= uint(keyMask) + 1u) {
        starts[end] = uint(count);
        ++end;
    }
    // none yet (contact/touch.glsl)
    while (last) {
        groupsX = 0u;
        groupsY = 1u;
        groupsZ = 1u;
        actives = 0u;
        last = false;
    }
}
