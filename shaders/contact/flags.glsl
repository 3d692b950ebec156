// A slot's count of contacts has two flags. HELD: a collider holds it, which its step has not answered (contact/touch.glsl).
// RESPONDS: it takes part in the response, as it does with contacts, where it is held, and in the step after, because what contacts
// remember has acted on it since (contact/respond.glsl). Neither is the sign bit: Mesa 25 compares an integer without its sign with 0
// as if it were a float, for which small integers are 0 as well.
const uint CONTACTS = 0x1fffffffu;
const uint HELD = 0x20000000u;
const uint RESPONDS = 0x40000000u;

// Whether spheres or a collider act on a sphere of that count.
bool isActedOn(uint counted)
{
    return (counted & ~RESPONDS) != 0u;
}

// With a sphere's 1/mass, as bits: its molecule has been born since the last step, and remembers nothing.
const uint FRESH = 0x80000000u;
// With a sphere's radius, as bits: its molecule rests (contact/rest.comp).
const uint RESTS = 0x80000000u;
// A step marks slots whose molecule rests.
const uint TOUCHED = 1u;         // something awake touches it
const uint BESIDE = 2u;          // it touches the last that an impact wakes; says nothing where its molecule wakes as well
const uint STRUCK = 4u;          // an impact has woken its molecule, as many contacts away as this is shifted
const uint WOKEN = 0x80000000u;  // a sphere of its molecule was woken

bool marksWoken(uint mark)
{
    return mark > (TOUCHED | BESIDE);
}
