// Contact of the molecule's vertices with the colliders, after a substep's drift. Needs fused/step.glsl and
// generated/colliders.glsl.

// m/s, of the springs' kicks: what leapfrog still owes to the velocity of vertex i, and what contact answers without it.
#if defined(LEAPFROG) && defined(SPRINGS)
#define OWED(i) (acceleration[i] * (0.5 * substep))
#define ANSWERED(i) withoutKick(touchVelocity[i], v[i], OWED(i))
#else
#define OWED(i) vec3(0.0)
#define ANSWERED(i) touchVelocity[i]
#endif

// The loops work on copies, so that x and v stay in registers where these loops are kept (a long text for many
// colliders).
vec3 touchPosition[VERTICES];
vec3 touchVelocity[VERTICES];
#if defined(RIGID_IMPACT) || defined(JOINT_CONTACT)
vec3 driftedBy[VERTICES];  // m/s
#endif
#ifdef RIGID_IMPACT
vec3 startPlace[VERTICES];     // m, before contact
vec4 struck[VERTICES];         // the last surface's normal and friction; w negative: none
vec3 struckSurface[VERTICES];  // m/s, its velocity
#include "fused/body.glsl"
#endif
#ifdef JOINT_CONTACT
vec3 askedPosition[VERTICES];  // apart from the above, whose loop is always kept: these stay in registers
vec3 askedVelocity[VERTICES];

// s, since the frame's start, when so many substeps are done; 0 where no collider moves.
float contactTime(int done)
{
    return collidersMove ? float(done) * substep : 0.0;
}
#endif

#ifdef KEEP_SURFACE
// The surfaces that findContacts() found: a height field costs more to look up than to keep.
vec4 seen[VERTICES];
#endif

// Whether a vertex that is not held lies inside a collider, after so many substeps.
bool findContacts(int done)
{
    float least = 1e30;
#ifdef JOINT_CONTACT
    for (int i = 0; i < VERTICES; ++i) {
        askedPosition[i] = x[i];
        askedVelocity[i] = v[i];
    }
    for (int k = 0; k < VERTICES; ++k) {
        if (!isHeld(pinned[k])) least = min(least, margin(anchor, askedPosition[k], askedVelocity[k], substep, contactTime(done)));
    }
#else
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
#endif
#ifdef LIFE
    if (!taken()) least = 1.0;
#endif
    return least < 0.0;
}

// Resolves the contacts of all vertices. One that does not touch changes only where the molecule answers as a
// rigid body (RIGID_IMPACT).
void resolveContacts(int done)
{
    for (int i = 0; i < VERTICES; ++i) {
        touchPosition[i] = x[i];
        touchVelocity[i] = v[i] + OWED(i);
#if defined(RIGID_IMPACT) || defined(JOINT_CONTACT)
        driftedBy[i] = v[i];
#endif
#ifdef RIGID_IMPACT
        startPlace[i] = x[i];
        struck[i] = vec4(0.0, 0.0, 0.0, -1.0);
#endif
    }
#ifdef JOINT_CONTACT
    bool changed = false;
    for (int n = 0; n < VERTICES; ++n) {
        if (!isHeld(pinned[n]) &&
            margin(anchor, touchPosition[n], driftedBy[n], substep, contactTime(done)) < 0.0) {
            Contact c = collideAll(anchor, touchPosition[n], touchVelocity[n], driftedBy[n], fallAt(anchor, touchPosition[n]) + LOAD(n),
                                   Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z), contactTime(done));
            changed = changed || c.position != touchPosition[n] || c.velocity != touchVelocity[n];
            touchPosition[n] = c.position;
            touchVelocity[n] = c.velocity;
#ifdef RIGID_IMPACT
            struck[n] = struckLast;
            struckSurface[n] = struckVelocity;
#endif
        }
    }
#else
    for (int k = 0; k < VERTICES; ++k) {
        if (!isHeld(pinned[k])) {
#ifdef KEEP_SURFACE
            vec4 surface = seen[k];
#else
            vec4 surface = surfaceAt(anchor, touchPosition[k]);
#endif
            Contact c = answerTo(surface, touchPosition[k], touchVelocity[k], fallAt(anchor, touchPosition[k]) + LOAD(k),
                                 Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z));
            touchPosition[k] = c.position;
            touchVelocity[k] = c.velocity;
#ifdef RIGID_IMPACT
            struck[k] = struckLast;
            struckSurface[k] = struckVelocity;
#endif
        }
    }
#endif
#ifdef RIGID_IMPACT
    answerAsBody();
#endif
    for (int i = 0; i < VERTICES; ++i) {
#ifdef TOUCH_COUNTS
        touched = touched || touchPosition[i] != x[i] || touchVelocity[i] != v[i] + OWED(i);
#endif
        v[i] = ANSWERED(i);
        x[i] = touchPosition[i];
    }
#ifdef HISTORY
#ifdef JOINT_CONTACT
    if (changed)
#endif
    forgetHistory();
#endif
}
