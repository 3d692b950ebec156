// What impulses on the spheres of rigid bodies do.
#include "contact/body.glsl"

uniform FLOATS bodies;  // three texels a sphere

BodySphere bodySphereAt(int sphere)
{
    vec4 arm = fetch(bodies, 3 * sphere);
    vec3 d = fetch(bodies, 3 * sphere + 1).xyz;
    vec3 o = fetch(bodies, 3 * sphere + 2).xyz;
    return BodySphere(arm.xyz, arm.w, mat3(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z));
}

void add(inout BodyMotion motion, BodySphere at, vec3 impulse)
{
    BodyMotion more = bodyMotion(at, impulse);
    motion.shift += more.shift;
    motion.turn += more.turn;
}
