// A sphere of one group as the fused step's state has it.
#include "contact/grid/shape.glsl"
#include "contact/grid/sphere.glsl"

uniform VALUES oldState;
uniform VALUES oldRecords;
uniform VALUES constants;

StateSphere sphereOfState(int molecule, int k)
{
    vec4 record = valueOf(oldRecords, molecule);
    bool released = record.w < 0.0;
    int first = firstElement(molecule, STATE_ELEMENTS);
    StateSphere own;
    own.anchor = record.xyz;
    own.lives = true;
    own.fresh = false;
    bool isVertex = !TRIANGLES || k < VERTICES;
    ivec3 corners = isVertex ? ivec3(k) : ivec3(shapeOf(k).xyz);
    own.position = packedVertex(oldState, first, 0, corners.x);
    own.velocity = packedVertex(oldState, first, POSITION_ELEMENTS, corners.x);
    own.weight = weightOf(shapeOf(corners.x), released);
    if (!isVertex) {
        own.position = (own.position + packedVertex(oldState, first, 0, corners.y) +
                        packedVertex(oldState, first, 0, corners.z)) / 3.0;
        own.velocity = (own.velocity + packedVertex(oldState, first, POSITION_ELEMENTS, corners.y) +
                        packedVertex(oldState, first, POSITION_ELEMENTS, corners.z)) / 3.0;
        // an impulse on the middle is a third on each corner
        own.weight = (own.weight + weightOf(shapeOf(corners.y), released) + weightOf(shapeOf(corners.z), released)) / 9.0;
    }
    float scale = 1.0;
#ifdef CONSTANTS
    scale = valueOf(constants, molecule).x;
#endif
    own.radius = givenRadius * scale;
#ifdef LIFE
    vec2 life = packedLife(oldState, first);
    if (CONTACT_GROWTH != vec2(1.0)) own.radius *= mix(CONTACT_GROWTH.x, CONTACT_GROWTH.y, min(life.x / max(life.y, 1e-9), 1.0));
    own.lives = life.y > 0.0;
    own.fresh = life.x <= contactStep * 1.0001;
    if (!own.lives) own.radius = 0.0;
#endif
    return own;
}

// `place`: of the sphere, m from the molecule's anchor.
BodySphere bodySphereOf(int molecule, vec3 place)
{
    if (!RIGID) return noBody;
    int first = firstElement(molecule, STATE_ELEMENTS);
    float mass = 0.0;
    vec3 centre = vec3(0.0);
    for (int v = 0; v < VERTICES; ++v) {
        float own = 1.0 / shapeOf(v).x;
        mass += own;
        centre += packedVertex(oldState, first, 0, v) * own;
    }
    centre /= mass;
    mat3 inertia = mat3(0.0);
    for (int v = 0; v < VERTICES; ++v) {
        vec3 arm = packedVertex(oldState, first, 0, v) - centre;
        inertia += (mat3(dot(arm, arm)) - outerProduct(arm, arm)) * (1.0 / shapeOf(v).x);
    }
    // a rod has none about its axis
    float most = max(max(inertia[0][0], inertia[1][1]), max(inertia[2][2], 1e-30));
    vec3 arm = place - centre;
    mat3 perInertia = inverse(inertia + mat3(1e-5 * most));
    float trace = perInertia[0][0] + perInertia[1][1] + perInertia[2][2];
    return BodySphere(arm, 1.0 / mass, perInertia, dot(arm, arm) * trace - dot(arm, perInertia * arm));
}
