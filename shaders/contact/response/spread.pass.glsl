// Where contacts of one sphere move others of its molecule. With VELOCITIES how the totals so far move the spheres of one group, else the
// effective count (physics/pair.glsl) of the contacts that act on the same vertices as a sphere's own, or on the same rigid body (RIGID).
// With buffers a lane has a sphere or, with RIGID, a molecule; in fragments a texel has a slot, and those of other groups' spheres are left as
// they are.
#include "contact/slots.glsl"
#include "contact/grid/shape.glsl"

const bool oneForMolecule = RIGID && !inTextures;

uniform int groupSpheres;

// Returns which sphere of the group, or which molecule, from 0.
int ownLaneOfGroup()
{
    if (!inTextures) return ownLane();
    int lane = sphereOf(ownNumber()) - firstSphere;
    if (ownNumber() >= count || lane < 0 || lane >= groupSpheres) discardTexel();
    return lane;
}

#ifdef VELOCITIES
const bool applies = false;
#ifndef TEXTURES
#include "contact/response/batches.glsl"

uniform int batch;  // of the iteration that comes

bool isNeeded()
{
    return batches[batch].groupsX > 0u;
}
#else
bool isNeeded()
{
    return true;
}
#endif
#include "contact/response/changes.glsl"
#pragma writes velocities

void put(int sphere, Total change)
{
    int slot = inTextures ? ownNumber() : slotOf(sphere);
    if (!inTextures && (countsAt(slot) & RESPONDS) == 0u) return;  // nothing touches it
    int row = rowOf(slot);
    putVelocities(row, 0, vec4(velocityBefore(sphere) + change.impulse, 0.0));
    putVelocities(row, 1, vec4(change.shift, 0.0));
}

void spread(int molecule, int own)
{
    int first = moleculeSphere(molecule);
    if (oneForMolecule) {
        BodyTotal body = totalOfBody(molecule);
        for (int k = 0; k < SPHERES; ++k) put(first + k, changeIn(body, molecule, k));
    } else {
        put(first + own, changeOf(molecule, own));
    }
}
#else
bool isNeeded()
{
    return true;
}

#include "contact/response/body.glsl"
#pragma reads counts contactSums
#pragma writes effectiveCounts

ContactSum contactsOf(int sphere)
{
    int slot = slotOf(sphere);
    if (countsAt(slot) == 0u) return noContacts();
    vec4 first = contactSumsAt(slot, 0);
    return ContactSum(first.xyz, contactSumsAt(slot, 1).xyz, first.w);
}

// Returns it for all spheres of the molecule whose first is `moleculeSphere`: all contacts of the molecule act on each. With X the
// matrix of a cross product with a sphere's arm and S the sum of its contacts, the matrix of its body is the sum over the spheres
// of (S, S X^T; I^-1 M X S, I^-1 M X S X^T).
float effectiveSumOfBody(int moleculeSphere)
{
    mat3 a = mat3(0.0);
    mat3 b = a;
    mat3 d = a;
    BodySphere body;
    bool any = false;
    for (int j = 0; j < SPHERES; ++j) {
        body = bodySphereAt(moleculeSphere + j);
        mat3 sum = matrixOf(contactsOf(moleculeSphere + j));
        mat3 arm = mat3(0.0, body.arm.z, -body.arm.y, -body.arm.z, 0.0, body.arm.x, body.arm.y, -body.arm.x, 0.0);
        mat3 turned = sum * transpose(arm);
        a += sum;
        b += turned;
        d += arm * turned;
        any = any || (countsAt(slotOf(moleculeSphere + j)) & CONTACTS) != 0u;
    }
    if (!any) return 0.0;
    mat3 perInertia = body.perInertia / body.perMass;
    return effectiveCount(a, b, perInertia * transpose(b), perInertia * d);
}

float countOf(int vertex, int moleculeSphere)
{
    vec4 shape = shapeOf(vertex);
    ContactSum sum = contactsOf(moleculeSphere + vertex);
    for (int i = 0; i < int(shape.w); ++i) sum = bothSums(sum, contactsOf(moleculeSphere + int(shapeOf(int(shape.z) + i).x)));
    return effectiveCount(sum);
}

// Returns it for sphere k of the molecule whose first is `moleculeSphere`.
float effectiveSum(int moleculeSphere, int k)
{
    if (RIGID) return effectiveSumOfBody(moleculeSphere);
    if (!isActedOn(countsAt(slotOf(moleculeSphere + k)))) return 0.0;
    if (k < VERTICES) return countOf(k, moleculeSphere);
    TrianglePoint point = trianglePoint(shapeOf(k));
    float most = 0.0;
    for (int c = 0; c < 3; ++c) {
        if (point.parts[c] > 0.0) most = max(most, countOf(point.corners[c], moleculeSphere));
    }
    return most;
}

void spread(int molecule, int own)
{
    int first = firstSphere + molecule * SPHERES;
    uint sum = floatBitsToUint(effectiveSum(first, own));
    int end = oneForMolecule ? SPHERES : own + 1;
    for (int k = own; k < end; ++k) putEffectiveCounts(slotOf(first + k), sum);
}
#endif

void main()
{
    int lane = ownLaneOfGroup();
    int molecule = oneForMolecule ? lane : lane / SPHERES;
    int own = oneForMolecule ? 0 : lane - molecule * SPHERES;
    bool isLeft = isNeeded() && !rests(slotOf(firstSphere + molecule * SPHERES + own));
    while (isLeft) {  // a loop, which a CPU rasteriser leaves where no lane stays (contact/search/find.pass.glsl)
        spread(molecule, own);
        isLeft = false;
    }
}
