// xpbd: small steps, one sweep over the springs each, order 1 [Macklin 2019].
//   v += drag and gravity at x, t;  q = h v;  one sweep moves q;  v = q / h;  x += q;  contact

vec3 sprungBy[VERTICES];  // m/s^2, of the springs over the substep, for contact
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
    acrossLess = isDirectional ? 1.0 - phi.x / phi.y : 0.0;
}

// A substep up to contact.
void advance(int step)
{
    float time = float(step) * substep;
    thrust(true);
    releasePins(step);
    sampleHere(time);
    for (int i = 0; i < VERTICES; ++i) {
        bool held = isHeld(pinned[i]);
        z[i] = vec3(0.0);
        w[i] = held ? vec3(0.0) : dragged(v[i], fluid[i], FALL(i), normal[i]);
        q[i] = w[i] * substep;
        weight[i] = held ? 0.0 : inverseMass[i] * (substep * phi.y);
    }
    if (SPRINGS) relaxForward(time + substep, 1.0 / substep);
    for (int i = 0; i < VERTICES; ++i) {
        v[i] = q[i] / substep;
        sprungBy[i] = carried(sprungBy[i], (v[i] - w[i]) / substep);
        x[i] += q[i];
    }
}

void finishSolver()
{
}
