// euler: symplectic Euler with drag and gravity taken exactly (Latta, 3 and 8), order 1.
//   v += h F(x, v, t) / m;  v += drag and gravity at x, t;  x += h v;  contact

void beginSolver()
{
}

// A substep up to contact.
void advance(int step)
{
    float time = frameTime + float(step) * substep;
#ifdef SPRINGS
    for (int i = 0; i < VERTICES; ++i) {
        w[i] = v[i];
    }
    springForces(time);
#endif
    letGo(step);
#ifdef SPRINGS
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) v[i] += force[i] * (inverseMass[i] * substep);
    }
#endif
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i];
    }
#ifdef DIRECTIONAL_DRAG
    surfaceNormals();
#endif
    sampleSubstep(time);
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) {
            v[i] = dragged(v[i], fluid[i], normal[i]);
            x[i] += v[i] * substep;
        }
    }
}

void finishSolver()
{
}
