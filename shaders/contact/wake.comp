// A lane a slot: an impact wakes the molecule that it strikes, and all within as many contacts of it as the response has
// iterations, because no impulse gets further in a step; what these touch in turn is touched by something awake. Dispatched
// once for each of these contacts.
#include "contact/marks.glsl"
#include "contact/records.glsl"

uniform samplerBuffer known;      // contact/memory.glsl
uniform int listStride;
#include "contact/recalled.glsl"

uniform usamplerBuffer groupsOf;  // contact/touch.glsl
uniform int contactsAway;         // of what wakes others in this dispatch
uniform bool last;

void wakePartners(int sphere)
{
    int listed = oldCount(sphere);
    for (int e = 0; e < listed; ++e) {
        int slot = oldPartner(sphere, e);
        if (rested(slot) && !marksWoken(marks[slot]))
            mark(slot, last ? BESIDE : STRUCK << (contactsAway + 1));
    }
}

void main()
{
    int slot = min(int(gl_GlobalInvocationID.x), count - 1);
    if ((marks[slot] & (STRUCK << contactsAway)) == 0u) return;
    uint label = texelFetch(places, slot).w;
    ivec2 group = ivec2(texelFetch(groupsOf, int(label >> 26u)).xy);
    int first = group.x + int(label & 0x3ffffffu) * group.y;
    for (int sphere = first; sphere < first + group.y; ++sphere) {
        wakePartners(sphere);
        mark(int(texelFetch(slots, sphere).x), WOKEN);
    }
}
