// Hooke's spring with damping along it: the force on end i,
//   -[k (l - L) + c n.(vi - vj)] n,  n = (xi - xj) / l.
// The length's guard turns 0/0 of coincident ends into no force. Read as C++ through GLM by the tests.

vec3 springForce(vec3 d, vec3 relativeVelocity, float stiffness, float damping, float restLength)
{
    float squared = dot(d, d);
    if (squared < 1e-24f) return vec3(0.0f);
    float inverse = 1.0f / sqrt(squared);
    vec3 n = d * inverse;
    float stretch = squared * inverse - restLength;
    return n * -(stiffness * stretch + damping * dot(n, relativeVelocity));
}

// A muscle's rest length at a phase (2 pi f t + phi), in radians.
float actuatedLength(float restLength, float amplitude, float phase)
{
    return restLength * (1.0f + amplitude * sin(phase));
}
