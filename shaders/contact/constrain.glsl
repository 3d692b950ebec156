// Works out for all iterations of contact/respond.glsl what a contact asks: in the first, or in fragments in a draw before it. Needs
// loadSphere(slot).
#include "contact/respond.glsl"
#include "contact/constraint.glsl"

// `anchor`: of the entry, from prepare().
Constraint constrain(int slot, int other, vec4 anchor)
{
    Meeting with = meetingAs(slot, other, anchor);
    PairContact contact = with.contact;
    vec2 shares = vec2(shareOf(slot, own), shareOf(other, with.sphere));
    vec2 weights = stepWeights(weightsBetween(with, contact.normal, shares), max(shares.x, shares.y));
    float reach = own.radius + with.sphere.radius;
    float target = contact.impact ? -with.material.x * contact.speed : partingSpeed(contact.depth, reach);
    float lacks = contact.impact ? -1e30 : lacking(contact.depth, reach);
    return Constraint(contact.normal, target, weights, lacks, with.meets ? with.material.y : -1.0);
}
