// bdf2-corotated: BDF2 (fused/bdf2.glsl) whose stage is solved by two quasi-Newton steps with the matrix of the rest
// shape, turned with the molecule (corotational, [Mueller 2002]):
//
//   A = beta M + sum (k + c/eta) n n^T over the springs at rest;   q += R A^-1 R^T (f(x + q, (q - z)/eta) - beta M (q - q0))
//
// Every molecule of a type shares the factors of A: computed on the CPU in double (compile/corotated.h), the block Factors of
// generated/factors.glsl. R turns the rest shape onto the predicted one, and for the second step onto
// what the first has made of it [Mueller 2016].
// Guarded: where the predicted shape is further than STRAYS of its size from the turned rest shape, or where
// the second step is not much smaller than the first, or once pins have been released, or in a step without
// history, two sweeps go ahead as in bdf2-xpbd. Sweeps alone can hold a pinned molecule in a shape at which
// its springs are far from rest and the stage far from solved, so the two steps are then tried from where the
// sweeps ended, and kept if the second is much smaller.

mat3 turn;  // of the rest shape
vec3 start[VERTICES];     // m, q without springs

// Returns three axes made of two vectors: along the first, across the plane of both, and across these two.
mat3 axesOf(vec3 first, vec3 second)
{
    vec3 a = first / sqrt(max(dot(first, first), 1e-24));
    vec3 n = cross(a, second);
    vec3 other = abs(a.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    n = dot(n, n) > 1e-8 * dot(second, second) ? n : cross(a, other);
    n = n / sqrt(max(dot(n, n), 1e-24));
    return mat3(a, n, cross(a, n));
}

vec3 turned(vec3 axis, vec3 v, float sine, float cosine)
{
    vec3 across = cross(axis, v);
    return v + across * sine + cross(axis, across) * cosine;
}

// One step of the fit of `turn` to the covariance, whose columns belong to the rest shape's axes.
void fitTurn(mat3 covariance)
{
    vec3 axis = cross(turn[0], covariance[0]) + cross(turn[1], covariance[1]) + cross(turn[2], covariance[2]);
    float along = dot(turn[0], covariance[0]) + dot(turn[1], covariance[1]) + dot(turn[2], covariance[2]);
    axis = axis / max(abs(along), 1e-20);
    float squared = dot(axis, axis);
    float angle = sqrt(squared);
    float sine = angle > 1e-3 ? sin(angle) / angle : 1.0 - squared / 6.0;
    float cosine = angle > 1e-3 ? (1.0 - cos(angle)) / squared : 0.5 - squared / 24.0;
    turn = mat3(turned(axis, turn[0], sine, cosine), turned(axis, turn[1], sine, cosine),
                turned(axis, turn[2], sine, cosine));
}

// Turns the rest shape onto x + q. Returns whether a vertex is far from its place in it.
bool fit(int rounds)
{
    vec3 centre = vec3(0.0);
    for (int i = 0; i < VERTICES; ++i) {
        centre += (x[i] + q[i]) * massShare[i];
    }
    mat3 covariance = mat3(0.0);
    for (int i = 0; i < VERTICES; ++i) {
        covariance += outerProduct((x[i] + q[i] - centre) * massShare[i], restArm[i]);
    }
    for (int r = 0; r < rounds; ++r) fitTurn(covariance);
    float furthest = 0.0;
    for (int i = 0; i < VERTICES; ++i) {
        vec3 off = x[i] + q[i] - centre - turn * (restArm[i] * scale);
        furthest = max(furthest, dot(off, off));
    }
    return furthest > STRAYS * STRAYS * scale * scale;
}

// Takes one quasi-Newton step. Returns the sum of its squares, m^2.
float improve(float time)
{
    for (int i = 0; i < VERTICES; ++i) {
        force[i] = vec3(0.0);
    }
    stageForces(time, 1.0 / eta);
    for (int i = 0; i < VERTICES; ++i) {
        vec3 gone = q[i] - start[i];
        if (isDirectional) gone += normal[i] * (dot(normal[i], gone) * (acrossLess / (1.0 - acrossLess)));
        residual[i] = (force[i] - gone / max(weight[i], 1e-30)) * turn;
    }
    applyInverse();
    float sum = 0.0;
    for (int i = 0; i < VERTICES; ++i) {
        vec3 change = weight[i] > 0.0 ? turn * correction[i] : vec3(0.0);
        q[i] += change;
        sum += dot(change, change);
    }
    return sum;
}

void beginSolver()
{
    beginHistory();
    turn = axesOf(x[FIT_B] - x[FIT_A], x[FIT_C] - x[FIT_A]) *
           transpose(axesOf(restArm[FIT_B] - restArm[FIT_A], restArm[FIT_C] - restArm[FIT_A]));
}

// Takes two quasi-Newton steps. Returns whether they converge.
bool solved(float time)
{
    float first = 0.0;
    float second = 0.0;
    for (int n = 0; n < 2; ++n) {
        if (n > 0) fit(2);
        first = second;
        second = improve(time);
    }
    return second < 0.25 * first || second < SETTLED * scale * scale;
}

// A substep up to contact.
void advance(int step)
{
    predict(step);
    float time = float(step + 1) * substep;
    bool shares = !(released && SHARED_PINS);  // the matrix
    bool sweeps = fit(step == 0 ? 8 : 3) || !shares || restart;
    for (int i = 0; i < VERTICES; ++i) {
        start[i] = q[i];
    }
    if (!sweeps) sweeps = !solved(time);
    if (sweeps) {
        for (int i = 0; i < VERTICES; ++i) {
            q[i] = start[i];
        }
        relaxForward(time, 1.0 / eta);
        relaxBackward(time, 1.0 / eta);
    }
    if (sweeps && shares) {
        for (int i = 0; i < VERTICES; ++i) {
            probe[i] = q[i];  // which nothing reads any more in this substep
        }
        fit(3);
        bool worse = !solved(time);
        for (int i = 0; i < VERTICES; ++i) {
            q[i] = worse ? probe[i] : q[i];
        }
    }
    accept();
}

void finishSolver()
{
    endHistory();
}
