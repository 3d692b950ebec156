// Words of control: what births write for the passes after them, so many for each group with life
// (src/simulate/birth_passes.h).
const int controlDeaths = 0;       // in the last step, where they are listed
const int controlRequested = 1;    // births of the last step: asked for,
const int controlBorn = 2;         // and had
const int controlLive = 3;         // taken places
const int controlMark = 4;         // one past the last taken place,
const int controlMarkBefore = 5;   // and one step before
const int controlLost = 6;         // births that found no place, so far
const int controlBornEver = 7;     // births, so far
const int controlBirthGroups = 8;  // workgroups of the births, x y z
const int controlFirsts = 16;      // the first newborn of each emitter from deaths
