// The flags of contact's words. Of shaders this file alone knows in which bits they are; those of a count, which a saved state has, stand in
// src/simulate/contact/readback.cpp as well.

// With a slot's count of contacts. HELD: a collider holds it, which its step has not answered. RESPONDS: it takes part in the response,
// as it does with contacts, where it is held, and in the step after, because what contacts remember has acted on it since. Neither is
// the sign bit: Mesa 25 compares an integer without its sign with 0 as if it were a float, for which small integers are 0 as well.
const uint CONTACTS = 0x1fffffffu;
const uint HELD = 0x20000000u;
const uint RESPONDS = 0x40000000u;

// Whether spheres or a collider act on a sphere of that count.
bool isActedOn(uint counted)
{
    return (counted & ~RESPONDS) != 0u;
}

// Returns a count beside numbers, as one that is no denormal, which a GPU may take for 0.
float asMemory(uint counted)
{
    return uintBitsToFloat(counted | RESPONDS);
}

// The row of what rests (contact/search/responding.glsl).
const int NO_ROW = -1;

// With a number that is never negative, as bits: of a sphere's 1/mass, that its molecule has been born since the last step, and
// remembers nothing; of its radius, that its molecule rests; of a collider's friction, that it has restitution.
const uint FLAG = 0x80000000u;

uint withFlag(float number, bool isSet)
{
    return floatBitsToUint(number) | (isSet ? FLAG : 0u);
}

bool hasFlag(uint word)
{
    return (word & FLAG) != 0u;
}

float withoutFlag(uint word)
{
    return uintBitsToFloat(word & ~FLAG);
}

// Marks of slots whose molecule rests, within a step.
const uint TOUCHED = 1u;         // something awake touches it
const uint BESIDE = 2u;          // it touches the last that an impact wakes; says nothing where its molecule wakes as well
const uint LOAD_CHANGED = 4u;    // its contacts push otherwise than when it came to rest
const uint STRUCK = 8u;          // an impact has woken its molecule, as many contacts away as this is shifted
const uint WOKEN = 0x80000000u;  // a sphere of its molecule was woken

bool marksWoken(uint mark)
{
    return mark >= STRUCK;
}
