// Contact of the molecule's vertices with the colliders, after a substep's drift. Needs fused/step.glsl,
// generated/colliders.glsl, and of the solver SPRUNG(i), what its springs accelerate vertex i by, m/s^2.
#include "fused/answers.glsl"
#include "fused/clear_around.glsl"

// Returns whether a vertex that is not held lies inside a collider, or may have crossed one, after `done` substeps.
// With NEAREST, the vertices that only their nearest surface concerns are answered here, and only the others are
// reported.
bool findContacts(int done)
{
    bool found = false;
    bool counts = true;
#ifdef LIFE
    counts = taken();
#endif
#if defined(RIGID_IMPACT) && defined(REMEMBERS) && !defined(TOUCH_COUNTS)
    counts = counts && !heldByContact;
#endif
#ifdef JOINT_CONTACT
    beginAnswers();
    for (int k = 0; k < VERTICES; ++k) {
#if defined(NEAREST) && !defined(RIGID_IMPACT)
        Contact c = Contact(touchPosition[k], touchVelocity[k]);
        bool answered = answerNearest(anchor, c, driftedBy[k], DRIFT_OF(k));
        bool open = counts && !isHeld(pinned[k]);
        walks[k] = open && !answered;
        bool moves = open && answered;
        touchPosition[k] = moves ? c.position : touchPosition[k];
        touchVelocity[k] = moves ? c.velocity : touchVelocity[k];
#else
        walks[k] = counts && !isHeld(pinned[k]) &&
                   margin(anchor, touchPosition[k], driftedBy[k], substep, contactTime(done)) < 0.0;
#endif
        found = found || walks[k];
    }
#if defined(NEAREST) && !defined(RIGID_IMPACT)
    acceptAnswers(contactTime(done));
#endif
#else
    float least = 1e30;
    for (int i = 0; i < VERTICES; ++i) {
        touchPosition[i] = x[i];
    }
    for (int k = 0; k < VERTICES; ++k) {
#ifdef KEEP_SURFACE
        seen[k] = surfaceAt(anchor, touchPosition[k]);
        if (!isHeld(pinned[k])) least = min(least, seen[k].w);
#else
        if (!isHeld(pinned[k])) least = min(least, clearance(anchor, touchPosition[k], 0.0));
#endif
    }
    found = counts && least < 0.0;
#endif
    return found;
}

#ifdef JOINT_CONTACT
Contact follow(Contact c, vec3 drifted, vec3 pressed, vec3 beyond, int done)
{
    vec3 fall = fallAt(anchor, c.position);
    return collideAll(anchor, c.position, c.velocity, drifted, fall, DRIFT(fall + pressed, beyond), contactTime(done));
}
#endif

// Keeps the answer of a vertex.
void take(int k, Contact c)
{
    touchPosition[k] = c.position;
    touchVelocity[k] = c.velocity;
#ifdef RIGID_IMPACT
    struck[k] = struckLast;
    struckSurface[k] = struckVelocity;
#endif
}

// Resolves the contacts of all vertices. One that does not touch changes only where the molecule answers as a
// rigid body (RIGID_IMPACT).
void resolveContacts(int done)
{
    beginAnswers();
#ifdef RIGID_IMPACT
    for (int i = 0; i < VERTICES; ++i) {
        startPlace[i] = x[i];
        struck[i] = vec4(0.0, 0.0, 0.0, -1.0);
    }
#endif
#ifdef JOINT_CONTACT
#ifndef MOLECULE_VERTICES
    // Each lane takes its next vertex, from registers: an array that a variable looks up is memory, which a CPU rasteriser
    // reads lane by lane, and takes six times as long to compile (24 vertices, bdf2-xpbd, Mesa 22.3).
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
                beyond = BEYOND(i);
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
#else
    for (int n = 0; n < VERTICES; ++n) {
        if (walks[n]) take(n, follow(Contact(touchPosition[n], touchVelocity[n]), driftedBy[n], PRESSED(n), BEYOND(n), done));
    }
#endif
#else
    for (int k = 0; k < VERTICES; ++k) {
        if (!isHeld(pinned[k])) {
#ifdef KEEP_SURFACE
            vec4 surface = seen[k];
#else
            vec4 surface = surfaceAt(anchor, touchPosition[k]);
#endif
            take(k, answerTo(surface, touchPosition[k], touchVelocity[k], DRIFT_OF(k)));
        }
    }
#endif
#ifdef RIGID_IMPACT
    answerAsBody();
#endif
    acceptAnswers(contactTime(done));
}
