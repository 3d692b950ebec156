// Where one sphere's contacts move others: the effective count (physics/pair.glsl) of the contacts that act on the same vertices
// as a sphere's own, or on the same rigid body (RIGID). Needs contact/shape.glsl.
#include "contact/flags.glsl"
#include "physics/pair.glsl"

uniform UINTS counts;
#ifdef TEXTURES
uniform sampler2DArray contactSums;  // by slot, two layers: xyz the parts of a ContactSum, w of the first its number
#define contactTexel(slot, k) texelFetch(contactSums, ivec3(texelOf(slot), k), 0)
#else
uniform samplerBuffer contactSums;   // two texels a slot
#define contactTexel(slot, k) texelFetch(contactSums, 2 * (slot) + (k))
#endif

ContactSum contactsOf(int sphere)
{
    int slot = slotOf(sphere);
    if (fetch(counts, slot).x == 0u) return noContacts();
    vec4 first = contactTexel(slot, 0);
    return ContactSum(first.xyz, contactTexel(slot, 1).xyz, first.w);
}

#ifdef RIGID
#include "contact/body_sums.glsl"

// Returns it for all spheres of the molecule whose first is `moleculeSphere`: all contacts of the molecule act on each. With X the
// matrix of a cross product with a sphere's arm and S the sum of its contacts, the matrix of its body is the sum over the spheres
// of (S, S X^T; I^-1 M X S, I^-1 M X S X^T).
float effectiveSum(int moleculeSphere)
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
        any = any || (fetch(counts, slotOf(moleculeSphere + j)).x & CONTACTS) != 0u;
    }
    if (!any) return 0.0;
    mat3 perInertia = body.perInertia / body.perMass;
    return effectiveCount(a, b, perInertia * transpose(b), perInertia * d);
}
#else
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
    if (!isActedOn(fetch(counts, slotOf(moleculeSphere + k)).x)) return 0.0;
    vec4 shape = shapeOf(k);
    float most = countOf(k < VERTICES ? k : int(shape.x), moleculeSphere);
    if (k >= VERTICES) most = max(most, max(countOf(int(shape.y), moleculeSphere), countOf(int(shape.z), moleculeSphere)));
    return most;
}
#endif
