// Contact of the molecule's vertices with several colliders, thin ones or moving ones, after a substep's drift. Needs fused/answers.glsl and
// generated/colliders.glsl.
#include "fused/clear_around.glsl"

bool walks[VERTICES];  // whether its way through the substep has to be followed

// Returns whether a vertex that is not held lies inside a collider, or may have crossed one, after `done` substeps.
// Where the nearest surface is enough, the vertices that it alone concerns are answered here, and only the others are
// reported.
bool findContacts(int done)
{
    const bool answersHere = nearestIsEnough && !RIGID_IMPACT;
    bool found = false;
    bool counts = mayAnswer();
    beginAnswers();
    for (int k = 0; k < VERTICES; ++k) {
        bool open = counts && !isHeld(pinned[k]);
        if (answersHere) {
            Contact c = Contact(touchPosition[k], touchVelocity[k]);
            bool answered = answerNearest(anchor, c, driftedBy[k], DRIFT_OF(k));
            walks[k] = open && !answered;
            bool moves = open && answered;
            touchPosition[k] = moves ? c.position : touchPosition[k];
            touchVelocity[k] = moves ? c.velocity : touchVelocity[k];
        } else {
            walks[k] = open && margin(anchor, touchPosition[k], driftedBy[k], substep, contactTime(done)) < 0.0;
        }
        found = found || walks[k];
    }
    if (answersHere) acceptAnswers(contactTime(done));
    return found;
}

Contact follow(Contact c, vec3 drifted, vec3 pressed, vec3 beyond, int done)
{
    vec3 fall = fallAt(anchor, c.position);
    return collideAll(anchor, c.position, c.velocity, drifted, fall, DRIFT(fall + pressed, beyond), contactTime(done));
}

// Each lane takes its next vertex, from registers: an array that a variable looks up is memory, which a CPU rasteriser
// reads lane by lane, and takes six times as long to compile (24 vertices, bdf2-xpbd, Mesa 22.3).
void followNext(int done)
{
    int next = 0;
    while (next >= 0) {
        Contact c = Contact(vec3(0.0), vec3(0.0));
        vec3 drifted = vec3(0.0);
        vec3 beyond = vec3(0.0);
        vec3 pressed = vec3(0.0);
        next = -1;
        for (int i = 0; i < VERTICES; ++i) {
            if (walks[i]) {
                next = i;
                c = Contact(touchPosition[i], touchVelocity[i]);
                drifted = driftedBy[i];
                pressed = PRESSED(i);
                beyond = beyondBy[i];
            }
        }
        if (next >= 0) c = follow(c, drifted, pressed, beyond, done);
        for (int i = 0; i < VERTICES; ++i) {
            if (next == i) {
                walks[i] = false;
                take(i, c);
            }
        }
    }
}

// Resolves the contacts of all vertices, as fused/contact.glsl does.
void resolveContacts(int done)
{
    beginAnswers();
    if (!LANE_A_VERTEX) {
        followNext(done);
    } else {
        for (int n = 0; n < VERTICES; ++n) {
            if (walks[n]) take(n, follow(Contact(touchPosition[n], touchVelocity[n]), driftedBy[n], PRESSED(n), beyondBy[n], done));
        }
    }
    answerAsBody();
    acceptAnswers(contactTime(done));
}
