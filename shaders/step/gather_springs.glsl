// The springs around a vertex from the topology table, where they are not compiled in. Needs `scale`, `phase`, a vertex's
// springPlace (m), springVelocity (m/s) and springInverseMass (1/kg); where they steer, the shares of muscles in `waves`.
#include "state/topology.glsl"
#include "step/springs.glsl"

// A vertex, as springs see it.
struct SpringEnd {
    vec3 place;         // m
    vec3 velocity;      // m/s
    float inverseMass;  // 1/kg
};

// Returns the rest length of the spring at `entry` of the table, m; drawn: as the table has it, m; time: s since the frame's
// start, for muscles.
float tableRestLength(int entry, float drawn, float time)
{
    float restLength = drawn * scale;
#ifdef MUSCLES
    vec4 muscle = table(entry + 1);
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
    return restLength;
}

// Returns the force of the spring at `entry` of the table, N.
vec3 tableSpringForce(int entry, SpringEnd own, float time)
{
    vec4 spring = table(entry);
    int other = int(spring.x);
    float restLength = tableRestLength(entry, spring.w, time);
    return sprung(own.place - springPlace(other), own.velocity - springVelocity(other), spring.y, spring.z, restLength,
                  own.inverseMass + springInverseMass(other));
}

// Returns the force of all of them on the vertex, N.
vec3 springForceOn(int vertex, float time)
{
    vec4 spans = table(topologyBase + vertex);
    int entry = int(spans.x);
    int end = entry + 2 * int(spans.y);
    SpringEnd own = SpringEnd(springPlace(vertex), springVelocity(vertex), springInverseMass(vertex));
    vec3 sum = vec3(0.0);
#ifdef ROWS
    // two at a time: a GPU waits once for what both read
    for (; entry + 2 < end; entry += 4) {
        vec3 first = tableSpringForce(entry, own, time);
        vec3 second = tableSpringForce(entry + 2, own, time);
        sum = sum + first + second;
    }
#endif
    for (; entry < end; entry += 2) sum += tableSpringForce(entry, own, time);
    return sum;
}
