// A spring as a compliant constraint C = l - L, and one step of relaxing it (XPBD, [Macklin 2016, (18) and (26)],
// multiplied by the stiffness, so that a spring without any needs no special case):
//   d lambda = -(k C + c/eta r + lambda) / ((k + c/eta) w + 1),   ends move by w_i d lambda n and -w_j d lambda n
// lambda (N) is what the spring has pushed with so far, r (m) how far its ends have parted in this stage, and
// w = n.(W_i + W_j) n with W the inverse of mass times beta, beta = 1/eta^2 + gamma/eta.
// Read as C++ through GLM by the tests.

float relaxation(float stretch, float parted, float lambda, float weight, float stiffness, float dampingRate)
{
    // a reciprocal, which does not depend on the step where drag has no direction: compilers take it out of the loop
    return (stiffness * stretch + dampingRate * parted + lambda) * (-1.0f / ((stiffness + dampingRate) * weight + 1.0f));
}
