// A lane a slot: the list of the spheres that it touches. Cells are two diameters wide, so that of the 27 around a sphere
// only the eight on its side can hold one that it touches: four rows of two.
//
// A rasteriser on a CPU runs both sides of a branch, but leaves a loop when no lane stays in it: what is rare is the body
// of a loop here, and the four rows are one loop.
#include "contact/records.glsl"
#include "contact/touch.glsl"

uniform usamplerBuffer starts;
uniform float reach;  // m, twice the largest radius

// Slots of a row's two cells: x the first, y their number. The last key is followed by the first, and slots likewise.
ivec2 rowSlots(ivec3 from)
{
    int key = int(cellKey(from, uint(keyMask)));
    int first = int(texelFetch(starts, key).x);
    int end = int(texelFetch(starts, ((key + 1) & keyMask) + 1).x);
    return ivec2(first, key == keyMask ? count - first + end : end - first);
}

void main()
{
    bool inside = int(gl_GlobalInvocationID.x) < count;
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    loadOwn(slot);
    vec3 offset = ownPlace - vec3(ownCell & (localCells - 1)) * cell;
    ivec3 side = ivec3(step(vec3(0.5 * cell), offset)) * 2 - 1;
    ivec3 from = ivec3(ownCell.x + min(side.x, 0), ownCell.yz);
    ivec2 rows[4];
    for (int r = 0; r < 4; ++r) rows[r] = rowSlots(from + ivec3(0, side.y * (r & 1), side.z * (r >> 1)));
    ivec4 ends = ivec4(rows[0].y, rows[0].y + rows[1].y, rows[0].y + rows[1].y + rows[2].y,
                       rows[0].y + rows[1].y + rows[2].y + rows[3].y);
    ivec4 begins = ivec4(rows[0].x, rows[1].x - ends.x, rows[2].x - ends.y, rows[3].x - ends.z);
    float reachSquared = reach * reach;
    int i = 0;
    while (i < ends.w) {
        bool hit = false;
        int other = 0;
        int row = 0;
        while (i < ends.w && !hit) {
            row = int(i >= ends.x) + int(i >= ends.y) + int(i >= ends.z);
            other = i + (i < ends.x ? begins.x : i < ends.y ? begins.y : i < ends.z ? begins.z : begins.w);
            other -= other >= count ? count : 0;
            uvec4 place = texelFetch(places, other);
            vec3 d = localDifference(ownPlace, uintBitsToFloat(place.xyz), cell);
            hit = dot(d, d) < reachSquared && mayMeet(place.w, other);
            ++i;
        }
        while (hit) {
            // rows may share keys, and places repeat
            ivec3 theirs = cellOf(other);
            ivec3 wanted = from + ivec3(0, side.y * (row & 1), side.z * (row >> 1));
            if (theirs.yz == wanted.yz && (theirs.x == wanted.x || theirs.x == wanted.x + 1)) meet(other);
            hit = false;
        }
    }
    if (inside) finish(slot);
}
