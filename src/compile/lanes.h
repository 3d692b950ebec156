// How the molecules of a group are spread over the lanes of a compute device: the two forms of the fused
// kernel, what each can hold, and which one is taken. Pure functions. What the choice rests on is measured:
// the table in lanes.cpp.
//
//   molecule   a lane a molecule, whose topology is written out as text: all of it in registers
//   vertex     a lane a vertex: a workgroup takes several molecules side by side, and neighbouring lanes do
//              the same vertex of neighbouring molecules, with the positions and velocities of the others in
//              shared memory (shaders/fused/gather.glsl). Its text is the same for every topology.
#pragma once

#include <string>

namespace shoal {

struct GroupPlan;
struct PathLimits;
struct Plan;

enum class Lanes { automatic, molecule, vertex };
const char* name(Lanes lanes);  // "auto", "molecule", "vertex"
// Error: another word, with the nearest.
Lanes lanes(const std::string& word);

// Largest molecules of the fused path.
struct FusedLimits {
    // A lane a molecule holds so many vertices and springs: beyond these its code takes too long to compile.
    static constexpr int laneVertices = 64, laneSprings = 1024;
    // Bytes of shared memory of a molecule of so many vertices: positions and velocities, in whole 4-vectors.
    static constexpr int sharedBytes(int vertices) { return (3 * vertices + 3) / 4 * 32; }
    // Returns the most vertices with a lane a vertex, of a workgroup with so much shared memory.
    static int vertices(int sharedBytes) { return sharedBytes / 32 * 4 / 3; }
};

// Whether a lane holds a molecule of the group.
bool fitsLane(const GroupPlan& group);

// A workgroup of the form with a lane a vertex.
struct WorkgroupShape {
    int molecules = 0;  // side by side; a power of 2
    int rows = 0;       // of lanes, each for every so many-th vertex
    int vertices = 0;   // of a lane, at most
};
// As many molecules as fit shared memory, up to 32; they must fit one at least (FusedLimits::vertices).
WorkgroupShape workgroupShape(int vertices, int sharedBytes);

// Returns about how long a CPU rasteriser takes to a group's first frame without a cache, in seconds of a
// processor; 0: it is not long.
double secondsToCompile(const Plan& plan, const GroupPlan& group, Lanes lanes = Lanes::molecule);
// Whether that is so long that it is refused where there is no other form.
bool takesLong(const Plan& plan, const GroupPlan& group);

// The number of dispatches that a frame is cut into: its steps of contact between molecules or, without
// contact, so many that a lane with so many vertices, and so many turns a substep for a matrix
// (compile/newton.h), stays below the turns of loops that a CPU rasteriser takes, mostly 1. What needs more
// turns is noticed (shaders/fused/frame.glsl).
int piecesOf(const Plan& plan, int vertices, int matrixTurns, int substeps, int mostTurns);

// Returns the form for a group. Error: what is wanted cannot hold it, or would take a CPU rasteriser too long
// to compile.
Lanes chooseLanes(const Plan& plan, const GroupPlan& group, Lanes wanted, const PathLimits& limits);
// Checks it for fragments, which have a lane a molecule alone, however long it takes to compile.
void checkLane(const Plan& plan, const GroupPlan& group, const PathLimits& limits);

}  // namespace shoal
