// The force of all springs around a vertex. Needs state/textures.glsl.
#include "state/textures.glsl"
#include "physics/spring.glsl"

uniform float stiffnessFactor;
uniform float dampingFactor;
uniform float springTime;   // s since the frame's start, for muscles
uniform float predictTime;  // s: leapfrog's force uses the velocity v + a h/2; 0 at the start of a frame

#ifdef MUSCLES
uniform vec4 muscleAngles[MUSCLES];  // rad, when the frame begins, four frequencies each
#endif
#ifdef VERLET
uniform float stepsSquared;  // 1/h^2, 1/s^2: a spring is a distance constraint, see solver/verlet.glsl
#endif

vec3 predictedVelocity(ivec2 texel)
{
    vec3 v = texelFetch(velocities, texel, 0).xyz;
#if defined(LEAPFROG) && defined(SPRINGS)
    // at a frame's start there is no acceleration yet, and what the texture holds may not be a number
    if (predictTime > 0.0) v += texelFetch(accelerations, texel, 0).xyz * predictTime;
#endif
    return v;
}

vec3 springForces(int vertex, int molecule)
{
    vec4 spans = table(topologyBase + vertex);
    ivec2 own = stateTexel(vertex, molecule);
    vec3 x = texelFetch(positions, own, 0).xyz;
#ifdef SPRING_DAMPING
    vec3 v = predictedVelocity(own);
#endif
    vec4 constant = texelFetch(constants, recordTexel(molecule), 0);
    vec3 force = vec3(0.0);
    int first = int(spans.x);
    int count = int(spans.y);
    for (int i = 0; i < count; ++i) {
        vec4 spring = table(first + 2 * i);
        ivec2 other = stateTexel(int(spring.x), molecule);
        vec3 relative = vec3(0.0);
#ifdef SPRING_DAMPING
        relative = v - predictedVelocity(other);
#endif
        float restLength = spring.w * constant.y;
#ifdef MUSCLES
        vec4 muscle = table(first + 2 * i + 1);
        int number = int(muscle.w);
        restLength = bentLength(restLength, muscle.x,
                                muscle.y * springTime + (muscle.z + muscleAngles[number / 4][number % 4]) + constant.z,
                                0.0);
#endif
        float stiffness = spring.y * stiffnessFactor;
#ifdef VERLET
        stiffness = min(stiffness, stepsSquared / (inertia(vertex).x + inertia(int(spring.x)).x));
#endif
        force += springForce(x - texelFetch(positions, other, 0).xyz, relative, stiffness, spring.z * dampingFactor,
                             restLength);
    }
    return force;
}
