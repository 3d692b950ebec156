// Springs and triangles around a vertex from the topology table, for a workgroup a molecule:
// what generated/forces.glsl writes out for a lane.
#define springPlace(i) x[i]
#define springVelocity(i) w[i]
#define springInverseMass(i) inverseMass[i]
#define surfacePlace(i) probe[i]
#include "step/gather_springs.glsl"
#include "step/gather_normal.glsl"

void springForces(float time)
{
    for (int i = 0; i < VERTICES; ++i) {
        force[i] = springForceOn(i, time);
    }
}

void surfaceNormals()
{
    for (int i = 0; i < VERTICES; ++i) {
        normal[i] = gatheredNormal(i);
    }
}
