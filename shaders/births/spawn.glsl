// Spawns newborns, a lane of a compute shader or a vertex each: its place, what its emitter gives it, and its flight from
// the moment of its birth to the end of the frame, exact in a uniform field and of second order in the frame elsewhere. A
// molecule flies in its rest shape, in which its springs have no force.
//
// With LAYERED a vertex is drawn as a point onto that place, and a fragment stores what it carries.
#ifndef LAYERED
#include "fused/store.glsl"
#endif

#ifdef HISTORY
vec3 dx[VERTICES];
vec3 dv[VERTICES];
#endif

#include "generated/packing.glsl"
#include "physics/anchor.glsl"
#include "physics/random.glsl"
#include "births/emit.glsl"
#include "state/samples.glsl"
#include "births/given.glsl"

// Returns the first of `count` triangles at whose end the summed share of the area is above x.
int triangleAt(int base, int count, float x)
{
    int low = 0;
    int high = count - 1;
    while (low < high) {
        int middle = (low + high) / 2;
        if (sampleAt(base + 3 * middle).w > x) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

#include "generated/emitters.glsl"

// Sets the coefficients of a step of another length.
void setStep(float h)
{
    substep = h;
    decay = vec2(dragDecay(dragRate.x * h), dragDecay(dragRate.y * h));
    phi = vec2(dragPhi(dragRate.x, h), dragPhi(dragRate.y, h));
    flightBend = vec2(dragBend(dragRate.x, h), dragBend(dragRate.y, h));
}

// Applies a thrust over any time, s.
void thrustFor(float time)
{
#ifdef THRUST
    for (int i = 0; i < VERTICES; ++i) {
        w[i] = v[i];
    }
    vec3 mean = meanVelocity();
    gain(thrustedOver(mean, time) - mean);
#endif
}

void flyOn(float since)
{
    setStep(since);
    thrustFor(0.5 * since);
    for (int i = 0; i < VERTICES; ++i) {
        probe[i] = x[i] + v[i] * (0.5 * since);
    }
#ifdef DIRECTIONAL_DRAG
    surfaceNormals();
#endif
    sampleSubstep(frameDuration - 0.5 * since);
    for (int i = 0; i < VERTICES; ++i) {
        if (!isHeld(pinned[i])) {
            x[i] += flight(v[i], fluid[i], FALL(i), normal[i]);
            v[i] = dragged(v[i], fluid[i], FALL(i), normal[i]);
        }
    }
    thrustFor(0.5 * since);
}

void shape(Start start)
{
    vec3 step = latticeNear(start.place);
    vec3 base = start.place - step;
    anchor = start.lattice + step;
    released = false;
    scale = mix(newbornScale.x, newbornScale.y, drawn(seed, bornScale));
    phase = newbornPhase * drawn(seed, bornPhase);
    vec4 rotation = newbornRotation();
    vec3 spin = newbornSpin * (2.0 * vec3(drawn(seed, bornSpin), drawn(seed, bornSpin + 1u),
                                          drawn(seed, bornSpin + 2u)) - 1.0);
    for (int i = 0; i < VERTICES; ++i) {
        vec3 arm = turned(rotation, restPlace[i]) * scale;
        x[i] = base + arm;
        v[i] = isHeld(pinned[i]) ? vec3(0.0) : start.velocity + cross(spin, arm);
        fluid[i] = vec3(0.0);
        normal[i] = vec3(0.0);
    }
#ifdef HISTORY
    for (int i = 0; i < VERTICES; ++i) {
        dx[i] = vec3(0.0);
        dv[i] = vec3(0.0);
    }
    dx[0].x = NO_HISTORY;
#endif
}

#include "births/run.glsl"

// Makes newborn i of those that find a place, and returns its place; -1: there are not so many, or another dispatch makes it.
int newborn(int i)
{
    int born = givenBorn < 0 ? controlWord(controlBorn) : givenBorn;
    if (i >= born) return -1;
    int place = placeOf(i);
#ifndef LAYERED
    if (place < partFirst || place - partFirst >= partPlaces) return -1;
#endif
    loadParameters();
    Source source;
    float birthTime;
    int emitter = findRun(i, source, birthTime);
    if (emitter < 0) return -1;
    Start start;
    emitFrom(emitter, seed, birthTime - 0.5 * frameDuration, source, start);
    shape(start);
    age = frameDuration - birthTime;
    span = mix(lifeSpan.x, lifeSpan.y, drawn(seed, bornLife));
    flyOn(age);
    return place;
}

#ifdef LAYERED
void main()
{
    gl_PointSize = 1.0;
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
    int molecule = newborn(gl_VertexID);
    if (molecule < 0) return;
    vec2 texel = vec2(float(molecule % STATE_WIDTH), float(molecule / STATE_WIDTH)) + 0.5;
    gl_Position = vec4(2.0 * texel / vec2(float(STATE_WIDTH), float(stateRows)) - 1.0, 0.0, 1.0);
    storeState(molecule);
}
#else
void main()
{
    int i = int((gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x);
    int place = newborn(i);
    if (place < 0) return;
    int molecule = place - partFirst;  // in the part
    storeState(molecule);
    newRecords[molecule] = recordNow();
#ifdef CONSTANTS
    newConstants[molecule] = constantsNow();
#endif
    uint bit = 1u << (uint(place) & 31u);
    uint before = atomicAnd(freeBuffer[firstWord + (place >> 5)], ~bit);
    bool isCutShort = givenBorn >= 0 && firstPlace >= 0 && (before & bit) == 0u;  // the life that was there
    if (isCutShort) atomicAdd(controlBuffer[8 * group + controlLost / 4][controlLost % 4], 1u);
}
#endif
