// bdf2-newton: BDF2 (fused/bdf2.glsl) whose stage is solved by Newton steps with the matrix of the molecule as it is:
//
//   A = beta M + sum (k + c/eta) n n^T + t (1 - n n^T) over the springs;   q += A^-1 (f(x + q, (q - z)/eta) - beta M (q - q0))
//
// n is a spring's direction at x + q and t its tension over its length, which is what turns with it: 0 where it pushes, and
// at most k + c/eta, so that A is positive definite. What a damper's pull changes by as its spring turns is left out,
// and the steps converge all the same. Steps end when one has moved no vertex further than a share of the
// molecule's size (src/compile/newton.h).
//
// In a step without history a damper takes how its spring's length has changed: along n alone a chord of a turn would
// shorten it.
#include "fused/elimination.glsl"

// The last Newton step after which a molecule's vertices still moved, counted over the substeps; behind them, of any molecule.
shared int unsettled[LANES + 1];
int newtonStep = 0;

void beginSolver()
{
    beginHistory();
    unsettled[column()] = 0;
    unsettled[LANES] = 0;
}

// The inverse of the weight, kg/s^2, times a displacement in m.
vec3 heaved(int i, vec3 gone)
{
    if (isDirectional) gone += normal[i] * (dot(normal[i], gone) * (acrossLess / (1.0 - acrossLess)));
    return gone / max(weight[i], 1e-30);
}

// Adds up the springs on vertex i, and what they add to the matrix.
void assemble(int i, float time)
{
    int vertex = vertexOf(i);
    vec4 spans = table(topologyBase + vertex);
    vec4 own = table(matrixTable() + 1 + vertex);
    vec3 sum = -heaved(i, q[i] - (z[i] + unsprung[i] * eta));
    dmat3 diagonal = dmat3(heaved(i, vec3(1.0, 0.0, 0.0)), heaved(i, vec3(0.0, 1.0, 0.0)), heaved(i, vec3(0.0, 0.0, 1.0)));
    int count = int(spans.y);
    for (int s = 0; s < count; ++s) {
        int entry = int(spans.x) + 2 * s;
        vec4 spring = table(entry);
        int other = int(spring.x);
        float stiffness = spring.y * stiffnessFactor;
        float damping = spring.z * dampingFactor / eta;
        vec3 apart = x[i] - sharedVector(PLACES, other);
        vec3 known = z[i] - vec3(numbers(KNOWN + 3 * other));
        vec3 moved = q[i] - sharedVector(VELOCITIES, other);
        dvec3 d = dvec3(apart + moved);
        double exact = sqrt(max(dot(d, d), 1e-24));
        dvec3 n = d / exact;
        float span = float(exact);
        vec3 along = restart ? (vec3(d) + apart + known) / (span + length(apart + known)) : vec3(n);
        float stretch = span - tableRestLength(entry, spring.w, time);
        float tension = stiffness * stretch + damping * dot(along, moved - known);
        sum -= vec3(n) * tension;
        double turning = double(clamp(tension / span, 0.0, stiffness + damping));
        dmat3 change = outerProduct(n, n * (double(stiffness + damping) - turning));
        for (int k = 0; k < 3; ++k) change[k][k] += turning;
        diagonal += change;
        int block = int(table(matrixTable() + int(own.y) + s).x);
        if (block >= 0 && isOwn(i)) setMatrixBlock(block, matrixBlock(block) - change);
    }
    if (own.x < 0.0 || !isOwn(i)) return;
    bool free = weight[i] > 0.0;
    setMatrixBlock(int(own.x), free ? diagonal : dmat3(0.0));
    setNumbers(SOLUTION + 3 * vertex, free ? dvec3(sum) : dvec3(0.0));
}

void takeNewtonStep(float time)
{
    waitForNumbers();
    for (int i = 0; i < VERTICES; ++i) {
        share(PLACES, i, x[i]);
        share(VELOCITIES, i, q[i]);
        if (isOwn(i)) setNumbers(KNOWN + 3 * vertexOf(i), dvec3(z[i]));
    }
    clearMatrix();
    waitForNumbers();
    for (int i = 0; i < VERTICES; ++i) {
        assemble(i, time);
    }
    solveMatrix();
}

// A substep up to contact.
void advance(int step)
{
    restart = anyLane(restart);
    predict(step);
    float time = float(step + 1) * substep;
#ifdef WAVES
    moveMuscles(time);
#endif
    bool settled = false;
    int last = newtonStep + int(table(matrixTable()).w);
    do {
        ++newtonStep;
        takeNewtonStep(time);
        bool moves = false;
        for (int i = 0; i < VERTICES; ++i) {
            vec3 change = weight[i] > 0.0 && !settled ? vec3(numbers(SOLUTION + 3 * vertexOf(i))) : vec3(0.0);
            q[i] += change;
            moves = moves || dot(change, change) > SETTLED * scale * scale;
        }
        if (moves) {
            unsettled[column()] = newtonStep;
            unsettled[LANES] = newtonStep;
        }
        waitForGroup();
        settled = settled || unsettled[column()] < newtonStep;
    } while (unsettled[LANES] == newtonStep && newtonStep < last);
    accept();
}

void finishSolver()
{
    endHistory();
}
