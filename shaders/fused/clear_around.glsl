// A ball within which a molecule cannot touch anything in a frame.

// No surface reaches into the ball around the place of the first vertex when the frame begins.
vec3 clearAround;   // m
float clearRadius;  // m, negative inside

void beginContact()
{
    if (!areBounded) return;
    clearAround = x[0];
    clearRadius = 0.99 * clearance(anchor, clearAround, 0.0) - 1e-4;  // less than distances are rounded by
}

// Whether the ways of this substep may have left that ball.
bool mayTouch()
{
    if (!areBounded) return true;
    float away = 0.0;
    float fastest = 0.0;
    for (int i = 0; i < VERTICES; ++i) {
        vec3 apart = x[i] - clearAround;
        away = max(away, dot(apart, apart));
        fastest = max(fastest, dot(v[i], v[i]));
    }
    return !(sqrt(away) + sqrt(fastest) * substep < clearRadius);
}
