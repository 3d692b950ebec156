// Hooke's spring with damping along it: the force on end i,
//   -[k (l - L) + c n.(vi - vj)] n,  n = (xi - xj) / l.
// The length's guard turns 0/0 of coincident ends into no force. Read as C++ through GLM by the tests.

vec3 springForce(vec3 d, vec3 relativeVelocity, float stiffness, float damping, float restLength)
{
    float squared = dot(d, d);
    float inverse = 1.0f / sqrt(max(squared, 1e-24f));
    // along d instead of n: -[k (1 - L/l) + c d.(vi - vj) / l^2] d
    float stretch = restLength * inverse - 1.0f;
    float approach = dot(d, relativeVelocity) * (inverse * inverse);
    return d * (squared > 1e-24f ? stiffness * stretch - damping * approach : 0.0f);
}

// A muscle's rest length at a phase (2 pi f t + phi), in radians, in a body whose bend asks for a share of it.
float bentLength(float restLength, float amplitude, float phase, float bend)
{
    return restLength * (1.0f + amplitude * sin(phase) + bend);
}
