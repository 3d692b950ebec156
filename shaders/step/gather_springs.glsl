// The springs around a vertex from the topology table, where they are not compiled in. Needs `scale`, `phase`, a vertex's
// springPlace (m), springVelocity (m/s) and springInverseMass (1/kg); where they steer, the shares of muscles in `waves`.
#include "state/topology.glsl"
#include "step/springs.glsl"

// Returns the force of all of them on the vertex, N; time: s since the frame's start, for muscles.
vec3 springForceOn(int vertex, float time)
{
    vec4 spans = table(topologyBase + vertex);
    int first = int(spans.x);
    int count = int(spans.y);
    vec3 place = springPlace(vertex);
    vec3 velocity = springVelocity(vertex);
    float own = springInverseMass(vertex);
    vec3 sum = vec3(0.0);
    for (int s = 0; s < count; ++s) {
        vec4 spring = table(first + 2 * s);
        int other = int(spring.x);
        float restLength = spring.w * scale;
#ifdef MUSCLES
        vec4 muscle = table(first + 2 * s + 1);
#ifdef STEERED
#ifdef WAVES
        restLength = bentLength(restLength, muscle.x * waves[int(muscle.y)], muscle.w * curvature);
#else
        restLength = bentLength(restLength, musclePull(muscle.xyz, 0.0, swimClock(time), phase), muscle.w * curvature);
#endif
#else
        float angle = muscleAngles[int(muscle.w) / 4][int(muscle.w) % 4];
        restLength = bentLength(restLength, musclePull(muscle.xyz, angle, time, phase), 0.0);
#endif
#endif
        sum += sprung(place - springPlace(other), velocity - springVelocity(other), spring.y, spring.z, restLength,
                      own + springInverseMass(other));
    }
    return sum;
}
