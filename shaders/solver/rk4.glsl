// rk4: the classical Runge-Kutta method, order 4; four evaluations of everything a substep, drag among it.

PER_VERTEX startPosition[VERTICES];
PER_VERTEX startVelocity[VERTICES];
PER_VERTEX sumVelocity[VERTICES];      // of b v
PER_VERTEX sumAcceleration[VERTICES];  // of b a

void beginSolver()
{
}

// The accelerations of a stage at x, v; adds them up and moves x, v to the next.
// `step`: 0 in the frame's first stage, where pins may be released.
void stage(int step, float time, float share, float ahead)
{
#ifdef SPRINGS
    for (int i = 0; i < VERTICES; ++i) {
        w[i] = v[i];
    }
    springForces(time);
#endif
    letGo(step);
    sampleHere(time);
    for (int i = 0; i < VERTICES; ++i) {
        vec3 a = dragAcceleration(v[i], fluid[i], FALL(i), normal[i]);
#ifdef SPRINGS
        a += force[i] * inverseMass[i];
#endif
        sumVelocity[i] += v[i] * share;
        sumAcceleration[i] += a * share;
        bool held = isHeld(pinned[i]);
        x[i] = held ? x[i] : startPosition[i] + v[i] * ahead;
        v[i] = held ? v[i] : startVelocity[i] + a * ahead;
    }
}

// A substep up to contact. A thrust, which is not smooth at its limit, acts exactly before and after it: of order 2.
void advance(int step)
{
    thrust(false);
    for (int i = 0; i < VERTICES; ++i) {
        startPosition[i] = x[i];
        startVelocity[i] = v[i];
        sumVelocity[i] = vec3(0.0);
        sumAcceleration[i] = vec3(0.0);
    }
    float start = float(step) * substep;
    for (int s = 0; s < 4; ++s) {
        bool outer = s == 0 || s == 3;
        float at = s == 0 ? 0.0 : s == 3 ? 1.0 : 0.5;
        float ahead = s == 2 ? 1.0 : s == 3 ? 0.0 : 0.5;
        stage(s == 0 ? step : 1, start + at * substep, outer ? 1.0 / 6.0 : 1.0 / 3.0, ahead * substep);
    }
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) {
            x[i] = startPosition[i] + sumVelocity[i] * substep;
            v[i] = startVelocity[i] + sumAcceleration[i] * substep;
        }
    }
    thrust(false);
}

void finishSolver()
{
}
