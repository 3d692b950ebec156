// Contact of two spheres of masses m and 1/w. All that is the same for both comes out the same to the bit on either
// side, so that what one gains the other loses. Read as C++ through GLM by the tests.

// The share of the sum of the radii by which resting spheres may overlap. A sphere that were pushed out of all overlap would lose
// touch with what else it lies on, and fall back onto that at the speed at which a contact may close, in every step.
const float restingOverlap = 0.005f;

struct PairContact {
    vec3 normal;  // unit, from the other sphere to this one
    float depth;  // m, of what overlaps
    float speed;  // m/s, along the normal; negative: they approach
};

// Returns the unit direction in which a sphere leaves another whose centre coincides with its own, from a number of each: a number stands for
// a point of a cube, which successive ones fill evenly (the R3 sequence [Roberts 2018]). So no three ask for what cannot be.
vec3 directionFrom(uint other, uint number)
{
    uvec3 steps = uvec3(3518319155u, 2882110345u, 2360945575u);  // of 2^32; odd, so that no two numbers have the same point
    vec3 d = vec3((steps * number) >> 8u) - vec3((steps * other) >> 8u);
    return d / sqrt(max(dot(d, d), 1.0f));
}

// Two spheres d apart (from the other's centre to this one's, m) with velocity u relative to the other's, whose radii sum up to `reach`.
PairContact pairContact(vec3 d, vec3 u, float reach)
{
    float apart = sqrt(dot(d, d));
    vec3 direction = d / max(apart, 1e-30f);
    return PairContact(direction, reach - apart, dot(direction, u));
}

// The next impact of two spheres of which both have moved straight for the last `time` s, to be d apart now (UberFlow, section 4.5: backed
// up in time to the first contact), even if they have passed through each other since.
struct PairImpact {
    vec3 normal;   // unit, from the other sphere to this one, when they touch
    float since;   // s, since then
    float speed;   // m/s, along the normal; negative: they approach
    bool happens;  // within that time; else the others say nothing
};

// Spheres that overlap when that time begins, and approach, have their impact then. Exchanged, the two give the same to the bit.
PairImpact nextImpact(vec3 d, vec3 u, float reach, float time, float restSpeed)
{
    vec3 start = d - u * time;
    float along = dot(start, u);
    float gap = dot(start, start) - reach * reach;
    float under = along * along - dot(u, u) * gap;
    float wait = gap > 0.0f ? gap / max(sqrt(max(under, 0.0f)) - along, 1e-30f) : 0.0f;
    vec3 touch = start + u * wait;
    float apart = sqrt(dot(touch, touch));
    vec3 normal = touch / max(apart, 1e-30f);
    float speed = dot(normal, u);
    bool happens = along < 0.0f && under > 0.0f && wait <= time && speed < -restSpeed;
    return PairImpact(normal, max(time - wait, 0.0f), speed, happens);
}

// Returns the impulse (N s) that would bring a contact nearer to its velocity afterwards: `target` along the unit normal n, and
// none across it.
//   u        m/s, of the sphere relative to the other, as all impulses so far make it
//   pushed   N s, the contact's impulse so far
//   w        1/kg, what an impulse of 1 N s changes of the velocity, x along n, y across it, or more than that where several
//            contacts are answered at once, so that together they do not outdo themselves (docs/contact.md)
vec3 pairImpulse(vec3 u, vec3 n, float target, vec3 pushed, vec2 w)
{
    float along = dot(u, n);
    return pushed + n * ((target - along) / w.x) - (u - n * along) / w.y;
}

// Returns what a contact can take of an impulse: it never pulls, and across its normal Coulomb's friction bounds it.
vec3 withinFriction(vec3 impulse, vec3 n, float friction)
{
    float along = dot(impulse, n);
    vec3 across = impulse - n * along;
    float most = friction * max(along, 0.0f);
    float grip = sqrt(dot(across, across));
    return along >= 0.0f && grip <= most ? impulse : n * max(along, 0.0f) + across * (most / max(grip, 1e-30f));
}

// The relaxation factor of slip, relative to that of the velocity along the normal: of 0.2 to 1, the one with which piles
// converge fastest.
const float frictionStep = 0.4f;

// Contacts that act on one sphere or body together: the sum of x n n^T + y (1 - n n^T), as its diagonal and what lies beside it
// (yz, xz, xy), and their number.
struct ContactSum {
    vec3 diagonal;
    vec3 beside;
    float number;
};

ContactSum noContacts()
{
    return ContactSum(vec3(0.0f), vec3(0.0f), 0.0f);
}

// Adds a contact with the unit normal n. `parts`: x and y, of its two weights (pairImpulse) what is not the turning of a body.
ContactSum withContact(ContactSum sum, vec3 n, vec2 parts)
{
    float across = frictionStep * parts.y;
    float along = parts.x - across;
    return ContactSum(sum.diagonal + n * n * along + across, sum.beside + vec3(n.y * n.z, n.x * n.z, n.x * n.y) * along,
                      sum.number + 1.0f);
}

ContactSum bothSums(ContactSum a, ContactSum b)
{
    return ContactSum(a.diagonal + b.diagonal, a.beside + b.beside, a.number + b.number);
}

// A symmetric matrix from its diagonal and what lies beside it (yz, xz, xy).
mat3 symmetric(vec3 d, vec3 o)
{
    return mat3(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z);
}

mat3 matrixOf(ContactSum sum)
{
    return symmetric(sum.diagonal, sum.beside);
}

// Returns the trace of a b.
float traceOf(mat3 a, mat3 b)
{
    mat3 t = transpose(b);
    return dot(a[0], t[0]) + dot(a[1], t[1]) + dot(a[2], t[2]);
}

// Returns the effective number of contacts that act on one sphere, by which a Jacobi step is divided: the largest
// eigenvalue of their sum, or up to 1.15 times that, from the trace of the eighth power.
float effectiveCount(ContactSum sum)
{
    mat3 squared = matrixOf(sum);
    squared = squared * squared;
    mat3 fourth = squared * squared;
    return sum.number < 1.5f ? 1.0f : max(sqrt(sqrt(sqrt(traceOf(fourth, fourth)))), 1.01f);
}

// Returns the same for a rigid body, whose motion has six components, from the matrix (a b; c d): up to 1.25 times the eigenvalue.
float effectiveCount(mat3 a, mat3 b, mat3 c, mat3 d)
{
    for (int i = 0; i < 2; ++i) {
        mat3 a0 = a;
        mat3 b0 = b;
        mat3 c0 = c;
        a = a0 * a0 + b0 * c0;
        b = a0 * b0 + b0 * d;
        c = c0 * a0 + d * c0;
        d = c0 * b0 + d * d;
    }
    return max(sqrt(sqrt(sqrt(traceOf(a, a) + 2.0f * traceOf(b, c) + traceOf(d, d)))), 1.01f);
}

// Whether a contact is the only one that acts on either of its spheres, from the larger of their effectiveCount.
bool isAlone(float count)
{
    return count < 1.003f;
}
