// A molecule that is stiffer than the step moves as a rigid body in contact with others, as it does in contact with colliders
// (fused/body.glsl): an impulse p at r from its centre of mass changes the velocity of its sphere at s by
// p / M + (I^-1 (r x p)) x s. Three texels of `bodies` a sphere: xyz its arm r, m, w 1 / M, 1/kg; xyz the diagonal of I^-1,
// 1/(kg m^2), w the turning; xyz what lies beside it (yz, xz, xy).
#include "physics/pair.glsl"
#pragma reads bodies

struct BodySphere {
    vec3 arm;
    float perMass;
    mat3 perInertia;
    float turning;  // 1/kg, how an impulse of 1 N s changes the sphere's velocity by turning the body, summed over three axes
};

const BodySphere noBody = BodySphere(vec3(0.0), 0.0, mat3(0.0), 0.0);  // of what gives way alone or not at all

struct BodyMotion {
    vec3 shift;  // of the centre of mass
    vec3 turn;
};

vec3 motionAt(BodySphere body, BodyMotion motion)
{
    return motion.shift + cross(motion.turn, body.arm);
}

// Returns the way of a motion that is not small, m, turned so that no body is stretched (Cayley's rotation).
vec3 wayAt(BodySphere body, BodyMotion motion)
{
    vec3 across = cross(motion.turn, body.arm);
    vec3 halfTurn = 0.5 * motion.turn;
    return motion.shift + (across + cross(halfTurn, across)) / (1.0 + dot(halfTurn, halfTurn));
}

// How a sphere's body is kept, in three 4-vectors.
vec4[3] packedBody(BodySphere body)
{
    mat3 t = body.perInertia;
    return vec4[3](vec4(body.arm, body.perMass), vec4(t[0][0], t[1][1], t[2][2], body.turning), vec4(t[1][2], t[0][2], t[0][1], 0.0));
}

BodySphere bodySphereAt(int sphere)
{
    vec4 arm = bodiesAt(sphere, 0);
    vec4 d = bodiesAt(sphere, 1);
    return BodySphere(arm.xyz, arm.w, symmetric(d.xyz, bodiesAt(sphere, 2).xyz), d.w);
}

// Adds how an impulse at a sphere changes the motion of its body.
void add(inout BodyMotion motion, BodySphere body, vec3 impulse)
{
    motion.shift += impulse * body.perMass;
    motion.turn += body.perInertia * cross(body.arm, impulse);
}
