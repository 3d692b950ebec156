// bdf2-xpbd: BDF2 (fused/bdf2.glsl) whose stage is solved by two sweeps over the springs, there and back.

void beginSolver()
{
    beginHistory();
}

// A substep up to contact.
void advance(int step)
{
    predict(step);
#ifdef SPRINGS
    float time = float(step + 1) * substep;
    relaxForward(time, 1.0 / eta);
    relaxBackward(time, 1.0 / eta);
#endif
    accept();
}

void finishSolver()
{
    endHistory();
}
