// euler: symplectic Euler with drag and gravity taken exactly (Latta, 3 and 8), order 1.
//   v by the thrust over h;  v += h F(x, v, t) / m;  v += drag and gravity at x, t;  x += h v;  contact
// VERLET: the same, then v = (x' - x) / h (solver/verlet.glsl).
#include "step/drift.glsl"

void beginSolver()
{
}

// A substep up to contact.
void advance(int step)
{
    float time = float(step) * substep;
    thrust(true);
    kickWhole(step, time);
    sampleHere(time);
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) {
            vec3 before = x[i];
            vec3 ended = dragged(v[i], fluid[i], FALL(i), normal[i]);
            x[i] += driftOf(v[i], ended);
            v[i] = velocityAfter(ended, x[i] - before);
        }
    }
}

void finishSolver()
{
}
