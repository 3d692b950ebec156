// The vertices as contact with colliders takes them up and leaves them. Of the solver: SPRUNG(i), what its springs accelerate vertex i by,
// m/s^2, and OWED(i), what it still owes to its velocity of the springs' kicks (owesKick), m/s, and contact answers as well.

// The loops work on copies, so that x and v stay in registers where these loops are kept (a long text for many
// colliders).
vec3 touchPosition[VERTICES];
vec3 touchVelocity[VERTICES];
vec3 driftedBy[VERTICES];      // m/s
vec3 beyondBy[VERTICES];       // m, of a solver with a history (physics/collide.glsl)
vec3 startPlace[VERTICES];     // m, before contact
vec4 struck[VERTICES];         // the last surface's normal and friction; w negative: none
vec3 struckSurface[VERTICES];  // m/s, its velocity

// Returns the time after so many substeps, s since the frame's start; 0 where no collider moves.
float contactTime(int done)
{
    return collidersMove ? float(done) * substep : 0.0;
}

// The acceleration that presses vertex i on a collider beside gravity and forces, m/s^2. A rigid body's springs press on none of
// its vertices.
#define PRESSED(i) (SPRINGS && !RIGID_IMPACT ? LOAD(i) + SPRUNG(i) : LOAD(i))

// The drift of vertex i, as physics/collide.glsl takes it.
#define DRIFT_OF(i) DRIFT(fallAt(anchor, touchPosition[i]) + PRESSED(i), beyondBy[i])

// Copies the vertices for contact.
void beginAnswers()
{
    for (int i = 0; i < VERTICES; ++i) {
        startPlace[i] = x[i];
        struck[i] = vec4(0.0, 0.0, 0.0, -1.0);
        touchPosition[i] = x[i];
        touchVelocity[i] = v[i] + OWED(i);
        driftedBy[i] = v[i];
        beyondBy[i] = wayBeyond(dx[i], dv[i], v[i]);
    }
}

// Takes over the vertices as contact has left them.
void acceptAnswers(float time)
{
    bool impact = false;
    for (int i = 0; i < VERTICES; ++i) {
        if (hasHistory && (touchPosition[i] != x[i] || touchVelocity[i] != v[i]))
            impact = changeHistory(touchPosition[i] - x[i], touchVelocity[i] - v[i], dx[i], dv[i], v[i]) || impact;
        touched = touched || touchPosition[i] != x[i] || touchVelocity[i] != v[i] + OWED(i);
        v[i] = owesKick ? withoutKick(touchVelocity[i], v[i], OWED(i)) : touchVelocity[i];
        x[i] = touchPosition[i];
    }
    if (impact) forgetHistory();
    findFooting(time);
}

// Whether this step resolves contact with colliders: not where other molecules hold a rigid one off them.
bool mayAnswer()
{
    return taken() && !(MAY_BE_HELD && heldByContact);
}

// Keeps the answer of a vertex.
void take(int k, Contact c)
{
    touchPosition[k] = c.position;
    touchVelocity[k] = c.velocity;
    struck[k] = struckLast;
    struckSurface[k] = struckVelocity;
}
