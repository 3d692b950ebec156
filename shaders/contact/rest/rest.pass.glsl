// A lane a molecule: whether it rests. It comes to rest when none of its vertices has got further than restDistance from where it
// was for restTime. Then it stays as it is: nothing steps it, and to contact it is of infinite mass. What wakes it is an impact
// (contact/rest/wake.pass.glsl), another push than when it came to rest (contact/rest/load_change.pass.glsl), or a force: where one may have
// changed, it is stepped in vain (fused/frame.glsl), and wakes if it gains another velocity than in the first step of its rest.
#pragma updates loads restPoses restLoads
#include "contact/response/vertices.glsl"
#include "contact/flags.glsl"
#include "contact/rest/states.glsl"
#pragma reads cells marks sphereMotions

uniform VALUES oldRecords;
uniform float stepTime;      // s
uniform float restDistance;  // m
uniform float restTime;      // s
uniform float wakeSpeed;     // m/s
uniform bool probes;         // what rests has been stepped
uniform bool wakes;          // all molecules of the group

void setState(int sphere, float who)
{
    for (int k = 0; k < SPHERES; ++k) putLoads(sphere + k, vec4(loadsAt(sphere + k).xyz, who));
}

// Whether what contacts push on a molecule at rest has changed in this step.
bool isLoaded(int sphere)
{
    bool loaded = false;
    for (int k = 0; k < SPHERES; ++k) loaded = loaded || (marksAt(slotOf(sphere + k)) & LOAD_CHANGED) != 0u;
    return loaded;
}

// Keeps a molecule at rest, or wakes it: with the velocity that an impact has given it, or with none, because no contact has answered
// what it gains in a step in vain.
void keepOrWake(int sphere, int first)
{
    bool isFirst = loadsAt(sphere).w == COME_TO_REST;
    float change = 0.0;  // of what its vertices gain, m/s
    for (int v = 0; v < VERTICES; ++v) {
        vec3 gained = stateVector(first, POSITION_ELEMENTS, v);
        vec4 load = restLoadsAt(sphere + v);
        if (isFirst) putRestLoads(sphere + v, vec4(gained, load.w));
        if (!isFirst) change = max(change, distance(gained, load.xyz));
    }
    bool struck = marksWoken(marksAt(slotOf(sphere)));
    bool woken = struck || isLoaded(sphere) || (probes && change > wakeSpeed);
    for (int v = 0; v < VERTICES; ++v) {
        vec3 place = stateVector(first, 0, v);
        vec3 velocity = struck ? stateVector(first, POSITION_ELEMENTS, v) : vec3(0.0);
        setMotion(first, v, velocity, !woken, vec3(0.0));
        if (woken) putRestPoses(sphere + v, vec4(place, 0.0));
    }
    setState(sphere, woken ? AWAKE : RESTING);
}

// Lets a molecule that is awake come to rest.
void rest(int molecule, int sphere, int first)
{
    float time = restPosesAt(sphere).w + stepTime;
    bool isDead = cellsAt(slotOf(sphere)).w == 0u;
    if (wakes || isDead || hasFlag(sphereMotionsAt(sphere).w)) time = 0.0;
    for (int v = 0; v < VERTICES; ++v)
        if (!(distance(stateVector(first, 0, v), restPosesAt(sphere + v).xyz) <= restDistance)) time = 0.0;
    if (RELEASE && valueOf(oldRecords, molecule).w >= 0.0) time = 0.0;  // what hangs may tear off
    bool comesToRest = time >= restTime;
    for (int v = 0; v < VERTICES; ++v) {
        if (time == 0.0) putRestPoses(sphere + v, vec4(stateVector(first, 0, v), 0.0));
        if (comesToRest) setMotion(first, v, vec3(0.0), true, vec3(0.0));
    }
    putRestPoses(sphere, vec4(restPosesAt(sphere).xyz, time));
    if (!comesToRest) return;
    for (int k = 0; k < SPHERES; ++k) putRestLoads(sphere + k, vec4(0.0, 0.0, 0.0, -1.0));
    setState(sphere, COME_TO_REST);
}

void main()
{
    if (isBehindLast()) return;
    int molecule = ownLane();
    int sphere = firstNumber + molecule * SPHERES;
    int first = firstElement(molecule, STATE_ELEMENTS);
    bool rested = hasFlag(cellsAt(slotOf(sphere)).w);
    if (rested) keepOrWake(sphere, first);
    if (!rested) rest(molecule, sphere, first);
}
