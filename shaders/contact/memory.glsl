// What the last step has left of the contacts of a sphere: in fragments in the order of the slots that it had, else by sphere, so
// that a sphere that rests costs nothing. Needs contact/lists.glsl.
uniform LISTS oldLists;      // the other sphere, in fragments its slot
uniform ENTRIES oldPushes;   // Entry::push of contact/respond.glsl
uniform ENTRIES oldAnchors;  // Entry::anchor
#ifdef TEXTURES
uniform UINTS oldSlots;      // of a sphere
uniform UINTS oldCounts;     // by slot, as `counts`
uniform FLOATS oldKnown;     // by slot: xyz the sum of what its contacts remember, N s, which has acted as a force since; w the
                             // part of the colliders' last pushes that is remembered

int memoryOf(int sphere)
{
    return int(fetch(oldSlots, sphere).x);
}

int countAt(int memory)
{
    return min(int(fetch(oldCounts, memory).x & CONTACTS), LIST);
}

bool remembersAt(int memory)
{
    return isActedOn(fetch(oldCounts, memory).x);
}
#else
// By sphere: xyz the sum of what its contacts remember, N s, which has acted as a force since. w has two meanings: between two steps
// the number of contacts that it remembers, plus a half where a collider pushes; from contact/prepare.comp to contact/settle.comp how
// much colliders pushed at first, N s.
layout(std430) buffer Known { vec4 known[]; };

int memoryOf(int sphere)
{
    return sphere;
}

int countAt(int memory)
{
    return int(known[memory].w);
}

bool remembersAt(int memory)
{
    return known[memory].w > 0.0;
}
#endif
