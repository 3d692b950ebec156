// The contacts of the last step that a slot remembers.
#include "contact/response/pair.glsl"
#include "contact/response/memory.glsl"
#pragma reads oldImpulses oldAnchors keptImpulses keptAnchors

int memory;  // of the own sphere
bool remembers;
int oldListed;

void loadMemory(int slot)
{
    memory = memoryOf(sphereOf(slot));
    remembers = !own.fresh && remembersAt(memory);
    oldListed = remembers ? rememberedBy(memory) : 0;
}

// Returns the contact with another slot; NO_PART: there was none.
ContactImpulse oldContact(int other)
{
    int otherMemory = memoryOf(sphereOf(other));
    int place = -1;
    for (int e = 0; e < oldListed; ++e) place = partnerAt(memory, e) == otherMemory ? e : place;
    if (place < 0 || isFresh(other)) return noImpulse(NO_PART);
    if (inTextures) return impulseFrom(oldImpulsesAt(memory, place), oldAnchorsAt(memory, place));
    return impulseFrom(keptImpulsesAt(memory, place), keptAnchorsAt(memory, place));
}

// Whether a contact that was so is closed, however fast its spheres approach: it carries something, or it has bounced in both of the last
// steps and nothing but forces has moved the two since. `struck`: an impact of this step has.
bool isClosed(ContactImpulse old, bool struck)
{
    bool carries = old.kind == PERSISTENT && old.impulse != vec3(0.0);
    return carries || (old.kind == REPEATED && !struck);
}
