// A lane a slot: an impact wakes the molecule that it strikes, and all within as many contacts of it as the response has
// iterations, because no impulse gets further in a step; what these touch in turn is touched by something awake. Dispatched
// once for what is struck, and once more for each of these contacts.
#include "state/lanes.glsl"
#include "contact/rest/marks.glsl"
#include "contact/response/memory.glsl"
#include "contact/response/molecule.glsl"

uniform int contactsAway;  // of what wakes others in this dispatch
uniform bool last;

void wakePartners(int sphere)
{
    int remembered = rememberedBy(sphere);
    for (int e = 0; e < remembered; ++e) {
        int slot = partnerSlot(sphere, e);
        if (rested(slot) && !marksWoken(marksAt(slot)))
            mark(slot, last ? BESIDE : STRUCK << (contactsAway + 1));
    }
}

void main()
{
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    if ((marksAt(slot) & (STRUCK << contactsAway)) == 0u) return;
    Molecule molecule = moleculeOf(slot);
    for (int k = 0; k < molecule.spheres; ++k) {
        wakePartners(molecule.first + k);
        mark(slotOfSphere(molecule, k), WOKEN);
    }
}
