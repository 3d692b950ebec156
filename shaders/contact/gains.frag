// gains: a texel a sphere, of one group: what contact adds to the velocity (m/s; w 1: it does) and place (m) of its vertex, and what
// acts on it over the next step (m/s^2; w as contact/apply.comp has it). With MANY the contacts of several spheres act on a vertex
// (contact/spread.glsl).
#include "state/numbered.glsl"
#ifdef MANY
#include "contact/shape.glsl"
#include "contact/spread.glsl"
#else
#include "contact/totals.glsl"
#include "contact/flags.glsl"

uniform UINTS slots;  // of a sphere
uniform UINTS counts;
uniform UINTS motions;
uniform TOTALS totals;
uniform FLOATS known;
uniform int firstSphere;  // of the group
uniform int partSpheres;
#endif
uniform float stepTime;  // s, of a contact step

layout(location = 0) out vec4 newGains[2];
layout(location = 2) out vec4 newLoad;

void main()
{
    int sphere = ownNumber();
    int number = sphere - firstSphere;
    if (number < 0 || number >= partSpheres) discard;
#ifdef MANY
    int molecule = number / SPHERES;
    int vertex = number - molecule * SPHERES;
    Total by = noTotal();
    if (vertex < VERTICES) by = changeOf(molecule, vertex);
    bool any = by.impulse != vec3(0.0) || by.shift != vec3(0.0) || by.load != vec3(0.0);
    newGains[0] = vec4(by.impulse, any ? 1.0 : 0.0);
    newGains[1] = vec4(by.shift, 0.0);
    newLoad = any ? loadOf(sphere, by, stepTime) : vec4(0.0);
#else
    int slot = int(fetch(slots, sphere).x);
    bool any = fetch(counts, slot).x != 0u;
    float weight = any ? uintBitsToFloat(fetch(motions, slot).w & ~FRESH) : 0.0;
    newGains = vec4[2](vec4(0.0, 0.0, 0.0, any ? 1.0 : 0.0), vec4(0.0));
    newLoad = vec4(0.0);
    if (weight > 0.0) {
        newGains[0] = vec4(firstTotal(totals, slot) * weight, 1.0);
        newGains[1] = vec4(secondTotal(totals, slot) * weight, 0.0);
        newLoad = vec4(fetch(known, slot).xyz * (weight / stepTime), 0.0);
    }
#endif
}
