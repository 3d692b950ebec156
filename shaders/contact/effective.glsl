// The effective number of a sphere's contacts: an upper bound of the largest eigenvalue of the sum of n n^T over their normals
// (physics/pair.glsl), which is their number where all push the same way. It scales the Jacobi steps of contact/relax.glsl so
// that they are stable.
#include "contact/response.glsl"

NormalSum normalsOf(int slot, Sphere own, int listed)
{
    NormalSum sum = NormalSum(vec3(0.0), vec3(0.0));
    for (int e = 0; e < listed; ++e) {
        int other = entryOf(slot, e);
        Sphere sphere = sphereAt(other);
        bool meets = own.weight + sphere.weight > 0.0 && holds(other, slot);
        if (meets) sum = withNormal(sum, contactOf(own, sphere, slot < other ? 1.0 : -1.0).normal);
    }
    return sum;
}
