// The last stage of contact/response/pair.glsl: how far the contacts move the spheres, and what they remember for the next step.
#pragma updates colliderImpulses
#pragma reads totals
#pragma writes totals when buffers
#include "contact/grid/colliders.glsl"
#include "contact/response/pair.glsl"
#include "contact/response/hits.glsl"
#pragma reads impulses anchors
#pragma writes warmStart partners keptImpulses keptAnchors oldNormals impactGroups
#pragma writes nextTotals when textures

// Returns how far a contact moves the sphere beside what pushes it apart, kg m: what
// sticks back towards where it began to. `kept`: the contact's impulse as the next step begins with it.
vec3 store(int slot, int other, ContactImpulse known, out ContactImpulse kept)
{
    Pair pair = pairAs(slot, other, known);
    vec3 n = pair.contact.normal;
    kept = remembered(known, pair.sphere);
    if (!pair.meets) return vec3(0.0);
    vec2 effective = vec2(effectiveCountOf(slot, own), effectiveCountOf(other, pair.sphere));
    vec3 slip = pair.apart - known.anchor;
    slip -= n * dot(slip, n);
    float most = 0.002 * (own.radius + pair.sphere.radius);
    float back = min(1.0, most / max(length(slip), 1e-30)) / weightsBetween(pair, n, effective).y;
    return known.sticks ? -slip * back : vec3(0.0);
}

// Whether the vertices of its molecule move against one another.
bool isSoft()
{
    return materialsAt(int(own.label >> 26u) * groupCount).z > 0.0;
}

// Returns what acts on the sphere over the next step, N s: what has acted over this one, with a tenth of what was missing, and not much more
// than a weight. So it is in balance where the impulses are, on a rigid body as a whole, too. `sum`: of the impulses, N s.
vec3 followed(vec3 sum, vec3 missing)
{
    vec3 next = sum - 0.9 * missing;
    float most = 1.5 * length(sum - missing) + restSpeed / max(own.weight, 1e-30);
    return next * min(1.0, most / max(length(next), 1e-30));
}

// Returns the same for a soft molecule, to which what follows late gives energy: what its contacts remember, `kept`, but no further
// from the sum than that is long. Where some have grown and others not, what they remember is not in balance, and would throw what is light.
vec3 nearSum(vec3 sum, vec3 kept)
{
    vec3 off = kept - sum;
    return sum + off * min(1.0, length(sum) / max(length(off), 1e-30));
}

void main()
{
    int slot = ownSlot(count);
    if (slot < 0) return;
    if (ownNumber() == 0) {  // nobody is listed for the next step
        putImpactGroups(0, 0, 0u);
        putImpactGroups(0, 3, 0u);
        putImpactGroups(0, 4, 0u);
    }
    loadSphere(slot);
    int sphere = sphereOf(slot);
    int row = ownRow(slot);
    int listed = listedOf(slot);
    vec4 total = totalsAt(row, 0);
    vec3 missing = total.xyz;
    vec3 shift = totalsAt(row, 1).xyz;
    vec3 sum = vec3(0.0);    // of its impulses, N s
    vec3 keeps = vec3(0.0);  // as they are remembered
    float part = 1.0;  // of what colliders push, with which the next step begins
    bool isHeld = false;
    for (int e = 0; e < listed; ++e) {
        int other = int(listsAt(slot, e));
        ContactImpulse known = impulseFrom(impulsesAt(row, e), anchorsAt(row, e));
        ContactImpulse kept;
        shift += store(slot, other, known, kept);
        sum += known.impulse;
        keeps += kept.impulse;
        putPartners(sphere, e, uint(sphereOf(other)));
        putKeptImpulses(sphere, e, firstPart(kept));
        putKeptAnchors(sphere, e, secondPart(kept));
    }
    if (COLLIDERS) {
        int memory = memoryRow(slot);
        float pushed = 0.0;  // N s, the sum of their impulses' lengths
        for (int k = 0; k < MOST_COLLIDERS; ++k) pushed += length(colliderImpulsesAt(memory, k).xyz);
        part = own.weight > 0.0 ? min(1.0, mostRemembered(total.w, pushed, own.weight) / max(pushed, 1e-30)) : 0.0;
        for (int k = 0; k < MOST_COLLIDERS; ++k) {
            vec4 push = colliderImpulsesAt(memory, k);
            sum += push.xyz;
            push.xyz *= part;
            keeps += push.xyz;
            isHeld = isHeld || push != vec4(0.0);
            putColliderImpulses(memory, k, push);
            putOldNormals(memory, k, vec4(colliderNear(sphere, k).normal, 0.0));
        }
    }
    // where many overlap the outermost would move as fast as all pairs together; what moves others is not pushed alone
    if (!SPREADS) shift *= min(1.0, pushSpeed * stepTime / max(length(shift) * own.weight, 1e-30));
    if (isStruck(slot)) {
        total.xyz += uintBitsToFloat(impactsAt(slot, 0).xyz);
        shift += uintBitsToFloat(impactsAt(slot, 1).xyz);
    }
    putTotals(row, 0, vec4(total.xyz, 0.0));
    putTotals(row, 1, vec4(shift, 0.0));
    putNextTotals(row, 0, vec4(total.xyz, 0.0));
    putNextTotals(row, 1, vec4(shift, 0.0));
    vec3 acts = isSoft() ? nearSum(sum, keeps) : followed(sum, missing);
    if (listed == 0 && !isHeld) acts = vec3(0.0);
    putWarmStart(memoryRow(slot), vec4(acts, inTextures ? part : asMemory(uint(listed) | (isHeld ? HELD : 0u))));
}
