// A molecule's vertex as the renderer sees it, fetched from the state of any path: buffers or, with LAYERED, layers of
// textures (both state/packed.glsl, whose sizes C++ sets, and LIFE where molecules are born and die) or, with TEXTURES and
// STATE_WIDTH, the textures of passes (src/simulate/texture_state.h).

// The origin of drawing (the eye, or the middle of the shadow map), as the lattice point below it and the rest.
// Anchors lie on the same lattice, so their difference is exact and a molecule 100 km out does not shake.
uniform vec3 originLattice;
uniform vec3 originRest;

#ifdef TEXTURES
uniform sampler2D positions;  // xyz relative to the anchor, m
uniform sampler2D velocities; // xyz m/s
uniform sampler2D normals;    // xyz unit, or zero before the first frame
uniform sampler2D records;    // xyz anchor, m; w flags
uniform sampler2D constants;  // x seed, y scale
uniform ivec4 groupRows;      // first state row, rows of a vertex slab, first record row

ivec2 recordTexel(int molecule)
{
    return ivec2(molecule % STATE_WIDTH, groupRows.z + molecule / STATE_WIDTH);
}

ivec2 vertexTexel(int molecule, int vertex)
{
    return ivec2(molecule % STATE_WIDTH, groupRows.x + vertex * groupRows.y + molecule / STATE_WIDTH);
}

vec3 moleculeAnchor(int molecule)
{
    return texelFetch(records, recordTexel(molecule), 0).xyz;
}

vec3 vertexPosition(int molecule, int vertex)
{
    return texelFetch(positions, vertexTexel(molecule, vertex), 0).xyz;
}

vec3 vertexVelocity(int molecule, int vertex)
{
    return texelFetch(velocities, vertexTexel(molecule, vertex), 0).xyz;
}

vec3 vertexNormal(int molecule, int vertex)
{
    return texelFetch(normals, vertexTexel(molecule, vertex), 0).xyz;
}

uint moleculeSeed(int molecule)
{
    return uint(texelFetch(constants, recordTexel(molecule), 0).x);
}

float moleculeScale(int molecule)
{
    return texelFetch(constants, recordTexel(molecule), 0).y;
}
#else
#include "state/packed.glsl"

uniform VALUES states;   // positions, then velocities, three floats a vertex without gaps
uniform VALUES normals;  // alike
uniform VALUES records;  // xyz anchor, m; w: 1 + seed, negative once the pins are released
uniform VALUES constants;  // x scale, where instances differ

vec3 moleculeAnchor(int molecule)
{
    return valueOf(records, molecule).xyz;
}

vec3 vertexPosition(int molecule, int vertex)
{
    return packedVertex(states, firstElement(molecule, STATE_ELEMENTS), 0, vertex);
}

vec3 vertexVelocity(int molecule, int vertex)
{
    return packedVertex(states, firstElement(molecule, STATE_ELEMENTS), POSITION_ELEMENTS, vertex);
}

vec2 storedLife(int molecule)
{
    return packedLife(states, firstElement(molecule, STATE_ELEMENTS));
}

vec3 vertexNormal(int molecule, int vertex)
{
    return packedVertex(normals, firstElement(molecule, POSITION_ELEMENTS), 0, vertex);
}

uint moleculeSeed(int molecule)
{
    return uint(abs(valueOf(records, molecule).w)) - 1u;
}

float moleculeScale(int molecule)
{
    return valueOf(constants, molecule).x;
}
#endif

// x age, y length of life, s: alive while age < life. Without LIFE always so.
vec2 moleculeLife(int molecule)
{
#ifdef LIFE
    return storedLife(molecule);
#else
    return vec2(0.0, 1.0);
#endif
}

bool isAlive(int molecule)
{
    vec2 life = moleculeLife(molecule);
    return life.x < life.y;
}

// m, relative to the origin of drawing, in the scene's directions.
vec3 vertexPlace(int molecule, int vertex)
{
    return (moleculeAnchor(molecule) - originLattice) + (vertexPosition(molecule, vertex) - originRest);
}
