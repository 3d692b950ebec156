// Where a vertex is drawn: with GROWS, of a molecule that grows out of its first vertex at birth and shrinks into it
// before its end. Needs state/molecule.glsl.
#ifdef GROWS
uniform vec2 growTimes;  // s, above 0: after birth, before the end

vec3 drawnPlace(int molecule, int vertex)
{
    vec2 life = moleculeLife(molecule);
    float size = clamp(life.x / growTimes.x, 0.0, 1.0) * clamp((life.y - life.x) / growTimes.y, 0.0, 1.0);
    return mix(vertexPlace(molecule, 0), vertexPlace(molecule, vertex), size);
}
#else
vec3 drawnPlace(int molecule, int vertex)
{
    return vertexPlace(molecule, vertex);
}
#endif
