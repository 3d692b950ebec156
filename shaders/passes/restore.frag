// restore: the springs pull every vertex back into shape (Decker, section 3.4).
//   euler      v += h a, and verlet; a is kept for contact with colliders
//   leapfrog   a = F(x, v + a_old h/2) / m;  v += a h/2   (at the start of a frame only a, from v itself)
#include "passes/springs.glsl"

uniform float springTime;  // s since the frame's start
uniform float kickTime;    // s: h for euler and verlet, h/2 for leapfrog

#ifdef ACCELERATION
layout(location = 0) out vec4 newAcceleration;
layout(location = 1) out vec4 newVelocity;
#else
layout(location = 0) out vec4 newVelocity;
#endif

void main()
{
    ivec2 own = ownAddress();
    vec3 v = texelFetch(velocities, ivec2(gl_FragCoord.xy), 0).xyz;
    vec3 force = vec3(0.0);
    vec4 vertexInertia = inertia(own.x);
    if (!isPadding(own.y) && !isHeld(vertexInertia, own.y)) force = springForces(own.x, own.y, springTime);
    vec3 a = force * vertexInertia.x;
#ifdef ACCELERATION
    newAcceleration = vec4(a, 0.0);
#endif
#ifdef LEAPFROG
    v += a * kickTime;
#else
    v += springKick(force, vertexInertia.x, kickTime);
#endif
    newVelocity = vec4(v, 0.0);
}
