// A lane's view of its molecule's other vertices, where lanes are spread over vertices: a workgroup has LANES
// molecules side by side and ROWS rows of lanes. The lanes of a row do the same vertex of neighbouring molecules, so that the
// topology is the same for all of them; row r takes the vertices r, r + ROWS, ... of MOLECULE_VERTICES, each in a register
// array of VERTICES places. Whatever others read of a vertex lies in shared memory: number 3 vertex + component of molecule m
// at
//
//   number * LANES + m
//
// so that a row touches neighbouring memory, once for PLACES and once, behind them, for VELOCITIES. Their contents change: a
// barrier goes before they are written, so that nobody still reads, and one after.
//
// Sums run over the springs and triangles in their order, as generated/forces.glsl writes them out for a lane a molecule: the
// bits are the same.
#include "sort/wait.glsl"

const int PLACES = 0;                                  // m, of the vertices or of the probes; unit, of normals
const int VELOCITIES = 4 * POSITION_ELEMENTS * LANES;  // m/s, behind the padding of the last 4-vector of places
shared float sharedNumbers[2 * VELOCITIES];

float inverseMass[VERTICES];  // 1/kg
bool pinned[VERTICES];

#include "state/topology.glsl"

// x 1/mass (1/kg), y pinned, z mass (kg), w share of the molecule's mass
vec4 inertia(int vertex)
{
    return table(topologyBase + MOLECULE_VERTICES + vertex);
}

int column()
{
    return int(gl_LocalInvocationID.x);
}

int row()
{
    return int(gl_LocalInvocationID.y);
}

// Returns the vertex in place i of the lane's row. Where the rows do not divide the vertices evenly, the last place of
// some rows repeats the last vertex.
int vertexOf(int i)
{
    return min(row() + i * ROWS, MOLECULE_VERTICES - 1);
}

bool isOwn(int i)
{
    return row() + i * ROWS < MOLECULE_VERTICES;
}

// `array`: PLACES or VELOCITIES.
int sharedIndex(int array, int number)
{
    return array + number * LANES + column();
}

vec3 sharedVector(int array, int vertex)
{
    int at = sharedIndex(array, 3 * vertex);
    return vec3(sharedNumbers[at], sharedNumbers[at + LANES], sharedNumbers[at + 2 * LANES]);
}

void setSharedVector(int array, int vertex, vec3 value)
{
    int at = sharedIndex(array, 3 * vertex);
    sharedNumbers[at] = value.x;
    sharedNumbers[at + LANES] = value.y;
    sharedNumbers[at + 2 * LANES] = value.z;
}

// The lane's own vertex i, if no other lane has it.
void share(int array, int i, vec3 value)
{
    if (isOwn(i)) setSharedVector(array, vertexOf(i), value);
}

void shareProbes()
{
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        share(PLACES, i, probe[i]);
    }
    waitForGroup();
}

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

#ifdef SPRINGS
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
#endif

// The area vectors of the triangles from `first` to `end`, each from its first corner, to where velocities were.
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

// Unit normals of the surface through the probes, from as many triangles at a time as there is room for.
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

// The largest of what the lanes of a molecule have, in all of them.
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

// N: the strongest pull of the springs on a pin.
float pullOnPins()
{
    float pull = 0.0;
#ifdef SPRINGS
    for (int i = 0; i < VERTICES; ++i) {
        if (pinned[i]) pull = max(pull, length(force[i]));
    }
    pull = largest(pull);
#endif
    return pull;
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
