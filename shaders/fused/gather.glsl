// What a lane needs of its molecule's other vertices, where lanes are spread over vertices: a workgroup has LANES
// molecules side by side and ROWS rows of lanes. The lanes of a row do the same vertex of neighbouring molecules, so that the
// topology is the same for all of them; row r takes the vertices r, r + ROWS, ... of MOLECULE_VERTICES, each in a register
// array of VERTICES places. What others read of a vertex lies in shared memory: number 3 vertex + component of molecule m at
//
//   number * LANES + m
//
// so that a row touches neighbouring memory. There are two such arrays, for positions and velocities, and what they hold
// changes: a barrier goes before they are written, so that nobody still reads, and one after.
//
// Sums run over the springs and triangles in their order, as generated/forces.glsl writes them out for a lane a molecule: the
// bits are the same.
#include "sort/wait.glsl"

const int numbers = 4 * POSITION_ELEMENTS;  // of a molecule, with the padding of the last 4-vector
shared float places[numbers * LANES];      // m, of the vertices or of the probes; unit, of normals
shared float velocities[numbers * LANES];  // m/s

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

// Where the vertices are no multiple of the rows, the last place of some rows does what another row does as well.
int vertexOf(int i)
{
    return min(row() + i * ROWS, MOLECULE_VERTICES - 1);
}

bool isOwn(int i)
{
    return row() + i * ROWS < MOLECULE_VERTICES;
}

int sharedIndex(int vertex)
{
    return 3 * vertex * LANES + column();
}

vec3 placeOf(int vertex)
{
    int at = sharedIndex(vertex);
    return vec3(places[at], places[at + LANES], places[at + 2 * LANES]);
}

vec3 velocityOf(int vertex)
{
    int at = sharedIndex(vertex);
    return vec3(velocities[at], velocities[at + LANES], velocities[at + 2 * LANES]);
}

void sharePlace(int i, vec3 place)
{
    if (!isOwn(i)) return;
    int at = sharedIndex(vertexOf(i));
    places[at] = place.x;
    places[at + LANES] = place.y;
    places[at + 2 * LANES] = place.z;
}

void shareVelocity(int i, vec3 velocity)
{
    if (!isOwn(i)) return;
    int at = sharedIndex(vertexOf(i));
    velocities[at] = velocity.x;
    velocities[at + LANES] = velocity.y;
    velocities[at + 2 * LANES] = velocity.z;
}

void shareProbes()
{
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        sharePlace(i, probe[i]);
    }
    waitForGroup();
}

#define springPlace(vertex) placeOf(vertex)
#define springVelocity(vertex) velocityOf(vertex)
#define surfacePlace(vertex) placeOf(vertex)
#define springInverseMass(vertex) inertia(vertex).x
#include "step/gather_springs.glsl"
#include "step/gather_normal.glsl"

void loadInertia()
{
    for (int i = 0; i < VERTICES; ++i) {
        vec4 own = inertia(vertexOf(i));
        inverseMass[i] = own.x;
        pinned[i] = own.y > 0.5;
    }
}

#ifdef SPRINGS
// Of all springs, on all vertices, from x and w; time for the muscles.
void springForces(float time)
{
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        sharePlace(i, x[i]);
        shareVelocity(i, w[i]);
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

// Unit normals of the surface through the probes.
void surfaceNormals()
{
    shareProbes();
    for (int i = 0; i < VERTICES; ++i) {
        normal[i] = gatheredNormal(vertexOf(i));
    }
}

// The largest of what the lanes of a molecule have, in all of them.
float largest(float value)
{
    waitForGroup();
    velocities[row() * LANES + column()] = value;
    waitForGroup();
    float most = velocities[column()];
    for (int r = 1; r < ROWS; ++r) most = max(most, velocities[r * LANES + column()]);
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

// Of vertex 0, m.
vec3 firstPlace()
{
    waitForGroup();
    if (row() == 0) sharePlace(0, x[0]);
    waitForGroup();
    return placeOf(0);
}

vec3 meanProbe()
{
    shareProbes();
    vec3 sum = placeOf(0);
    for (int vertex = 1; vertex < MOLECULE_VERTICES; ++vertex) sum += placeOf(vertex);
    return sum * (1.0 / float(MOLECULE_VERTICES));
}

// Of w, by mass.
vec3 meanVelocity()
{
    waitForGroup();
    for (int i = 0; i < VERTICES; ++i) {
        shareVelocity(i, w[i]);
    }
    waitForGroup();
    vec3 sum = vec3(0.0);
    for (int vertex = 0; vertex < MOLECULE_VERTICES; ++vertex) sum += velocityOf(vertex) * inertia(vertex).w;
    return sum;
}

// Of the probes, by mass.
vec3 steeredMiddle()
{
    shareProbes();
    vec3 sum = vec3(0.0);
    for (int vertex = 0; vertex < MOLECULE_VERTICES; ++vertex) sum += placeOf(vertex) * inertia(vertex).w;
    return sum;
}
