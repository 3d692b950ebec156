// Springs and triangles around a vertex from the topology table, for a workgroup a molecule:
// what generated/molecule.glsl writes out for a lane.
#include "physics/normal.glsl"
#include "physics/spring.glsl"
#include "state/topology.glsl"

void springForces(float time)
{
    for (int i = 0; i < VERTICES; ++i) {
        vec4 spans = table(topologyBase + i);
        int springs = int(spans.y);
        vec3 sum = vec3(0.0);
        for (int s = 0; s < springs; ++s) {
            vec4 spring = table(int(spans.x) + 2 * s);
            int other = int(spring.x);
            float restLength = spring.w * scale;
#ifdef MUSCLES
            vec4 muscle = table(int(spans.x) + 2 * s + 1);
#ifdef STEERED
            restLength =
                bentLength(restLength, muscle.x, muscle.y * swimClock(time) + muscle.z + phase, muscle.w * curvature);
#else
            int number = int(muscle.w);
            restLength = bentLength(restLength, muscle.x,
                                    muscle.y * time + (muscle.z + muscleAngles[number / 4][number % 4]) + phase, 0.0);
#endif
#endif
            float stiffness = spring.y * stiffnessFactor;
#ifdef VERLET
            stiffness = min(stiffness, 1.0 / ((inverseMass[i] + inverseMass[other]) * (substep * substep)));
#endif
            sum += springForce(x[i] - x[other], w[i] - w[other], stiffness, spring.z * dampingFactor, restLength);
        }
        force[i] = sum;
    }
}

void surfaceNormals()
{
    for (int i = 0; i < VERTICES; ++i) {
        vec4 spans = table(topologyBase + i);
        int triangles = int(spans.w);
        vec3 sum = vec3(0.0);
        for (int t = 0; t < triangles; ++t) {
            vec4 corners = table(int(spans.z) + t);
            sum += areaVector(probe[int(corners.x)] - probe[i], probe[int(corners.y)] - probe[i]);
        }
        normal[i] = unitNormal(sum, triangles > 0 ? vec3(0.0, 1.0, 0.0) : vec3(0.0));
    }
}
