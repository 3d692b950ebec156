// The key of a molecule in the order from back to front: its middle's depth along the view, the farthest first, as a
// whole number that grows as -depth does. What is dead comes last.
#include "state/molecule.glsl"

uniform vec3 forward;  // unit, where the eye looks
uniform int vertexCount, moleculeCount;

const uint deadKey = 0xffffffffu;  // of no depth that is finite

uint orderKey(int molecule)
{
    if (!isAlive(molecule)) return deadKey;
    vec3 sum = vec3(0.0);
    for (int v = 0; v < vertexCount; ++v) sum += vertexPlace(molecule, v);
    uint bits = floatBitsToUint(-dot(sum, forward) / float(vertexCount));
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
