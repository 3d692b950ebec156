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
    vec3 d = localDifference(own.place, other.place, cell);
    float reach = own.radius + other.radius;
    PairContact contact = pairContact(parted(d, reach, slot, nearest), u, reach);
    PairImpact impact = nextImpact(d, u, reach, stepTime, restSpeed);
    vec2 material = materialOf(own, other);
    vec3 n = impact.happens ? impact.normal : contact.normal;
    float target = impact.happens ? -material.x * impact.speed : max(contact.speed, 0.0);
    vec3 impulse = w > 0.0 ? pairImpulse(u, n, target, vec3(0.0), vec2(w)) : vec3(0.0);
    impulse = withinFriction(impulse, n, material.y);
    vec3 apart = n * (w > 0.0 ? contact.depth / w : 0.0);
    putTotals(ownRow(slot), 0, vec4(impulse, 0.0));
    putTotals(ownRow(slot), 1, vec4(impact.happens ? impulse * impact.since : apart, 0.0));
}
