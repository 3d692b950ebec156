// Forces, normals and means from a molecule's other vertices (fused/shared_vertices.glsl).
//
// Sums run over the springs and triangles in their order, as generated/forces.glsl writes them out for a lane a molecule: the
// bits are the same.
#include "fused/shared_vertices.glsl"

#define springPlace(vertex) sharedVector(PLACES, vertex)
#define springVelocity(vertex) sharedVector(VELOCITIES, vertex)
#define springInverseMass(vertex) inertia(vertex).x
#include "step/gather_springs.glsl"
#include "physics/normal.glsl"

void loadInertia()
{
    for (int i = 0; i < VERTICES; ++i) {
        vec4 own = inertia(vertexOf(i));
        inverseMass[i] = own.x;
        pinned[i] = own.y > 0.5;
    }
}

// Adds up all springs on all vertices, from x and w; time for the muscles.
void springForces(float time)
{
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        share(PLACES, i, x[i]);
        share(VELOCITIES, i, w[i]);
    }
    waitForGroup();
#ifdef WAVES
    moveMuscles(time);
#endif
    for (int i = 0; i < VERTICES; ++i) {
        force[i] = springForceOn(vertexOf(i), time);
    }
}

// Shares the area vectors of the triangles from `first` to `end`, each from its first corner, in the place of the velocities.
void shareAreas(int first, int end)
{
    waitForGroup();
    for (int t = first + row(); t < end; t += ROWS) {
        vec4 corners = table(topologyBase + 2 * MOLECULE_VERTICES + t);
        vec3 place = sharedVector(PLACES, int(corners.x));
        vec3 next = sharedVector(PLACES, int(corners.y));
        vec3 last = sharedVector(PLACES, int(corners.z));
        setSharedVector(VELOCITIES, t - first, areaVector(next - place, last - place));
    }
    waitForGroup();
}

// Adds those of the areas from triangle `first` to `end` that lie around a vertex. Its triangles are in the table from
// `fan`.x, which moves past them, to `fan`.y.
void addAreas(inout vec3 sum, inout ivec2 fan, int first, int end)
{
    while (fan.x < fan.y) {
        int t = int(table(fan.x).w);
        if (t >= end) break;
        sum += sharedVector(VELOCITIES, t - first);
        ++fan.x;
    }
}

ivec2 fans[VERTICES];

// Finds unit normals of the surface through the probes, from as many triangles at a time as there is room for.
void surfaceNormals()
{
    shareProbes();
    for (int i = 0; i < VERTICES; ++i) {
        vec4 spans = table(topologyBase + vertexOf(i));
        fans[i] = ivec2(spans.z, spans.z + spans.w);
        normal[i] = vec3(0.0);
    }
    for (int first = 0; first < TRIANGLES; first += MOLECULE_VERTICES) {
        int end = min(first + MOLECULE_VERTICES, TRIANGLES);
        shareAreas(first, end);
        for (int i = 0; i < VERTICES; ++i) {
            addAreas(normal[i], fans[i], first, end);
        }
    }
    for (int i = 0; i < VERTICES; ++i) {
        if (table(topologyBase + vertexOf(i)).w > 0.0) normal[i] = unitNormal(normal[i]);
    }
}

// Returns to all lanes of a molecule the largest of their values.
float largest(float value)
{
    waitForGroup();
    sharedNumbers[sharedIndex(VELOCITIES, row())] = value;
    waitForGroup();
    float most = sharedNumbers[sharedIndex(VELOCITIES, 0)];
    for (int r = 1; r < ROWS; ++r) most = max(most, sharedNumbers[sharedIndex(VELOCITIES, r)]);
    return most;
}

bool anyLane(bool value)
{
    return largest(value ? 1.0 : 0.0) > 0.5;
}

// Returns the strongest pull of the springs on a pin, N.
float pullOnPins()
{
    float pull = 0.0;
    if (!SPRINGS) return pull;
    for (int i = 0; i < VERTICES; ++i) {
        if (pinned[i]) pull = max(pull, length(force[i]));
    }
    return largest(pull);
}

// The position of vertex 0, m.
vec3 firstPlace()
{
    waitForGroup();
    if (row() == 0) share(PLACES, 0, x[0]);
    waitForGroup();
    return sharedVector(PLACES, 0);
}

vec3 meanProbe()
{
    shareProbes();
    vec3 sum = sharedVector(PLACES, 0);
    for (int vertex = 1; vertex < MOLECULE_VERTICES; ++vertex) sum += sharedVector(PLACES, vertex);
    return sum * (1.0 / float(MOLECULE_VERTICES));
}

// The mean of w by mass.
vec3 meanVelocity()
{
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        share(VELOCITIES, i, w[i]);
    }
    waitForGroup();
    vec3 sum = vec3(0.0);
    for (int vertex = 0; vertex < MOLECULE_VERTICES; ++vertex) sum += sharedVector(VELOCITIES, vertex) * inertia(vertex).w;
    return sum;
}

// The mean of the probes by mass.
vec3 steeredMiddle()
{
    shareProbes();
    vec3 sum = vec3(0.0);
    for (int vertex = 0; vertex < MOLECULE_VERTICES; ++vertex) sum += sharedVector(PLACES, vertex) * inertia(vertex).w;
    return sum;
}
