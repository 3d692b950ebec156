// Where a molecule's data lies in the state textures. The layout is stated in src/simulate/texture_state.h.
#include "state/topology.glsl"

uniform sampler2D positions;
uniform sampler2D velocities;
uniform sampler2D accelerations;
uniform sampler2D records;
uniform sampler2D constants;
uniform int firstRow;
uniform int slabRows;
uniform int moleculeCount;
uniform int vertexCount;
uniform int firstRecordRow;

ivec2 stateTexel(int vertex, int molecule)
{
    return ivec2(molecule & 1023, firstRow + vertex * slabRows + (molecule >> 10));
}

ivec2 recordTexel(int molecule)
{
    return ivec2(molecule & 1023, firstRecordRow + (molecule >> 10));
}

// x vertex, y molecule of the texel that a state pass writes.
ivec2 ownAddress()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    int row = texel.y - firstRow;
    int vertex = row / slabRows;
    return ivec2(vertex, (row - vertex * slabRows) * 1024 + texel.x);
}

// Texels beyond the last molecule fill up the rows.
bool isPadding(int molecule)
{
    return molecule >= moleculeCount;
}

// Returns the velocity of a texel, m/s, after leapfrog's kick by the springs over a time, s.
vec3 kickedVelocity(ivec2 texel, float time)
{
    vec3 v = texelFetch(velocities, texel, 0).xyz;
#if defined(LEAPFROG) && defined(SPRINGS)
    // at a frame's start there is no acceleration yet, and what the texture holds may not be a number
    if (time > 0.0) v += texelFetch(accelerations, texel, 0).xyz * time;
#endif
    return v;
}

// x 1/mass, y pinned, z mass
vec4 inertia(int vertex)
{
    return table(topologyBase + vertexCount + vertex);
}

// Whether a pin holds the vertex and has not been released.
bool isHeld(vec4 vertexInertia, int molecule)
{
    return PINS && vertexInertia.y > 0.5 && (!RELEASE || texelFetch(records, recordTexel(molecule), 0).w < 0.5);
}
