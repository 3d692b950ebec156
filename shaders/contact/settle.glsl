// The last stage of contact/respond.glsl: how far contacts move their spheres. What overlaps is pushed apart without a change
// of velocity, by what it took in the last step and one Jacobi iteration more; what sticks goes back to where it began to.
#include "contact/respond.glsl"

uniform UINTS effectiveCounts;  // by slot, as bits

const float pushSpeed = 1.0;    // m/s: what overlaps is pushed apart no faster

float ownCount;

void loadOwn(int slot)
{
    loadSphere(slot);
    ownCount = uintBitsToFloat(fetch(effectiveCounts, slot).x);
}

// Returns how far the contact moves the sphere, kg m.
vec3 settle(int slot, int other, Entry known)
{
    Meeting with = meetingAs(slot, other, known.anchor);
    vec3 n = with.contact.normal;
    if (!with.meets) return vec3(0.0);
    if (with.contact.impact) return known.push.xyz * with.contact.since;
    float step = 1.0 / weightAlong(with, n, vec2(ownCount, uintBitsToFloat(fetch(effectiveCounts, other).x)));
    vec3 slip = with.apart - known.anchor.xyz;
    bool sticks = (floatBitsToUint(known.push.w) & SLIDES) == 0u;
    float far = 0.002 * (own.radius + with.sphere.radius);
    slip -= n * dot(slip, n);
    return sticks ? -slip * min(1.0, far / max(length(slip), 1e-30)) * step : vec3(0.0);
}
