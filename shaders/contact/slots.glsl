// The spheres of contact by slot, a place in the order of their cells (contact/arrays.txt), and the step that contact has with them.
#include "state/numbered.glsl"
#include "physics/cells.glsl"
#include "contact/flags.glsl"
#pragma reads sorted places motions sphereMotions cells marks

uniform int count;     // spheres
uniform int keyMask;   // of the table of cells
uniform float cell;    // m
uniform float stepTime;   // s
uniform float restSpeed;  // m/s: what closes more slowly is no impact

int sphereOf(int slot)
{
    return int(sortedAt(slot).y);
}

// Where what a step leaves of a slot's sphere to the next lies (contact/response/memory.glsl).
int memoryRow(int slot)
{
    return inTextures ? slot : sphereOf(slot);
}

uvec4 motionAt(int slot)
{
    return inTextures ? motionsAt(slot) : sphereMotionsAt(sphereOf(slot));
}

vec3 placeAt(int slot)
{
    return uintBitsToFloat(placesAt(slot).xyz);
}

vec3 velocityAt(int slot)
{
    return uintBitsToFloat(motionAt(slot).xyz);
}

bool isFresh(int slot)
{
    return hasFlag(motionAt(slot).w);
}

float radiusAt(int slot)
{
    return withoutFlag(cellsAt(slot).w);
}

// Whether the molecule of a slot's sphere rested when the step began.
bool rested(int slot)
{
    return hasFlag(cellsAt(slot).w);
}

// Whether it still does: nothing has woken it in this step.
bool rests(int slot)
{
    return RESTS && rested(slot) && !marksWoken(marksAt(slot));
}

// How many of so many contacts a list holds, LIST at most.
int listedIn(uint counted)
{
    return min(int(counted & CONTACTS), LIST);
}
