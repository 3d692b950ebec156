// The vertices as contact with colliders takes them up and leaves them.

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
bool walks[VERTICES];  // whether its way through the substep has to be followed
#endif

// s, since the frame's start, when so many substeps are done; 0 where no collider moves.
float contactTime(int done)
{
#ifdef JOINT_CONTACT
    if (collidersMove) return float(done) * substep;
#endif
    return 0.0;
}

#ifdef KEEP_SURFACE
// The surfaces that findContacts() found: a height field costs more to look up than to keep.
vec4 seen[VERTICES];
#endif

// m/s^2, what presses vertex i on beside gravity and forces. A body answers for its springs as a whole.
#if defined(SPRINGS) && !defined(RIGID_IMPACT)
#define PRESSED(i) (LOAD(i) + SPRUNG(i))
#else
#define PRESSED(i) LOAD(i)
#endif

// A vertex's drift as physics/collide.glsl has it.
#ifdef HISTORY
vec3 beyondBy[VERTICES];  // m
#define BEYOND(i) beyondBy[i]
#define DRIFT(acceleration, beyond) Drift(driftOfStep.x, kickDrift, driftOfStep.z, acceleration, beyond)
#else
#define BEYOND(i) vec3(0.0)
#define DRIFT(acceleration, beyond) Drift(driftOfStep.x, driftOfStep.y, driftOfStep.z, acceleration)
#endif
#define DRIFT_OF(i) DRIFT(fallAt(anchor, touchPosition[i]) + PRESSED(i), BEYOND(i))

// The vertices as contact takes them up.
void beginAnswers()
{
    for (int i = 0; i < VERTICES; ++i) {
        touchPosition[i] = x[i];
        touchVelocity[i] = v[i] + OWED(i);
#if defined(RIGID_IMPACT) || defined(JOINT_CONTACT)
        driftedBy[i] = v[i];
#endif
#ifdef HISTORY
        beyondBy[i] = wayBeyond(dx[i], dv[i], v[i]);
#endif
    }
}

// Takes over the vertices as contact has left them.
void acceptAnswers(float time)
{
#ifdef HISTORY
    bool impact = false;
#endif
    for (int i = 0; i < VERTICES; ++i) {
#ifdef HISTORY
        if (touchPosition[i] != x[i] || touchVelocity[i] != v[i])
            impact = changeHistory(touchPosition[i] - x[i], touchVelocity[i] - v[i], dx[i], dv[i], v[i]) || impact;
#endif
#ifdef TOUCH_COUNTS
        touched = touched || touchPosition[i] != x[i] || touchVelocity[i] != v[i] + OWED(i);
#endif
        v[i] = ANSWERED(i);
        x[i] = touchPosition[i];
    }
#ifdef HISTORY
    if (impact) forgetHistory();
#endif
#ifdef FOOTING
    findFooting(time);
#endif
}
