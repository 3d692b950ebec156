// euler: symplectic Euler with drag and gravity taken exactly (Latta, 3 and 8), order 1.
//   v by the thrust over h;  v += h F(x, v, t) / m;  v += drag and gravity at x, t;  x += h v;  contact
// VERLET: the same, then v = (x' - x) / h (solver/verlet.glsl).

// m/s^2, for fused/contact.glsl.
#define SPRUNG(i) (force[i] * inverseMass[i])

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
    driftAll();
}

void finishSolver()
{
}
