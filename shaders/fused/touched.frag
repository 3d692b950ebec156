// Contact with other molecules changes a molecule here (contact/response/gains.pass.glsl).
#include "fused/lane.glsl"
#include "state/numbered.glsl"

uniform sampler2DArray gains;
uniform int firstSphere;  // of the group
uniform int groupMolecules;
uniform float restSpeed;    // m/s
uniform float substepTime;  // s

void main()
{
    int molecule = ownMolecule();
    loadState(molecule);
    loadRecord(molecule);
    int sphere = firstSphere + min(molecule, groupMolecules - 1) * SPHERES;  // texels past the last do what it does
    for (int i = 0; i < VERTICES; ++i) {
        vec3 velocity = texelFetch(gains, ivec3(texelOf(sphere + i), 0), 0).xyz;
        vec3 shift = texelFetch(gains, ivec3(texelOf(sphere + i), 1), 0).xyz;
        x[i] += shift;
        v[i] += velocity;
        if (hasHistory && texelFetch(gains, ivec3(texelOf(sphere + i), 0), 0).w > 0.0) {
            // A slow vertex goes on as if it had always moved so, any other starts anew (fused/bdf2.glsl).
            dx[i] = length(v[i]) < restSpeed ? v[i] * substepTime : vec3(noHistory);
            dv[i] = vec3(0.0);
        }
    }
    storeState(molecule);
}
