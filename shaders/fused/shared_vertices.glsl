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
    int index = sharedIndex(array, 3 * vertex);
    return vec3(sharedNumbers[index], sharedNumbers[index + LANES], sharedNumbers[index + 2 * LANES]);
}

void setSharedVector(int array, int vertex, vec3 value)
{
    int index = sharedIndex(array, 3 * vertex);
    sharedNumbers[index] = value.x;
    sharedNumbers[index + LANES] = value.y;
    sharedNumbers[index + 2 * LANES] = value.z;
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
