// Hooke's spring with damping along it: the force on end i, N,
//   -[k (l - L) + c n.(vi - vj)] n,  n = (xi - xj) / l.
// The length's guard leaves ends that coincide without a force. Read as C++ through GLM by the tests.

vec3 springForce(vec3 d, vec3 relativeVelocity, float stiffness, float damping, float restLength)
{
    float inverse = inversesqrt(max(dot(d, d), 1e-24f));
    // along d instead of n: -[k (1 - L/l) + c d.(vi - vj) / l^2] d
    float stretch = restLength * inverse - 1.0f;
    float approach = dot(d, relativeVelocity) * (inverse * inverse);
    return d * (stiffness * stretch - damping * approach);
}

// Returns the share by which a muscle lengthens its spring at a time, s: xyz its amplitude, rate (rad/s) and phase (rad).
// angle: rad, of the rate when the time begins; phase: rad, of the molecule.
float musclePull(vec3 muscle, float angle, float time, float phase)
{
    // The time comes last: compilers may add constants first, and one has done so in one form of a kernel alone.
    return muscle.x * sin(muscle.z + angle + phase + muscle.y * time);
}

// Returns a rest length, m, that a muscle lengthens by a share, and a body's bend by another.
float bentLength(float restLength, float pull, float bend)
{
    return restLength * (1.0f + pull + bend);
}
