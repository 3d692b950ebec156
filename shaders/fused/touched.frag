// What contact with other molecules does to a molecule (src/simulate/texture_contact.h): to every vertex, what its sphere has
// gained. Needs fused/lane.glsl.
#include "contact/shape.glsl"

uniform usampler2D slots;    // of a sphere
uniform usampler2D counts;
uniform sampler2D impulses;  // kg m/s
uniform sampler2D shifts;    // kg m
uniform int groupMolecules;

struct Gain {
    vec3 impulse, shift;
    bool touched;
};

// Adds what a sphere has gained, of which a vertex takes one of so many parts.
void add(int sphere, float parts, inout Gain gain)
{
    int slot = int(fetch(slots, sphere).x);
    if (fetch(counts, slot).x == 0u) return;
    gain.touched = true;
    gain.impulse += fetch(impulses, slot).xyz / parts;
    gain.shift += fetch(shifts, slot).xyz / parts;
}

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    loadRecord(molecule);
    int sphere = firstSphere + min(molecule, groupMolecules - 1) * SPHERES;  // texels past the last do what it does
    bool touched = false;
    for (int i = 0; i < VERTICES; ++i) {
        Gain gain = Gain(vec3(0.0), vec3(0.0), false);
        add(sphere + i, 1.0, gain);
#ifdef TRIANGLES
        vec4 around = shapeOf(i);
        for (int t = 0; t < int(around.w); ++t) add(sphere + int(shapeOf(int(around.z) + t).x), 3.0, gain);
#endif
        touched = touched || gain.touched;
        if (!isHeld(pinned[i])) {
            x[i] += gain.shift * inverseMass[i];
            v[i] += gain.impulse * inverseMass[i];
        }
    }
#ifdef HISTORY
    if (touched) dx[0].x = NO_HISTORY;  // its next step starts anew (fused/bdf2.glsl)
#endif
    storeState(molecule);
}
