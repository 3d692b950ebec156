// What contact with other molecules does to a molecule (contact/gains.frag). Needs fused/lane.glsl.
#include "state/numbered.glsl"

uniform sampler2DArray gains;
uniform int firstSphere;  // of the group
uniform int groupMolecules;

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    loadRecord(molecule);
    int sphere = firstSphere + min(molecule, groupMolecules - 1) * SPHERES;  // texels past the last do what it does
    bool touched = false;
    for (int i = 0; i < VERTICES; ++i) {
        vec3 velocity = texelFetch(gains, ivec3(texelOf(sphere + i), 0), 0).xyz;
        vec3 shift = texelFetch(gains, ivec3(texelOf(sphere + i), 1), 0).xyz;
        touched = touched || velocity != vec3(0.0) || shift != vec3(0.0);
        x[i] += shift;
        v[i] += velocity;
    }
#ifdef HISTORY
    if (touched) dx[0].x = NO_HISTORY;  // its next step starts anew (fused/bdf2.glsl)
#endif
    storeState(molecule);
}
