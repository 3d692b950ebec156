// Positions are stored relative to a molecule's anchor, which lies on a lattice of 1/16 m: a shift by lattice
// steps is exact in float, so that a molecule far from the origin is as accurate as one at it.
// Read as C++ through GLM by the tests.

// The lattice point nearest to p.
vec3 latticeNear(vec3 p)
{
    return floor(p * 16.0f + 0.5f) * 0.0625f;  // a product with a power of two is exact, a quotient need not be
}

// How far the anchor moves when vertex 0 is at p relative to it: nothing within 1 m, else to the lattice
// point nearest to p. Every vertex of a molecule derives the same shift from the same p.
vec3 anchorShift(vec3 p)
{
    if (abs(p.x) <= 1.0f && abs(p.y) <= 1.0f && abs(p.z) <= 1.0f) return vec3(0.0f);
    return latticeNear(p);
}
