// A contact as the memory of a sphere has it.
#include "contact/response/impulse.glsl"
#include "contact/response/memory.glsl"
#pragma reads oldImpulses oldAnchors keptImpulses keptAnchors

// Returns the contact of two spheres as the memory of the first has it; NO_PART: there was none.
ContactImpulse contactIn(int memory, int partner)
{
    int place = placeOf(memory, partner);
    if (place < 0) return noImpulse(NO_PART);
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
