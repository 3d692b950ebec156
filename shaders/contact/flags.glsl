// A slot's count of contacts has two flags. HELD: its molecule is a rigid body, which a collider near this sphere may hold while
// others push it elsewhere. RESPONDS: it takes part in the response, as it does with contacts, where it is held, and in the step
// after, because what contacts remember has acted on it since (contact/respond.glsl).
const uint CONTACTS = 0x3fffffffu;
const uint HELD = 0x40000000u;
const uint RESPONDS = 0x80000000u;
// With a sphere's 1/mass, as bits: its molecule has been born since the last step, and remembers nothing.
const uint FRESH = 0x80000000u;
// With a sphere's radius, as bits: its molecule rests (contact/rest.comp).
const uint RESTS = 0x80000000u;
// What a step marks a slot whose molecule rests with: one that is awake touches it; one that an impact has woken as far away as
// it reaches does, which says nothing where the molecule wakes as well, since the two happen at once; the impact that has woken its
// molecule, so many contacts away, a bit each; that has woken a sphere of its molecule.
const uint TOUCHED = 1u;
const uint BESIDE = 2u;
const uint STRUCK = 4u;
const uint WOKEN = 0x80000000u;

bool marksWoken(uint mark)
{
    return mark > (TOUCHED | BESIDE);
}

// Whether the molecule of a slot's sphere rests, and nothing has woken it in this step. `radius`: as the records have it.
bool isResting(uint radius, uint mark)
{
    return (radius & RESTS) != 0u && !marksWoken(mark);
}
