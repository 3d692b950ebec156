// A lane a molecule: whether it rests. It comes to rest when none of its vertices has got further than restDistance from where it
// was for restTime. Then it stays as it is: nothing steps it, and to contact it is of infinite mass. What wakes it is an impact
// (contact/wake.comp), another push than when it came to rest (contact/weigh.comp), or a force: where one may have changed, it
// is stepped in vain (fused/frame.glsl), and wakes if it gains another velocity than in the first step of its rest.
#include "contact/shape.glsl"
#include "contact/resting.glsl"

uniform usamplerBuffer motions;  // by sphere (contact/records.glsl)
uniform samplerBuffer totals;    // by slot (contact/totals.glsl)
#ifdef RELEASE
uniform VALUES oldRecords;
#endif
uniform float stepTime;         // s
uniform float restDistance;     // m
uniform float restTime;         // s
uniform float wakeSpeed;        // m/s
uniform bool probes;            // what rests has been stepped
uniform bool wakes;             // all molecules of the group

layout(std430) buffer State { float state[]; };
layout(std430) buffer Loads { vec4 loads[]; };  // contact/apply.comp; w of what rests: RESTED or JUST_RESTED
// By sphere. Of what is awake: xyz where its vertex was, m from the anchor; in w of the first sphere for how long all have stayed
// there, s. Of what rests: xyz the velocity that its vertex gains in the first step, m/s; w how much its contacts pushed then
// (contact/weigh.comp), N s, or -1: nobody has asked yet.
layout(std430) buffer Calm { vec4 calm[]; };

const float AWAKE = 0.0;
const float RESTED = 1.0;
const float JUST_RESTED = 2.0;  // its next step is the first

vec3 stateVector(int first, int vertex)
{
    return vec3(state[floatIndex(first, 3 * vertex)], state[floatIndex(first, 3 * vertex + 1)],
                state[floatIndex(first, 3 * vertex + 2)]);
}

void setStateVector(int first, int vertex, vec3 value)
{
    for (int c = 0; c < 3; ++c) state[floatIndex(first, 3 * vertex + c)] = value[c];
}

// Sets what the state has behind the positions: velocities, and the solver's history, with which it goes on or not.
void setMotion(int first, int vertex, vec3 velocity, bool goesOn)
{
    setStateVector(first + POSITION_ELEMENTS * BLOCK, vertex, velocity);
#ifdef HISTORY
    setStateVector(first + 2 * POSITION_ELEMENTS * BLOCK, vertex, vec3(goesOn ? 0.0 : NO_HISTORY, 0.0, 0.0));
    setStateVector(first + 3 * POSITION_ELEMENTS * BLOCK, vertex, vec3(0.0));
#endif
}

void setRest(int sphere, float rest)
{
    for (int k = 0; k < SPHERES; ++k) loads[sphere + k].w = rest;
}

// Whether contact has woken a molecule at rest in this step.
bool isWoken(int sphere)
{
    bool woken = false;
    for (int k = 0; k < SPHERES; ++k) {
        int slot = slotOf(sphere + k);
        uint mark = texelFetch(marks, slot).x;
        woken = woken || marksWoken(mark) || (mark != 0u && texelFetch(totals, 2 * slot + 1).w > 0.0);
    }
    return woken;
}

// Keeps a molecule at rest, or wakes it.
void keepOrWake(int sphere, int first)
{
    bool isFirst = loads[sphere].w == JUST_RESTED;
    float otherwise = 0.0;
    for (int v = 0; v < VERTICES; ++v) {
        vec3 gained = stateVector(first + POSITION_ELEMENTS * BLOCK, v);
        if (isFirst) calm[sphere + v].xyz = gained;
        otherwise = max(otherwise, distance(gained, calm[sphere + v].xyz));
    }
    bool woken = isWoken(sphere) || (probes && otherwise > wakeSpeed);
    for (int v = 0; v < VERTICES; ++v) {
        vec3 place = stateVector(first, v);
        vec3 gained = stateVector(first + POSITION_ELEMENTS * BLOCK, v);
        setMotion(first, v, woken ? gained : vec3(0.0), !woken);
        if (woken) calm[sphere + v] = vec4(place, 0.0);
    }
    setRest(sphere, woken ? AWAKE : RESTED);
}

// Lets a molecule that is awake come to rest.
void rest(int molecule, int sphere, int first)
{
    float time = calm[sphere].w + stepTime;
    bool isDead = texelFetch(cells, slotOf(sphere)).w == 0u;
    if (wakes || isDead || (texelFetch(motions, sphere).w & FRESH) != 0u) time = 0.0;
    for (int v = 0; v < VERTICES; ++v)
        if (!(distance(stateVector(first, v), calm[sphere + v].xyz) <= restDistance)) time = 0.0;
#ifdef RELEASE
    if (valueOf(oldRecords, molecule).w >= 0.0) time = 0.0;  // what hangs may tear off
#endif
    bool comesToRest = time >= restTime;
    for (int v = 0; v < VERTICES; ++v) {
        if (time == 0.0) calm[sphere + v].xyz = stateVector(first, v);
        if (comesToRest) setMotion(first, v, vec3(0.0), true);
    }
    calm[sphere].w = time;
    if (!comesToRest) return;
    for (int k = 0; k < SPHERES; ++k) calm[sphere + k].w = -1.0;
    setRest(sphere, JUST_RESTED);
}

void main()
{
    int molecule = int(gl_GlobalInvocationID.x);
    if (molecule * SPHERES >= partSpheres) return;
    int sphere = firstSphere + molecule * SPHERES;
    int first = firstElement(molecule, STATE_ELEMENTS);
    bool rested = (texelFetch(cells, slotOf(sphere)).w & RESTS) != 0u;
    if (rested) keepOrWake(sphere, first);
    if (!rested) rest(molecule, sphere, first);
}
