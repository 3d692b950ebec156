// Impulses on the spheres of rigid bodies add up here to the motions of the bodies.
#include "contact/body.glsl"

#ifdef TEXTURES
uniform sampler2DArray bodies;  // by sphere, three layers
#define bodyTexel(sphere, k) texelFetch(bodies, ivec3(texelOf(sphere), k), 0)
#else
uniform samplerBuffer bodies;   // three texels a sphere
#define bodyTexel(sphere, k) texelFetch(bodies, 3 * (sphere) + (k))
#endif

BodySphere bodySphereAt(int sphere)
{
    vec4 arm = bodyTexel(sphere, 0);
    vec4 d = bodyTexel(sphere, 1);
    vec3 o = bodyTexel(sphere, 2).xyz;
    return BodySphere(arm.xyz, arm.w, mat3(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z), d.w);
}

void add(inout BodyMotion motion, BodySphere at, vec3 impulse)
{
    BodyMotion more = bodyMotion(at, impulse);
    motion.shift += more.shift;
    motion.turn += more.turn;
}
