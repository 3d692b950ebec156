// leapfrog: order 2; one evaluation of the springs a substep, and one more to start a frame.
//   v += a h/2;  x1 = x + v h/2;  v += drag and gravity over h at x1, t + h/2;  x = x1 + v h/2;  contact;
//   a = F(x, v + a h/2, t + h) / m;  v += a h/2
// A thrust acts over h/2 before and after all of it.
// The loop over the substeps is turned so that contact is its end: the second half kick of a substep opens the next
// one, and finishSolver() gives the last. The first opens with a = F(x, v, t) / m and no kick.

vec3 acceleration[VERTICES];  // m/s^2, of the springs
#define SPRUNG(i) acceleration[i]
const bool owesKick = SPRINGS;
#define OWED(i) (SPRINGS ? acceleration[i] * (0.5 * substep) : vec3(0.0))

// It holds nothing on colliders within its stages, as Runge-Kutta methods do.
void findFooting(float time)
{
}

void beginSolver()
{
    for (int i = 0; i < VERTICES; ++i) {
        acceleration[i] = vec3(0.0);
    }
}

// Forces at time, from the velocity kickTime ahead, and the kick over kickTime. `step`: substeps done.
void kickBySprings(int step, float kickTime)
{
    if (SPRINGS) {
        for (int i = 0; i < VERTICES; ++i) {
            w[i] = v[i] + acceleration[i] * kickTime;
        }
        springForces(float(step) * substep);
    }
    letGo(step);
    if (!SPRINGS) return;
    for (int i = 0; i < VERTICES; ++i) {
        acceleration[i] = isHeld(pinned[i]) ? vec3(0.0) : force[i] * inverseMass[i];
        v[i] += acceleration[i] * kickTime;
    }
}

// A substep up to contact.
void advance(int step)
{
    float halfStep = 0.5 * substep;
    kickBySprings(step, step == 0 ? 0.0 : halfStep);
    // The halves of two substeps are not one whole: at its limit a thrust does not commute with one that damps.
    if (step > 0) thrust(false);
    thrust(false);
    for (int i = 0; i < VERTICES; ++i) {
        if (SPRINGS) v[i] += acceleration[i] * halfStep;
        probe[i] = x[i] + v[i] * halfStep;
    }
    if (isDirectional) surfaceNormals();
    sampleSubstep((float(step) + 0.5) * substep);
    driftAll();
}

void finishSolver()
{
    kickBySprings(substeps, 0.5 * substep);
    thrust(false);
}
