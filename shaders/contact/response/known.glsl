// The contacts of the last step that a slot remembers.
#include "contact/response/pair.glsl"
#include "contact/response/kept.glsl"

int memory;  // of the own sphere
bool remembers;

void loadMemory(int slot)
{
    memory = memoryOf(sphereOf(slot));
    remembers = !own.fresh && remembersAt(memory);
}

// Whether it has been woken in this step, which has not moved it: there is nothing of it to be pushed apart again.
bool hasWoken(int slot)
{
    return RESTS && rested(slot) && !rests(slot);
}

// Returns the contact with another slot; NO_PART: there was none. Of two memories that differ, because one sphere has rested while the
// other let go of it, the longer impulse holds: what wakes finds the push that its springs and its other contacts are in balance with.
ContactImpulse oldContact(int other)
{
    int partner = memoryOf(sphereOf(other));
    if (own.fresh || isFresh(other)) return noImpulse(NO_PART);
    ContactImpulse known = contactIn(memory, partner);
    if (!RESTS || rests(other)) return known;
    ContactImpulse theirs = mirrored(contactIn(partner, memory));
    float longer = length(theirs.impulse) - length(known.impulse);
    return longer > 0.0 || (longer == 0.0 && partner < memory) ? theirs : known;
}
