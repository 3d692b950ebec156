// The last stage of contact/respond.glsl.
#include "contact/respond.glsl"
#include "contact/shares.glsl"

// Returns how far a contact moves the sphere beside what pushes it apart, kg m: an impact by the change of its velocity in the
// time since, what sticks back towards where it began to.
vec3 settle(int slot, int other, Entry known)
{
    Meeting with = meetingAs(slot, other, known.anchor);
    vec3 n = with.contact.normal;
    if (!with.meets) return vec3(0.0);
    if (with.contact.impact) return known.push.xyz * with.contact.since;
    vec2 shares = vec2(shareOf(slot, own), shareOf(other, with.sphere));
    vec3 slip = with.apart - known.anchor.xyz;
    slip -= n * dot(slip, n);
    float most = 0.002 * (own.radius + with.sphere.radius);
    float back = min(1.0, most / max(length(slip), 1e-30)) / weightAlong(with, n, shares);
    return known.push.w >= 0.0 ? -slip * back : vec3(0.0);
}
