// The arrays and numbers that a dispatch, or a draw, which spawns newborns is given.
#include "births/control.glsl"
#include "births/tree.glsl"
#pragma updates free control
#pragma reads places deaths

#ifdef LAYERED
uniform int stateRows;  // of texels
#else
#ifdef CONSTANTS
layout(std430) writeonly buffer NewConstants { vec4 newConstants[]; };
#endif
// A dispatch spawns those newborns whose places lie in one part of the state.
uniform int partFirst;
uniform int partPlaces;
uniform int firstWord;  // of the group's bits
#ifdef DEATH_RUNS
// The dispatch reads one part of the state of each emitter's source. A newborn that no death emits needs no source: every
// dispatch over the sources spawns it, with the same result.
uniform ivec4 sourcePlaces[DEATH_RUNS];  // first place, number of places, unused
#endif
#endif

#ifdef DEATH_RUNS
uniform ivec4 deathRuns[DEATH_RUNS];  // emitter, births for each, start of the source's list, unused
#endif
uniform int group;
uniform int placeCount;
uniform int runCount;
uniform int firstPlace;        // of the newborn, who take one place after another, around the capacity; negative: their places are listed
uniform int givenBorn;         // negative: as many as the GPU has found places for, which are the first free ones
uniform ivec4 runs[RUNS];      // first newborn, emitter, its number there, births at each moment; 0: at random
uniform vec4 runTimes[RUNS];   // s from the frame's start: first moment, interval
uniform int groupSeed;
uniform vec2 lifeSpan;         // s, least and most
uniform vec2 newbornScale;
uniform vec3 newbornSpin;      // rad/s, either way
uniform float newbornPhase;    // rad, at most

int controlWord(int which)
{
    return int(controlAt(group, which / 4)[which % 4]);
}

int placeOf(int newborn)
{
    if (givenBorn < 0) return placeOfRank(newborn);
    return firstPlace < 0 ? int(placesAt(newborn)) : (firstPlace + newborn) % placeCount;
}

struct Source {
    int molecule;
    float since;  // s, from the death to the frame's end
};

struct Start {
    vec3 lattice;   // m
    vec3 place;     // m, from there
    vec3 velocity;  // m/s
};
