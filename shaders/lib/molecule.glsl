// A molecule's vertex as the renderer sees it, fetched from the state textures. Layout: src/compile/plan.h.
// STATE_WIDTH is set by C++.

uniform sampler2D positions;  // xyz relative to the anchor, m
uniform sampler2D normals;    // xyz unit, or zero before the first frame
uniform sampler2D records;    // xyz anchor, m; w flags
uniform sampler2D constants;  // x seed, y scale
uniform ivec4 groupRows;      // first state row, rows of a vertex slab, first record row

// The origin of drawing (the eye, or the middle of the shadow map), as the lattice point below it and the rest.
// Anchors lie on the same lattice, so their difference is exact and a molecule 100 km out does not shake.
uniform vec3 originLattice;
uniform vec3 originRest;

ivec2 recordTexel(int molecule)
{
    return ivec2(molecule % STATE_WIDTH, groupRows.z + molecule / STATE_WIDTH);
}

ivec2 vertexTexel(int molecule, int vertex)
{
    return ivec2(molecule % STATE_WIDTH, groupRows.x + vertex * groupRows.y + molecule / STATE_WIDTH);
}

// m, relative to the origin of drawing, in the scene's directions.
vec3 vertexPlace(int molecule, int vertex)
{
    vec3 anchor = texelFetch(records, recordTexel(molecule), 0).xyz;
    vec3 position = texelFetch(positions, vertexTexel(molecule, vertex), 0).xyz;
    return (anchor - originLattice) + (position - originRest);
}

vec3 vertexNormal(int molecule, int vertex)
{
    return texelFetch(normals, vertexTexel(molecule, vertex), 0).xyz;
}

uint moleculeSeed(int molecule)
{
    return uint(texelFetch(constants, recordTexel(molecule), 0).x);
}
