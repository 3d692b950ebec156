// An impact, for strike.pass.glsl beside this file, and what it leaves.
#include "contact/response/choice.glsl"
#include "contact/response/molecule.glsl"

// Impacts of two molecules at the very same time: where they meet with a face or an edge, one after the other would turn them. They are
// one impact, in the middle between them: each pair has the same share of its impulse.
const int MOST_AT_ONCE = SPREADS ? 8 : 1;

struct Impact {
    int pairs;                    // how many
    ivec2 slots[MOST_AT_ONCE];    // x of the one molecule, y of the other
    uvec2 entries[MOST_AT_ONCE];  // of the other of the two in the list of each
    vec3 normal;                  // from y to x, unit in the end
    vec3 velocity;                // m/s, of x relative to y, the mean
    float since;                  // s, how long ago
    vec3 impulse;                 // N s, on all of x together
};

Choice choiceOf(int slot);  // as the pass knows it

// Whether the other of a slot's choice has chosen it as well; what nothing moves has no choice.
bool isMutual(int slot, Choice choice)
{
    int other = int(choice.other);
    return sphereAt(other).weight == 0.0 || choiceOf(other).other == uint(slot);
}

// Adds a pair, if it meets in much the same direction as those before.
void addPair(inout Impact all, int slot, uvec2 entries, int other)
{
    loadSphere(slot);
    Sphere sphere = sphereAt(other);
    PairImpact impact = impactOf(slot, other, sphere);
    if (dot(all.normal, impact.normal) < 0.9 * float(all.pairs)) return;
    if (all.pairs == 0) all.since = impact.since;
    all.slots[all.pairs] = ivec2(slot, other);
    all.entries[all.pairs] = entries;
    all.normal += impact.normal;
    all.velocity += own.velocity - sphere.velocity;
    ++all.pairs;
}

// Returns how an impulse, in equal shares on all pairs, changes the mean of their relative velocities, m/s.
vec3 gainBetween(Impact all, vec3 impulse)
{
    vec3 gained = vec3(0.0);
    for (int p = 0; p < all.pairs; ++p) {
        for (int q = 0; q < all.pairs; ++q) {
            gained += gainOf(all.slots[p].x, all.slots[q].x, impulse) + gainOf(all.slots[p].y, all.slots[q].y, impulse);
        }
    }
    return gained / float(all.pairs * all.pairs);
}

// Returns the impulse: first that along the normal, then what friction takes of the slip that is left. Neither adds energy, whatever else the
// two move.
vec3 impulseOf(Impact all, vec2 material)
{
    vec3 n = all.normal;
    vec3 u = all.velocity;
    float along = dot(u, n);
    vec3 gained = gainBetween(all, n);  // by 1 N s
    float push = -(1.0 + material.x) * min(along, 0.0) / dot(n, gained);
    u += push * gained;
    vec3 slip = u - n * dot(u, n);
    float speed = sqrt(dot(slip, slip));
    vec3 across = slip / max(speed, 1e-30);
    float stops = dot(across, gainBetween(all, across));  // 1/kg
    return n * push - across * min(material.y * push, speed / max(stops, 1e-30));
}

// Returns the impact that a slot and its choice have chosen, with all that are at the same time.
Impact impactAt(int slot, Choice choice)
{
    int other = int(choice.other);
    bool moves = sphereAt(other).weight > 0.0;  // or else nothing may move its molecule here
    Impact all;
    all.pairs = 0;
    all.normal = vec3(0.0);
    all.velocity = vec3(0.0);
    addPair(all, slot, uvec2(choice.entry, moves ? choiceOf(other).entry : 0u), other);
    vec2 material = materialOf(own, sphereAt(other));
    if (!SPREADS) {  // the same in less
        vec3 wanted = pairImpulse(all.velocity, all.normal, -material.x * dot(all.normal, all.velocity), vec3(0.0),
                                  vec2(own.weight + sphereAt(other).weight));
        all.impulse = withinFriction(wanted, all.normal, material.y);
        return all;
    }
    float same = restingOverlap * (own.radius + radiusAt(other));  // m
    uint label = placesAt(other).w;
    if (own.label != label) {
        Molecule molecule = moleculeOf(slot);
        for (int k = 0; k < molecule.spheres && all.pairs < MOST_AT_ONCE; ++k) {
            int beside = slotOfSphere(molecule, k);
            Choice next = choiceOf(beside);
            if (beside == slot || next.other == NOBODY || placesAt(int(next.other)).w != label) continue;
            if (abs(next.since - choice.since) * -choice.speed > same || !isMutual(beside, next)) continue;
            if (sphereAt(int(next.other)).weight > 0.0 != moves) continue;
            addPair(all, beside, uvec2(next.entry, moves ? choiceOf(int(next.other)).entry : 0u), int(next.other));
        }
    }
    all.normal = normalize(all.normal);
    all.velocity /= float(all.pairs);
    all.impulse = impulseOf(all, material);
    return all;
}

// All of a slot that an impact changes.
struct Struck {
    uvec4 place;
    uvec4 motion;
    uvec4[3] impacts;
};

Struck struckAs(int slot)
{
    Struck s = Struck(placesAt(slot), motionAt(slot), uvec4[3](NO_IMPACT, uvec4(0u), uvec4(0u)));
    if (!isFirst && isStruck(slot)) s.impacts = uvec4[3](impactsAt(slot, 0), impactsAt(slot, 1), impactsAt(slot, 2));
    return s;
}

// Returns a slot after an impact: since then it moves as if it had always had the velocity that it has now.
Struck struckBy(int slot, Impact all)
{
    Struck s = struckAs(slot);
    vec3 share = all.impulse / float(all.pairs);
    vec3 gained = vec3(0.0);
    int hit = -1;
    for (int p = 0; p < all.pairs; ++p) {
        gained += gainOf(slot, all.slots[p].x, share) - gainOf(slot, all.slots[p].y, share);
        if (slot == all.slots[p].x || slot == all.slots[p].y) hit = p;
    }
    if (hit < 0 && gained == vec3(0.0)) return s;
    s.place.xyz = floatBitsToUint(uintBitsToFloat(s.place.xyz) + gained * all.since);
    s.motion.xyz = floatBitsToUint(uintBitsToFloat(s.motion.xyz) + gained);
    s.impacts[0].w = floatBitsToUint(all.since);
    s.impacts[1].w = NOBODY;
    if (hit < 0) return s;
    bool isX = slot == all.slots[hit].x;
    vec3 own = isX ? share : -share;
    uint e = isX ? all.entries[hit].x : all.entries[hit].y;
    s.impacts[0].xyz = floatBitsToUint(uintBitsToFloat(s.impacts[0].xyz) + own);
    s.impacts[1].xyz = floatBitsToUint(uintBitsToFloat(s.impacts[1].xyz) + own * all.since);
    if (all.pairs == 1) s.impacts[1].w = uint(isX ? all.slots[hit].y : all.slots[hit].x);
    s.impacts[2][e >> 5u] |= 1u << (e & 31u);
    return s;
}
