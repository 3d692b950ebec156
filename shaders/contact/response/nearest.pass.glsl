// UberFlow's response (section 4.5). Of all that touch only the nearest counts; both are backed up in time to
// their first contact, exchange the impulse there, and move on. The nearest of one need not have it for its
// nearest: where three touch, momentum is lost or gained.
#include "contact/response/pair.glsl"
#pragma writes totals

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    Sphere own = sphereAt(slot);
    int nearest = slot;
    float least = 1e30;
    for (int e = 0; e < listedOf(slot); ++e) {
        int other = int(listsAt(slot, e));
        vec3 apart = localDifference(own.place, placeAt(other), cell);
        bool nearer = dot(apart, apart) < least;
        nearest = nearer ? other : nearest;
        least = min(least, dot(apart, apart));
    }
    Sphere other = sphereAt(nearest);
    vec3 u = own.velocity - other.velocity;
    float w = own.weight + other.weight;
    PairContact contact = pairContact(localDifference(own.place, other.place, cell), u, own.radius + other.radius, stepTime,
                                      restSpeed, slot < nearest ? 1.0 : -1.0);
    vec2 material = materialOf(own, other);
    float target = contact.impact ? -material.x * contact.speed : max(contact.speed, 0.0);
    vec3 impulse = w > 0.0 ? pairImpulse(u, contact.normal, target, vec3(0.0), vec2(w)) : vec3(0.0);
    impulse = withinFriction(impulse, contact.normal, material.y);
    vec3 apart = contact.normal * (w > 0.0 ? contact.depth / w : 0.0);
    putTotals(slot, 0, vec4(impulse, 0.0));
    putTotals(slot, 1, vec4(contact.impact ? impulse * contact.since : apart, 0.0));
}
