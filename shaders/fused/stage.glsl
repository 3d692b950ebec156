// The stage that the implicit solvers share. It finds the displacements q of the substep that solve
//
//   m (q - z) / eta = m w + eta (f(x + q, (q - z) / eta) + m g + m gamma (u - (q - z) / eta))
//
// with z, w from the method (history), f the springs, and drag and gravity inside. Starting from the solution without
// springs, sweeps over the springs relax one after the other (XPBD). Everything is a displacement from x, never a
// position: a float near the anchor rounds to 6e-8 m, and divided by eta that would be the velocity's error.
//
// generated/sweeps.glsl calls relax() for every spring.
#include "fused/step.glsl"
#include "physics/relaxation.glsl"

vec3 q[VERTICES];       // m, displacement of the substep
vec3 z[VERTICES];       // m, its part that is known before the stage
float weight[VERTICES];  // s^2/kg, 1 / (m beta) along the surface, 0 where held
float lambda[SPRING_COUNT];  // N

float acrossLess;  // 1 - (weight across the surface) / (weight along it)

#define RELAXED(a, b) q[a], q[b], x[a] - x[b], z[a] - z[b], weight[a], weight[b], normal[a], normal[b]

// One spring of stiffness N/m and damping kg/s; n is d / |d|, and nothing moves where ends coincide.
void relax(inout vec3 qa, inout vec3 qb, vec3 apart, vec3 known, float alongA, float alongB, vec3 normalA,
           vec3 normalB, inout float pushed, float stiffness, float damping, float restLength, float inverseEta)
{
    stiffness *= stiffnessFactor;
    float dampingRate = damping * dampingFactor * inverseEta;
    vec3 moved = qa - qb;
    vec3 d = apart + moved;
    float squared = dot(d, d);
    float inverse = 1.0 / sqrt(max(squared, 1e-24));
    float stretch = squared * inverse - restLength;
    float parted = dot(d, moved - known) * inverse;
    float offA = 0.0;
    float offB = 0.0;
    float reach = alongA + alongB;
    if (isDirectional) {
        offA = dot(normalA, d) * inverse;
        offB = dot(normalB, d) * inverse;
        reach = alongA * (1.0 - acrossLess * offA * offA) + alongB * (1.0 - acrossLess * offB * offB);
    }
    float change = relaxation(stretch, parted, pushed, reach, stiffness, dampingRate);
    vec3 impulse = d * (inverse * change);
    if (isDirectional) {
        qa += (impulse - normalA * (acrossLess * offA * change)) * alongA;
        qb -= (impulse - normalB * (acrossLess * offB * change)) * alongB;
    } else {
        qa += impulse * alongA;
        qb -= impulse * alongB;
    }
    pushed += change;
}

// Decides from the springs' forces at the start of the frame whether pins are released.
void releasePins(int step)
{
    if (RELEASE) springForcesNow(step, float(step) * substep);
}
