// euler: symplectic Euler with drag and gravity taken exactly (Latta, 3 and 8), order 1.
//   v by the thrust over h;  v += h F(x, v, t) / m;  v += drag and gravity at x, t;  x += h v;  contact
// VERLET: the same, then v = (x' - x) / h (solver/verlet.glsl).

vec3 sprungBy[VERTICES];  // m/s^2, of the springs, for contact
#define SPRUNG(i) sprungBy[i]
#define OWED(i) vec3(0.0)
const bool owesKick = false;

// It holds nothing on colliders within its stages, as Runge-Kutta methods do.
void findFooting(float time)
{
}

void beginSolver()
{
    for (int i = 0; i < VERTICES; ++i) {
        sprungBy[i] = vec3(0.0);
    }
}

// A substep up to contact.
void advance(int step)
{
    float time = float(step) * substep;
    thrust(true);
    kickWhole(step, time);
    for (int i = 0; i < VERTICES; ++i) {
        sprungBy[i] = carried(sprungBy[i], force[i] * inverseMass[i]);
    }
    sampleHere(time);
    driftAll();
}

void finishSolver()
{
}
