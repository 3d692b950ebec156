// bdf2-xpbd: BDF2 (fused/bdf2.glsl) whose stage is solved by two sweeps over the springs, there and back.

void beginSolver()
{
    beginHistory();
}

// A substep up to contact.
void advance(int step)
{
    predict(step);
    float time = float(step + 1) * substep;
    if (SPRINGS) relaxForward(time, 1.0 / eta);
    if (SPRINGS) relaxBackward(time, 1.0 / eta);
    accept();
}

void finishSolver()
{
    endHistory();
}
