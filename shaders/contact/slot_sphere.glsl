// The spheres in contact, as a response reads them.
#include "contact/records.glsl"
#include "contact/lists.glsl"
#include "contact/resting.glsl"
#include "physics/pair.glsl"

uniform FLOATS materials;  // x restitution, y friction, by group * groupCount + group
uniform int groupCount;
uniform float stepTime;    // s, of a contact step
uniform float restSpeed;   // m/s

struct Sphere {
    vec3 place;     // m, local (physics/cells.glsl)
    uint label;     // group * 2^26 + molecule
    vec3 velocity;  // m/s, before the response
    float weight;   // 1/kg, 0 where held
    float radius;   // m
    bool fresh;     // its molecule has been born since the last step
    bool rests;     // its molecule does: nothing moves it
};

Sphere sphereAt(int slot)
{
    uvec4 place = fetch(places, slot);
    uvec4 motion = fetch(motions, motionOf(slot));
    uint radius = fetch(cells, slot).w;
    bool stays = rests(slot);
    return Sphere(uintBitsToFloat(place.xyz), place.w, uintBitsToFloat(motion.xyz),
                  stays ? 0.0 : uintBitsToFloat(motion.w & ~FRESH), uintBitsToFloat(radius & ~RESTS),
                  (motion.w & FRESH) != 0u, stays);
}

vec2 materialOf(Sphere a, Sphere b)
{
    return fetch(materials, int(a.label >> 26u) * groupCount + int(b.label >> 26u)).xy;
}

// Whether the list of a slot holds another: one that is full may not, and then neither takes the contact.
bool holds(int slot, int other)
{
    int listed = int(fetch(counts, slot).x & CONTACTS);
    bool found = listed <= LIST;
    int e = found ? LIST : 0;
    while (e < LIST) {
        found = found || entryOf(slot, e) == other;
        ++e;
    }
    return found;
}
