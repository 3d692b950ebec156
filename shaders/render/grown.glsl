// Where a vertex is drawn: with GROWS, of a molecule that grows out of its first vertex at birth and shrinks into it
// before its end.
#include "state/molecule.glsl"
#ifdef GROWS
#include "render/looks.glsl"

uniform vec2 growTimes;  // s, above 0: after birth, before the end

vec3 drawnPlace(int molecule, int vertex)
{
    float size = grownShare(moleculeLife(molecule), growTimes);
    return mix(vertexPlace(molecule, 0), vertexPlace(molecule, vertex), size);
}
#else
vec3 drawnPlace(int molecule, int vertex)
{
    return vertexPlace(molecule, vertex);
}
#endif
