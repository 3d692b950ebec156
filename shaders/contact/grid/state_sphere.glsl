// A sphere of one group as the fused step's state has it.
#include "contact/grid/shape.glsl"
#include "physics/cells.glsl"
#include "contact/flags.glsl"

uniform VALUES oldState;
uniform VALUES oldRecords;
uniform VALUES constants;
uniform float cell;
uniform float givenRadius;
uniform float contactStep;  // s

struct StateSphere {
    vec3 anchor;    // m
    vec3 position;  // m, from there
    vec3 velocity;  // m/s
    float weight;   // 1/kg
    float radius;   // m
    bool lives;     // its molecule lives
    bool fresh;     // and has been born since the last contact step
};

StateSphere sphereOfState(int molecule, int k)
{
    vec4 record = valueOf(oldRecords, molecule);
    bool released = record.w < 0.0;
    int first = firstElement(molecule, STATE_ELEMENTS);
    vec4 shape = shapeOf(k);
    StateSphere own;
    own.anchor = record.xyz;
    own.lives = true;
    own.fresh = false;
#ifdef TRIANGLES
    ivec3 corners = k < VERTICES ? ivec3(k) : ivec3(shape.xyz);
    vec3 position = (packedVertex(oldState, first, 0, corners.x) + packedVertex(oldState, first, 0, corners.y) +
                     packedVertex(oldState, first, 0, corners.z)) / 3.0;
    vec3 velocity = (packedVertex(oldState, first, POSITION_ELEMENTS, corners.x) +
                     packedVertex(oldState, first, POSITION_ELEMENTS, corners.y) +
                     packedVertex(oldState, first, POSITION_ELEMENTS, corners.z)) / 3.0;
    // an impulse on the middle is a third on each corner
    float weight = (weightOf(shapeOf(corners.x), released) + weightOf(shapeOf(corners.y), released) +
                    weightOf(shapeOf(corners.z), released)) / 9.0;
    bool isVertex = k < VERTICES;
    own.position = isVertex ? packedVertex(oldState, first, 0, corners.x) : position;
    own.velocity = isVertex ? packedVertex(oldState, first, POSITION_ELEMENTS, corners.x) : velocity;
    own.weight = isVertex ? weightOf(shape, released) : weight;
#else
    own.position = packedVertex(oldState, first, 0, k);
    own.velocity = packedVertex(oldState, first, POSITION_ELEMENTS, k);
    own.weight = weightOf(shape, released);
#endif
    float scale = 1.0;
#ifdef CONSTANTS
    scale = valueOf(constants, molecule).x;
#endif
    own.radius = givenRadius * scale;
#ifdef LIFE
    vec2 life = packedLife(oldState, first);
#ifdef CONTACT_GROWTH
    own.radius *= mix(CONTACT_GROWTH.x, CONTACT_GROWTH.y, min(life.x / max(life.y, 1e-9), 1.0));
#endif
    own.lives = life.y > 0.0;
    own.fresh = life.x <= contactStep * 1.0001;
    if (!own.lives) own.radius = 0.0;
#endif
    return own;
}

#ifdef RIGID
#include "contact/response/body.glsl"

// `place`: of the sphere, m from the molecule's anchor.
BodySphere bodySphereOf(int molecule, vec3 place)
{
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
#endif

CellPlace cellPlaceOf(StateSphere own, int sphere, vec3 shift)
{
    CellPlace place = cellPlace(own.anchor, own.position + shift, cell);
    if (!own.lives) place.cell = cellApart(sphere);
    return place;
}

#ifdef WALLS
#include "generated/colliders.glsl"
#include "contact/grid/colliders.glsl"

// The step has answered what colliders do to vertices, but to those of a rigid body, and not to triangles.
bool colliderIsAnswered(int k)
{
#ifdef RIGID
    return false;
#else
    return k < VERTICES;
#endif
}

// Returns the colliders that sphere k of its molecule may press on within the step, the nearest first.
NearCollider[MOST_COLLIDERS] nearColliders(StateSphere own, int k)
{
    contactRadius = own.radius;
    NearCollider near[MOST_COLLIDERS];
    for (int w = 0; w < MOST_COLLIDERS; ++w) near[w] = NearCollider(vec3(0.0), 1e30, vec3(0.0), 0.0);
    float least = colliderIsAnswered(k) ? 0.0 : -1e30;  // m, of a gap
    float reach = 0.25 * own.radius + length(own.velocity) * contactStep;
#ifdef JOINT_CONTACT
    ivec3 skip = ivec3(-1);
    waySquared = 0.0;  // distances as they are
    for (int w = 0; w < MOST_COLLIDERS; ++w) {
        Touch t = survey(own.anchor, own.position, own.velocity, contactStep, skip).swept;
        if (t.which < 0 || t.distance >= reach) break;
        near[w] = NearCollider(t.normal, max(t.distance, least), t.velocity, materialOf(t).y);
        skip = ivec3(skip.y, t.which, -1);
    }
#else
    vec4 surface = surfaceAt(own.anchor, own.position);
    if (surface.w < reach) near[0] = NearCollider(surface.xyz, max(surface.w, least), vec3(0.0), colliderParameters[0].y);
#endif
    return near;
}
#endif
