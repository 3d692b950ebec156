// What contact with other molecules does to a molecule (src/simulate/texture_contact.h): to every vertex, what its sphere has
// gained. Needs fused/lane.glsl.
#include "state/numbered.glsl"

uniform usampler2D slots;    // of a sphere
uniform usampler2D counts;
uniform sampler2D impulses;  // kg m/s
uniform sampler2D shifts;    // kg m
uniform int firstSphere;     // of the group
uniform int groupMolecules;

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    loadRecord(molecule);
    int sphere = firstSphere + min(molecule, groupMolecules - 1) * VERTICES;  // texels past the last do what it does
    bool touched = false;
    for (int i = 0; i < VERTICES; ++i) {
        int slot = int(fetch(slots, sphere + i).x);
        if (fetch(counts, slot).x > 0u) {
            touched = true;
            if (!isHeld(pinned[i])) {
                x[i] += fetch(shifts, slot).xyz * inverseMass[i];
                v[i] += fetch(impulses, slot).xyz * inverseMass[i];
            }
        }
    }
#ifdef HISTORY
    if (touched) dx[0].x = NO_HISTORY;  // its next step starts anew (fused/bdf2.glsl)
#endif
    storeState(molecule);
}
