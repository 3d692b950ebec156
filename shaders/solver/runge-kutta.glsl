// The explicit Runge-Kutta methods, whose coefficients stand in src/scene/solver.cpp: STAGES evaluations of everything a
// substep, drag among it.
// A vertex that begins a substep at rest on a collider is held by it in every stage: if it fell in the stages and were put
// back by contact after them, the springs would have felt that, and the rest of its molecule would never lie still.
#include "generated/stages.glsl"

vec3 startPosition[VERTICES];
vec3 startVelocity[VERTICES];
vec3 sumVelocity[VERTICES];      // of b v
vec3 sumAcceleration[VERTICES];  // of b a

// m/s^2, of the springs and of drag over the substep, for contact.
#define SPRUNG(i) (sumAcceleration[i] - FALL(i))
#define OWED(i) vec3(0.0)
const bool owesKick = false;

vec4 standsOn[VERTICES];  // what a vertex at rest rests on: its normal and friction; w negative: nothing

void findFooting(float time)
{
    for (int k = 0; k < VERTICES; ++k) {
        standsOn[k] = v[k] == vec3(0.0) ? footing(anchor, x[k], time) : vec4(0.0, 0.0, 0.0, -1.0);
        touched = touched || standsOn[k].w >= 0.0;
    }
}

void beginSolver()
{
    if (COLLIDE) findFooting(0.0);
}

// Stage s: adds up its rates at x, v and moves x, v to the next, or to the substep's end.
// `step`: 0 in the frame's first stage, where pins may be released.
void stage(int s, int step, float time)
{
    springForcesNow(step, time);
    sampleHere(time);
    for (int i = 0; i < VERTICES; ++i) {
        vec3 a = dragAcceleration(v[i], fluid[i], FALL(i), normal[i]);
        if (SPRINGS) a += force[i] * inverseMass[i];
        if (COLLIDE) a = heldBy(standsOn[i].xyz, standsOn[i].w, a);
        sumVelocity[i] += v[i] * shareOf(s);
        sumAcceleration[i] += a * shareOf(s);
        if (!isHeld(pinned[i])) {
            x[i] = afterStage(s, startPosition[i], v[i], sumVelocity[i]);
            v[i] = afterStage(s, startVelocity[i], a, sumAcceleration[i]);
        }
    }
}

// A substep up to contact. A thrust, which is not smooth at its limit, acts exactly before and after it: of order 2.
void advance(int step)
{
    thrust(false);
    for (int i = 0; i < VERTICES; ++i) {
        startPosition[i] = x[i];
        startVelocity[i] = v[i];
        if (v[i] != vec3(0.0)) standsOn[i].w = -1.0;
        sumVelocity[i] = vec3(0.0);
        sumAcceleration[i] = vec3(0.0);
    }
    float start = float(step) * substep;
    for (int s = 0; s < STAGES; ++s) {
        stage(s, s == 0 ? step : 1, start + stageTime(s));
    }
    thrust(false);
}

void finishSolver()
{
}
