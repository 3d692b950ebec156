// BDF2, whatever solves its stage: order 2, L-stable.
//
//   z = dx / 3,  w = v + dv / 3,  eta = 2h/3;  a stage gives q;  v' = (q - z) / eta;  dv = v' - v;  dx = q;  x += q
//
// dx and dv are the changes of the last substep. They are part of the state, so that a frame goes on where the last
// one ended: a one-step method at the start of every frame (SDIRK2, TR-BDF2) costs a second stage, and the velocity
// that an unfinished stage leaves it with made pinned molecules of 1e6 N/m and more wander.
//
// Where there is no history - at the start, after an impact, when pins have been released, when the substep
// or a slider has changed - a step is exact for free flight in a fluid of that velocity, however heavy the
// drag, and takes the springs by backward Euler:
//
//   z = flight - h flown,  q = flight without springs,  eta = h
//
// where flown and flight are the velocity and the way after h. A molecule that lies on colliders keeps its history: begun anew in
// every step, vertices that springs hold up would take a velocity of g h / 2 for rest.
#include "fused/stage.glsl"

vec3 dx[VERTICES];  // m, the last substep's displacement; x of one of them NO_HISTORY: none
vec3 dv[VERTICES];  // m/s, its change of velocity
const float noHistory = NO_HISTORY;
bool restart;
float eta;  // s, of this step
float kickDrift;  // s, for contact (physics/collide.glsl)
vec3 unsprung[VERTICES];  // m/s, the velocity without springs

// m/s^2, of the springs at the substep's end, for contact.
#define SPRUNG(i) ((v[i] - unsprung[i]) / eta)
#define OWED(i) vec3(0.0)
const bool owesKick = false;
#define DRIFT(acceleration, beyond) Drift(driftOfStep.x, kickDrift, driftOfStep.z, acceleration, beyond)

// It holds nothing on colliders within its stages, as Runge-Kutta methods do.
void findFooting(float time)
{
}

const float third = 1.0 / 3.0;

void beginHistory()
{
    restart = restarts != 0;
    for (int i = 0; i < VERTICES; ++i) {
        restart = restart || dx[i].x > 0.5 * NO_HISTORY;
    }
}

// Makes the step after an impact start without history.
void forgetHistory()
{
    restart = true;
}

// How far a vertex's way differs from that of a constant acceleration from v - dv to v, m.
vec3 wayBeyond(vec3 moved, vec3 gained, vec3 ended)
{
    return moved - (ended - 0.5 * gained) * substep;
}

// Adds to a vertex's history how contact has changed its place (m) and velocity (m/s). Returns whether that was an impact: whether
// the step has changed the velocity by more than gravity does in two, or the way likewise. Where there are no springs, to which a
// step begun anew is exact, or no gravity, anything beyond a rounding is one.
bool changeHistory(vec3 shift, vec3 change, inout vec3 displacement, inout vec3 gained, vec3 ended)
{
    gained += change;
    vec3 along = (ended + change - 0.5 * gained) * substep;
    vec3 off = displacement + shift - along;
    displacement = along;  // what rests leaves no rounding of a way
    float fall = SPRINGS ? 2.0 * length(gravity) * substep : 0.0;
    return length(gained) > max(fall, 1e-5) || length(off) > max(fall * substep, 1e-6);
}

void endHistory()
{
    if (restart) dx[0].x = NO_HISTORY;
}

// Applies a thrust over h before the stage, which takes forces at its end. The thrust is that of v + dv / 2, which is
// of order 2; dv itself is without the thrust. In a step without history it acts over h/2 here, and over h/2 again when
// the stage is accepted.
void thrustAhead()
{
#ifdef THRUST
    for (int i = 0; i < VERTICES; ++i) {
        w[i] = restart ? v[i] : v[i] + dv[i] * 0.5;
    }
    thrustBy(!restart);
#endif
}

// Finds the stage's solution without springs.
void predict(int step)
{
    bool held = !released;
    releasePins(step);
    restart = restart || (held && released);  // a molecule that its pins held until now has no history
    thrustAhead();
    eta = restart ? substep : stageEta;
    kickDrift = restart ? 0.5 * substep : stageEta;
    vec2 stepPhi = restart ? phi : stagePhi;
    acrossLess = isDirectional ? 1.0 - stepPhi.x / stepPhi.y : 0.0;
    for (int i = 0; i < VERTICES; ++i) {
        vec3 ahead = restart ? v[i] * substep : dx[i] * third + (v[i] + dv[i] * third) * stageEta;
        probe[i] = x[i] + (isHeld(pinned[i]) ? vec3(0.0) : ahead);
    }
    if (isDirectional) surfaceNormals();
    sampleSubstep(float(step + 1) * substep);
    for (int i = 0; i < VERTICES; ++i) {
        bool held = isHeld(pinned[i]);
        vec3 flown = dragged(v[i], fluid[i], FALL(i), normal[i]);
        unsprung[i] = restart ? flown : stageDragged(v[i] + dv[i] * third, fluid[i], FALL(i), normal[i]);
        vec3 known = restart ? flight(v[i], fluid[i], FALL(i), normal[i]) - flown * substep : dx[i] * third;
        z[i] = held ? vec3(0.0) : known;
        q[i] = held ? vec3(0.0) : known + unsprung[i] * eta;
        weight[i] = held ? 0.0 : inverseMass[i] * (eta * stepPhi.y);
    }
}

void accept()
{
    for (int i = 0; i < VERTICES; ++i) {
        // The velocity follows from what the springs have moved: (q - z) / eta would round it in the same direction in
        // every step.
        bool held = isHeld(pinned[i]);
        vec3 velocity = held ? vec3(0.0) : unsprung[i] + (q[i] - (z[i] + unsprung[i] * eta)) / eta;
        dv[i] = velocity - v[i];
        dx[i] = q[i];
        v[i] = velocity;
        x[i] += q[i];
    }
#ifdef THRUST
    if (restart) thrust(false);
#endif
    restart = false;
}
