// Impulses on the spheres of rigid bodies add up here to the motions of the bodies.
#include "contact/body.glsl"
#include "physics/pair.glsl"

// By sphere; zeros where its molecule is not a rigid body.
#ifdef TEXTURES
uniform sampler2DArray bodies;  // three layers
#define bodyTexel(sphere, k) texelFetch(bodies, ivec3(texelOf(sphere), k), 0)
#else
uniform samplerBuffer bodies;   // three texels a sphere
#define bodyTexel(sphere, k) texelFetch(bodies, 3 * (sphere) + (k))
#endif

BodySphere bodySphereAt(int sphere)
{
    vec4 arm = bodyTexel(sphere, 0);
    vec4 d = bodyTexel(sphere, 1);
    return BodySphere(arm.xyz, arm.w, symmetric(d.xyz, bodyTexel(sphere, 2).xyz), d.w);
}

void add(inout BodyMotion motion, BodySphere at, vec3 impulse)
{
    BodyMotion more = bodyMotion(at, impulse);
    motion.shift += more.shift;
    motion.turn += more.turn;
}
