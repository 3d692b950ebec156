// The parts of a substep that a solver calls beside the springs: fields, drag and gravity, the release of
// pins. Times are in s since the frame's start.
#include "fused/state.glsl"
#include "physics/random.glsl"
#include "step/advance.glsl"
#include "step/drag.glsl"

// The acceleration of vertex i beside drag and springs, m/s^2.
#if defined(FORCES) || defined(STEERED)
#define PULLED(i) (gravity + pull[i])
#else
#define PULLED(i) gravity
#endif
#define FALL(i) (PULLED(i) + LOAD(i))

bool isHeld(bool pinned)
{
    return PINS && pinned && !released;
}

// Decides by the first forces of a frame whether the molecule's pins hold. Called after springForces, if there are springs.
void letGo(int step)
{
    if (!RELEASE || step > 0) return;
    float pulled = pullOnPins();
    released = released || isReleased(pulled, releaseForce, seed, frame, releaseChance);
}

// Reads the fields that are read once a frame, where the molecule will be in the middle of it.
void sampleFrame()
{
    if (!hasFields || SAMPLE_SUBSTEPS) return;
    float middle = 0.5 * frameDuration;
    if (hasHistory) middle += 0.5 * substep;  // substeps ask for the field at their ends
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i] + v[i] * middle;
    }
    if (SAMPLE_MOLECULE) {
        vec3 u = fieldAt(anchor, meanProbe(), middle);
        for (int i = 0; i < VERTICES; ++i) {
            fluid[i] = u;
        }
        return;
    }
    for (int j = 0; j < VERTICES; ++j) {
        fluid[j] = fieldAt(anchor, probe[j], middle);
    }
}

// Reads, at every probe, the fields that are read in every substep, and the forces: once a frame would be too seldom
// for forces that make molecules circle a point.
void sampleSubstep(float time)
{
#ifdef FORCES
    for (int j = 0; j < VERTICES; ++j) {
        pull[j] = forceAcceleration(anchor, probe[j]);
    }
#endif
#ifdef STEERED
    vec3 middle = steeredMiddle();
    for (int i = 0; i < VERTICES; ++i) {
#ifdef FORCES
        pull[i] += steeringAt(probe[i] - middle);
#else
        pull[i] = steeringAt(probe[i] - middle);
#endif
    }
#endif
    if (!hasFields || !SAMPLE_SUBSTEPS) return;
    for (int j = 0; j < VERTICES; ++j) {
        fluid[j] = fieldAt(anchor, probe[j], time);
    }
}

// The fields, and where drag has a direction the normals, at the vertices as they are.
void sampleHere(float time)
{
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i];
    }
    if (isDirectional) surfaceNormals();
    sampleSubstep(time);
}

// The springs' forces at a time, from x and v, and whether the pins hold them.
void springForcesNow(int step, float time)
{
    if (SPRINGS) {
        for (int i = 0; i < VERTICES; ++i) {
            w[i] = v[i];
        }
        springForces(time);
    }
    letGo(step);
}

// The springs' kick over the whole substep: v += h F(x, v, t) / m.
void kickWhole(int step, float time)
{
    springForcesNow(step, time);
    if (!SPRINGS) return;
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) v[i] += springKick(force[i], inverseMass[i], substep);
    }
}

// Applies drag and gravity over the substep to all vertices that are not held, and moves them.
void driftAll()
{
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) {
            vec3 before = x[i];
            vec3 ended = dragged(v[i], fluid[i], FALL(i), normal[i]);
            x[i] += driftOf(v[i], ended);
            v[i] = velocityAfter(ended, x[i] - before);
        }
    }
}

#ifdef THRUST
// Adds to the velocity of all vertices that are not held.
void gain(vec3 gained)
{
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) v[i] += gained;
    }
}

// Adds to v what a thrust changes the mean of the velocities w by over a substep, or over half of one.
void thrustBy(bool whole)
{
    vec3 mean = meanVelocity();
    gain(thrustedVelocity(mean, whole) - mean);
}
#endif

// Applies the thrust over a substep or half of one, exactly, so that halves before and after what else a substep does
// keep an order of 2.
void thrust(bool whole)
{
#ifdef THRUST
    for (int i = 0; i < VERTICES; ++i) {
        w[i] = v[i];
    }
    thrustBy(whole);
#endif
}

// Returns the velocity after drag in an implicit stage, whose drag is that of the velocity which results.
vec3 stageDragged(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    return draggedBy(velocity, u, a, n, stageDecay, stagePhi);
}

// Returns how far drag and the acceleration carry a vertex over a substep, exactly, m.
vec3 flight(vec3 velocity, vec3 u, vec3 a, vec3 n)
{
    vec3 slope = dragAcceleration(velocity, u, a, n);
    vec3 bend = slope * flightBend.y;
    if (isDirectional) bend += n * (dot(slope, n) * (flightBend.x - flightBend.y));
    return velocity * substep + bend;
}
