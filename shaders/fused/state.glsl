// One molecule in the registers of one lane or, with ROWS, some of its vertices (fused/gather.glsl): what the fused step
// works on between reading the state and writing it.
//
// The state in memory is packed: the 3 VERTICES floats of the positions follow one another in
// POSITION_ELEMENTS 4-vectors, then the velocities in as many more. Molecules lie in blocks of BLOCK:
//
//   4-vector e of molecule m:   (m / BLOCK) * BLOCK * STATE_ELEMENTS + e * BLOCK + m % BLOCK
//
// so that neighbouring lanes touch neighbouring memory and a block is one contiguous piece. Normals lie
// alike, with POSITION_ELEMENTS. A record is one 4-vector a molecule: xyz anchor (m); w: 1 + seed, negative
// once the pins are released. Where molecules are born and die (LIFE), age and length of life in s are the w
// of the last 4-vector of the positions and of the velocities, or where those are full the x and y of one
// more. The constants, where instances differ: x scale, y phase of the muscles (rad).
//
// Set by C++ (src/simulate/fused_kernel.cpp): LANES, molecules of a workgroup; VERTICES that a lane holds; BLOCK,
// POSITION_ELEMENTS, STATE_ELEMENTS.
#include "state/packed.glsl"

#ifndef LAYERED
#ifdef ROWS
layout(local_size_x = LANES, local_size_y = ROWS) in;
#else
layout(local_size_x = LANES) in;
#endif
#endif

uniform VALUES oldState;
uniform VALUES oldRecords;
uniform VALUES constants;

// The numbers of a frame, as setStepUniforms in src/simulate/fused_kernel.cpp packs them.
uniform ivec4 givenCounts;
uniform vec4 givenNumbers[7];

// Copies of the uniforms, for the step to read. With SOFTWARE, for Mesa's rasteriser, each copy
// goes through an operation that changes nothing: a plain copy counts as a uniform, which is fetched lane by
// lane, and again in every turn of a loop.
int frame;  // number of this frame, from 0
int substeps;  // of a frame
float substep;  // h, s
float frameDuration;  // s
vec3 gravity;  // m/s^2
float wind;  // factor on the fields
vec2 decay;  // 1 - exp(-gamma h) across and along the surface
vec2 phi;  // decay / gamma, h where gamma = 0
float stiffnessFactor;
float dampingFactor;
float releaseForce;  // N: above this pull on a pin, all pins of the molecule are released
float releaseChance;  // in this frame
vec3 driftOfStep;  // physics/collide.glsl: step, kickDrift, lag
vec2 dragRate;  // gamma, 1/s, across and along the surface
float stageEta;  // s, of an implicit stage
vec2 stageDecay;  // gamma eta / (1 + gamma eta) across and along the surface
vec2 stagePhi;  // eta / (1 + gamma eta)
vec2 flightBend;  // (h - phi) / gamma, s^2, across and along the surface
int slips;  // not 0: drag is so heavy that positions drift by the new velocity alone
int restarts;  // not 0: a solver with history forgets the last substep

#ifdef SOFTWARE
const bool isSoftware = true;
int inRegister(int value) { return min(value, 2147483647); }
float inRegister(float value) { return min(value, 3.4e38); }
vec2 inRegister(vec2 value) { return min(value, vec2(3.4e38)); }
vec3 inRegister(vec3 value) { return min(value, vec3(3.4e38)); }
vec4 inRegister(vec4 value) { return min(value, vec4(3.4e38)); }
#else
const bool isSoftware = false;
int inRegister(int value) { return value; }
float inRegister(float value) { return value; }
vec2 inRegister(vec2 value) { return value; }
vec3 inRegister(vec3 value) { return value; }
vec4 inRegister(vec4 value) { return value; }
#endif

void loadUniforms()
{
    frame = inRegister(givenCounts.x);
    substeps = inRegister(givenCounts.y);
    slips = inRegister(givenCounts.z);
    restarts = inRegister(givenCounts.w);
    gravity = inRegister(givenNumbers[0].xyz);
    wind = inRegister(givenNumbers[0].w);
    substep = inRegister(givenNumbers[1].x);
    frameDuration = inRegister(givenNumbers[1].y);
    stiffnessFactor = inRegister(givenNumbers[1].z);
    dampingFactor = inRegister(givenNumbers[1].w);
    decay = inRegister(givenNumbers[2].xy);
    phi = inRegister(givenNumbers[2].zw);
    flightBend = inRegister(givenNumbers[3].xy);
    dragRate = inRegister(givenNumbers[3].zw);
    driftOfStep = inRegister(givenNumbers[4].xyz);
    stageEta = inRegister(givenNumbers[4].w);
    stageDecay = inRegister(givenNumbers[5].xy);
    stagePhi = inRegister(givenNumbers[5].zw);
    releaseForce = inRegister(givenNumbers[6].x);
    releaseChance = inRegister(givenNumbers[6].y);
}

// Returns `after`. Where each lane leaves the loop over the substeps by itself, Mesa's rasteriser keeps a lane's value
// after the loop only if a turn computes it from the turn before. Any other value becomes that of the turn in which the
// last lane left.
vec3 carried(vec3 before, vec3 after) { return !CARRIES || substeps > 0 ? after : before; }

vec3 x[VERTICES];       // m, relative to the anchor
vec3 v[VERTICES];       // m/s
vec3 w[VERTICES];       // m/s, as the springs' damping sees it
vec3 force[VERTICES];   // N, of the springs
vec3 probe[VERTICES];   // m, where drag is taken
vec3 fluid[VERTICES];   // m/s, the fields' velocity there
vec3 normal[VERTICES];  // unit, of the surface there
#if defined(FORCES) || defined(STEERED)
vec3 pull[VERTICES];  // m/s^2, the acceleration of the forces and of steering at the probe
#endif

vec3 anchor;            // m
float scale = 1.0;      // of the rest lengths
float phase = 0.0;      // rad
bool released = false;  // whether the pins are released
uint seed;
float age = 0.0;        // s, where molecules are born and die
float span = 0.0;       // s, length of life; 0: the place is free
bool touched = false;   // a collider, in this frame
#ifdef LIFE
const bool isMortal = true;
#else
const bool isMortal = false;
#endif

#ifdef HISTORY
const bool hasHistory = true;  // of the substep before
#else
const bool hasHistory = false;
#endif

// Whether there is a molecule.
bool taken()
{
    return !isMortal || span > 0.0;
}

// Loops of the form `for (int i = 0; i < VERTICES; ++i) {` are written out before the driver sees them, so
// that every index is a constant and every vertex stays in registers. Loops over j (fields) and k (contacts) are the same
// for bodies that may be too long to write out (src/simulate/vertex_loops.h). What needs more than the own vertex, sums
// and the place of vertex 0, is a function of the form: it may hold barriers, so that all lanes have to call it.

void loadRecord(int molecule)
{
    vec4 record = valueOf(oldRecords, molecule);
    anchor = record.xyz;
    released = record.w < 0.0;
    seed = uint(abs(record.w)) - 1u;
#ifdef CONSTANTS
    vec4 constant = valueOf(constants, molecule);
    scale = constant.x;
    phase = constant.y;
#endif
}

vec4 recordNow()
{
    float label = float(seed + 1u);
    return vec4(anchor, released ? -label : label);
}

#ifdef CONSTANTS
vec4 constantsNow()
{
    return vec4(scale, phase, 0.0, 0.0);
}
#endif
