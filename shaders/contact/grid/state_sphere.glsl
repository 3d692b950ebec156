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
    if (!TRIANGLES || k < VERTICES) {
        own.position = packedVertex(oldState, first, 0, k);
        own.velocity = packedVertex(oldState, first, POSITION_ELEMENTS, k);
        own.weight = weightOf(shapeOf(k), released);
    } else {
        TrianglePoint point = trianglePoint(shapeOf(k));
        own.position = vec3(0.0);
        own.velocity = vec3(0.0);
        own.weight = 0.0;
        for (int c = 0; c < 3; ++c) {
            int corner = point.corners[c];
            own.position += packedVertex(oldState, first, 0, corner) * point.parts[c];
            own.velocity += packedVertex(oldState, first, POSITION_ELEMENTS, corner) * point.parts[c];
            own.weight += weightOf(shapeOf(corner), released) * (point.parts[c] * point.parts[c]);
        }
        own.position /= point.all;
        own.velocity /= point.all;
        own.weight /= point.all * point.all;
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
