// A lane a slot in contact: contact/prepare.glsl, the sums of what its contacts remember, and the effective number of them.
#include "contact/touching.glsl"
#include "contact/prepare.glsl"
#ifdef WALLS
#include "contact/walls.glsl"

layout(std430, binding = 7) buffer WallPushes { vec4 wallPushes[]; };
layout(std430, binding = 10) buffer WallNormals { vec4 wallNormals[]; };  // by sphere, as an entry's push and anchor
#endif

layout(std430, binding = 0) writeonly buffer Impulses { vec4 newImpulses[]; };  // N s
layout(std430, binding = 1) writeonly buffer Pushes { vec4 pushes[]; };
layout(std430, binding = 2) writeonly buffer Anchors { vec4 anchors[]; };
layout(std430, binding = 3) writeonly buffer Known { vec4 newKnown[]; };
#ifdef SPREAD
layout(std430, binding = 4) writeonly buffer Normals { vec4 normals[]; };       // two a slot: contact/effective_sum.glsl
#else
layout(std430, binding = 4) writeonly buffer EffectiveCounts { uint effectiveCounts[]; };
#endif

layout(std430, binding = 9) writeonly buffer Parts { vec2 parts[]; };
layout(std430, binding = 8) writeonly buffer Shifts { vec4 newShifts[]; };

void main()
{
    int slot = touchingSlot();
    if (slot < 0) return;
    loadSphere(slot);
    loadOld(slot);
    int listed = listedOf(slot);
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    float turning = 0.0;
    vec3 impulse = vec3(0.0);
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Meeting with;
        Entry known = prepare(slot, other, with);
        if (with.meets) {
            float part = turningPart(with.contact.normal);
            sum = withNormal(sum, with.contact.normal * sqrt(1.0 - part));
            turning += part;
        }
        impulse += known.push.xyz;
        pushes[e * listStride + slot] = known.push;
        anchors[e * listStride + slot] = known.anchor;
        parts[e * listStride + slot] = vec2(0.0);
    }
#ifdef WALLS
    int first = 6 * sphereOf(slot);
    vec3 old[MOST_WALLS];
    vec3 oldNormal[MOST_WALLS];
    for (int k = 0; k < MOST_WALLS; ++k) {
        old[k] = oldListed > 0 ? wallPushes[first + 2 * k].xyz : vec3(0.0);
        oldNormal[k] = wallNormals[3 * sphereOf(slot) + k].xyz;
    }
    for (int k = 0; k < MOST_WALLS; ++k) {
        Wall wall = wallOf(slot, k);
        bool is = isNear(wall) && own.weight > 0.0;
        vec3 push = vec3(0.0);
        for (int o = 0; o < MOST_WALLS; ++o) push = is && dot(oldNormal[o], wall.normal) > 0.9 ? old[o] : push;
        push = withinFriction(push, wall.normal, wall.friction);
        wallPushes[first + 2 * k] = vec4(push, 0.0);
        wallPushes[first + 2 * k + 1] = vec4(push, 0.0);
        wallNormals[3 * sphereOf(slot) + k] = vec4(is ? wall.normal : vec3(0.0), 0.0);
        impulse += push;
        if (is) {
            float part = turningPart(wall.normal);
            sum = withNormal(sum, wall.normal * sqrt(1.0 - part));
            turning += part;
        }
    }
#endif
    vec3 acted = oldListed > 0 ? fetch(oldKnown, oldSlot).xyz : vec3(0.0);
    newShifts[slot] = vec4(0.0);
    newImpulses[slot] = vec4(impulse - acted, 0.0);
    newKnown[slot] = vec4(acted, 0.0);
#ifdef SPREAD
    normals[2 * slot] = vec4(sum.diagonal, turning);
    normals[2 * slot + 1] = vec4(sum.beside, 0.0);
#else
    effectiveCounts[slot] = floatBitsToUint(largestEigenvalue(sum));
#endif
}
