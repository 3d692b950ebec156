// The arrays and numbers that a dispatch, or a draw, which spawns newborns is given.
#ifdef LAYERED
#include "births/words.glsl"
uniform usampler2D places;
uniform usampler2D died;
uniform usampler2D control;
uniform int stateRows;  // of texels
#define placeAt(i) int(wordAt(places, i))
#define controlWord(w) int(wordOfControl(control, w))
#else
#ifdef LISTED
layout(std430) readonly buffer Places { uint places[]; };
#endif
#ifdef CONSTANTS
layout(std430) writeonly buffer NewConstants { vec4 newConstants[]; };
#endif
layout(std430) buffer FreeBits { uint freeBits[]; };
layout(std430) buffer Control { uint control[]; };
// A dispatch spawns those of some newborns whose places lie in one part of the state.
uniform int firstNewborn;
uniform int newbornCount;
uniform int partFirst;
uniform int partPlaces;
#ifdef DEATH_RUNS
// It reads a range of the deaths, and of each emitter's source a part of the state. Newborns that no death emits are
// spawned by each, the same.
layout(std430) readonly buffer Died { uint died[]; };
uniform int firstDied;
uniform int diedCount;
uniform ivec4 sourcePlaces[DEATH_RUNS];  // first place, number of places, unused
#endif
#define placeAt(i) int(places[i - firstNewborn])
#define controlWord(w) int(control[w])
#endif

#ifndef LISTED
uniform int firstPlace;
#endif
#ifdef DEATH_RUNS
uniform ivec4 deathRuns[DEATH_RUNS];  // emitter, births for each, start of the source's list, unused
#endif
uniform int controlBase;
uniform int placeCount;
uniform int runCount;
uniform int givenBorn;         // negative: as many as the GPU has found places for, which are no longer free
uniform ivec4 runs[RUNS];      // first newborn, emitter, its number there, births at each moment; 0: at random
uniform vec4 runTimes[RUNS];   // s from the frame's start: first moment, interval
uniform int groupSeed;
uniform vec2 lifeSpan;         // s, least and most
uniform vec2 newbornScale;
uniform vec3 newbornSpin;      // rad/s, either way
uniform float newbornPhase;    // rad, at most

struct Source {
    int molecule;
    float since;  // s, from the death to the frame's end
};

struct Start {
    vec3 lattice;   // m
    vec3 place;     // m, from there
    vec3 velocity;  // m/s
};
