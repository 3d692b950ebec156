// With spheres on triangles: the velocity that the impulses so far make of a sphere's. Needs contact/shape.glsl.
uniform UINTS slots;      // of a sphere
uniform UINTS counts;
uniform FLOATS impulses;  // as in contact/respond.glsl
uniform FLOATS earlier;
uniform float momentum;
uniform VALUES oldRecords;

vec3 impulseAt(int sphere)
{
    int slot = int(fetch(slots, sphere).x);
    vec3 impulse = vec3(0.0);
    if (fetch(counts, slot).x > 0u) {
        impulse = fetch(impulses, slot).xyz;
        if (momentum != 0.0) impulse += (impulse - fetch(earlier, slot).xyz) * momentum;
    }
    return impulse;
}

// m/s, of what the contacts of a vertex and of the triangles around it have changed.
vec3 changeOf(int vertex, int moleculeSphere, bool released)
{
    vec4 shape = shapeOf(vertex);
    vec3 sum = impulseAt(moleculeSphere + vertex);
    for (int i = 0; i < int(shape.w); ++i) sum += impulseAt(moleculeSphere + int(shapeOf(int(shape.z) + i).x)) / 3.0;
    return sum * weightOf(shape, released);
}

// m/s, of sphere k of a molecule.
vec3 velocityChange(int molecule, int k)
{
    int moleculeSphere = firstSphere + molecule * SPHERES;
    bool released = valueOf(oldRecords, molecule).w < 0.0;
    vec4 shape = shapeOf(k);
    bool isVertex = k < VERTICES;
    vec3 change = changeOf(isVertex ? k : int(shape.x), moleculeSphere, released);
    if (!isVertex) {
        change = (change + changeOf(int(shape.y), moleculeSphere, released) +
                  changeOf(int(shape.z), moleculeSphere, released)) / 3.0;
    }
    return change;
}
