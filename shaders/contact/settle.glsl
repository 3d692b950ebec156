// The last stage of contact/respond.glsl.
#include "contact/respond.glsl"

// Returns how far a contact moves the sphere beside what pushes it apart, kg m: an impact by the change of its velocity in the
// time since, what sticks back towards where it began to. `kept`: the entry as the next step begins with it.
vec3 settle(int slot, int other, Entry known, out Entry kept)
{
    Meeting with = meetingAs(slot, other, known.anchor);
    vec3 n = with.contact.normal;
    kept = remembered(known, with.sphere);
    if (!with.meets) return vec3(0.0);
    if (with.contact.impact) return known.push.xyz * with.contact.since;
    vec2 shares = vec2(shareOf(slot, own), shareOf(other, with.sphere));
    vec3 slip = with.apart - known.anchor.xyz;
    slip -= n * dot(slip, n);
    float most = 0.002 * (own.radius + with.sphere.radius);
    float back = min(1.0, most / max(length(slip), 1e-30)) / weightsBetween(with, n, shares).y;
    return known.push.w >= 0.0 ? -slip * back : vec3(0.0);
}

#ifdef WALLS
// Returns which part of what colliders push the next step begins with. Both sums are of the impulses' lengths, N s.
float rememberedOfWalls(float start, float now)
{
    return own.weight > 0.0 ? min(1.0, mostRemembered(start, now, own.weight) / max(now, 1e-30)) : 0.0;
}
#endif
