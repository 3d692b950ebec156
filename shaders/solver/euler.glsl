// euler: symplectic Euler with drag and gravity taken exactly (Latta, 3 and 8), order 1.
//   v by the thrust over h;  v += h F(x, v, t) / m;  v += drag and gravity at x, t;  x += h v;  contact
// VERLET: the same, then v = (x' - x) / h (solver/verlet.glsl).

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
#ifdef VERLET
            vec3 before = x[i];
            x[i] += dragged(v[i], fluid[i], FALL(i), normal[i]) * substep;
            v[i] = (x[i] - before) / substep;
#else
            v[i] = dragged(v[i], fluid[i], FALL(i), normal[i]);
            x[i] += v[i] * substep;
#endif
        }
    }
}

void finishSolver()
{
}
