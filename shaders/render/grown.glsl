// Where a vertex is drawn. Set by C++, true or false: GROWS, a molecule grows out of its first vertex at birth and shrinks
// into it before its end.
#include "state/molecule.glsl"
#include "render/looks.glsl"

uniform vec2 growTimes;  // s, above 0: after birth, before the end

vec3 drawnPlace(int molecule, int vertex)
{
    if (!GROWS) return vertexPlace(molecule, vertex);
    float size = grownShare(moleculeLife(molecule), growTimes);
    return mix(vertexPlace(molecule, 0), vertexPlace(molecule, vertex), size);
}
