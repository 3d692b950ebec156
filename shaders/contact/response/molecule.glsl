// The molecule of a slot, of any group, and how an impulse on one of its spheres moves the others (as contact/response/changes.glsl
// has it of one group).
#include "contact/grid/triangle_point.glsl"
#include "contact/response/body.glsl"
#include "contact/slots.glsl"
#pragma reads groupsOf shapes slots

struct Molecule {
    int first;     // of its spheres
    int spheres;   // how many
    int vertices;  // so many of them are vertices; behind these come triangles
    int shape;     // of the first sphere (contact/grid/shape.glsl)
};

Molecule moleculeOf(int slot)
{
    uint label = placesAt(slot).w;
    int group = 2 * int(label >> 26u);
    ivec2 spheres = ivec2(groupsOfAt(group).xy);
    ivec2 shape = ivec2(groupsOfAt(group + 1).xy);
    return Molecule(spheres.x + int(label & 0x3ffffffu) * spheres.y, spheres.y, shape.x, shape.y);
}

int slotOfSphere(Molecule molecule, int k)
{
    return int(slotsAt(molecule.first + k));
}

TrianglePoint pointOf(Molecule molecule, int k)
{
    return k < molecule.vertices ? vertexPoint(k) : trianglePoint(shapesAt(molecule.shape + k));
}

// Returns how 1 N s on sphere s changes the velocity of sphere k, 1/kg, where each vertex gives way alone.
float shareOf(Molecule molecule, int k, int s)
{
    TrianglePoint moved = pointOf(molecule, k);
    TrianglePoint pushed = pointOf(molecule, s);
    float sum = 0.0;
    for (int c = 0; c < 3; ++c) {
        float parts = moved.parts[c] * dot(vec3(equal(ivec3(moved.corners[c]), pushed.corners)), pushed.parts);
        if (parts > 0.0) sum += parts * withoutFlag(motionAt(slotOfSphere(molecule, moved.corners[c])).w);
    }
    return sum / (moved.all * pushed.all);
}

// Returns how an impulse on the sphere of one slot, N s, changes the velocity of that of another, m/s.
vec3 gainOf(int slot, int pushed, vec3 impulse)
{
    if (!SPREADS) return slot == pushed ? impulse * withoutFlag(motionAt(slot).w) : vec3(0.0);
    Molecule molecule = moleculeOf(pushed);
    int k = sphereOf(slot) - molecule.first;
    if (k < 0 || k >= molecule.spheres || rests(pushed)) return vec3(0.0);
    BodySphere body = bodySphereAt(sphereOf(pushed));
    if (body.perMass == 0.0) return impulse * shareOf(molecule, k, sphereOf(pushed) - molecule.first);
    BodyMotion motion = BodyMotion(vec3(0.0), vec3(0.0));
    add(motion, body, impulse);
    return motionAt(bodySphereAt(sphereOf(slot)), motion);
}
