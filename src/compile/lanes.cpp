#include "compile/lanes.h"

#include <algorithm>
#include <cmath>

#include "compile/path.h"
#include "core/contract.h"
#include "core/error.h"

namespace shoal {

namespace {

// The measurements that the choice rests on.
//
// A GPU: one NVIDIA H200 (driver 580.159.04), 26 November 2026, milliseconds of the device a frame, minimum
// of 16 frames after 11; `leapfrog`, 5 substeps, uniform wind, drag by direction; without a collider, over a
// plane, and on it (shoal-gl "[.lanes-cost]"). "By hand" is a kernel written in CUDA that does less
// (shaders/fused/gather.glsl has its idea), over a plane, on an NVIDIA H100. A lane a vertex had the
// workgroups of 3 x 32 (fry, fish) and 4 x 32 below; with those that are taken now, and the step as it is
// now, fry and fish take 4.4 over a plane.
//
//   molecule, vertices   number       a lane a molecule      a lane a vertex        by hand
//   quad, 4              1,048,576    0.13   0.14   0.25     0.43   0.41   0.49     0.23
//   fry, 20              1,048,576    2.04   5.98   10.6     5.30   6.73   7.31     2.29
//   fish, 24             1,048,576    7.02   21.2   53.0     5.92   6.02   6.57     2.56
//   32 vertices            131,072    5.50   20.3   30.0     1.18   1.23   1.32
//   cloth, 64               16,384    25.6   29.7   40.1     0.36   0.38   0.40
//
// Leaves (9 vertices) and crosses (12) are two to five times as fast with a lane a molecule in the same run,
// 16,384 and 131,072 fry without a collider 2.3 and 3.1 times.
constexpr int gpuLane = 12, gpuLaneFree = 20;  // vertices of a lane, with colliders and without

// A lane takes one vertex where the workgroup has few enough lanes for that, else two, or more where there
// are too many even so. The same machine, 131,072 molecules over a plane, ms: vertices of a lane x molecules
// of a workgroup:
//
//              1 x 32   2 x 32   3 x 32   4 x 32   1 x 16   2 x 16
//   fry, 20    0.66     0.76     0.91              0.68     0.78
//   fish, 24   0.83     0.73     0.81              0.82     0.71
//   cloth, 64           2.34              2.78     2.54     3.08
//
// The table of springs in a uniform block took as long as in a storage block, or up to three times; in shared
// memory, and probes with a place of their own there, which saves every second barrier, within 3 % or longer.
//
// The same machine, 262,144 molecules in the air over a plane, ms: what was tried on the step itself.
//
//                                                                   fish   fry
//   a triangle worked out at each of its corners                    1.25   1.18
//   once a molecule (fused/gather.glsl)                             1.18   1.15
//   and springs two at a time, without a choice for ends that meet  1.10   1.09   taken
//   and barriers without memoryBarrierShared, which GLSL wants      1.07   1.06
//   of these, from the second row:
//   numbers of vertices as bits instead of floats                   1.18   1.17
//   the next spring fetched while one is worked out                 1.15   1.23
//   vertex, component and lane as three indices                     1.23   1.20
//   the last row with the whole table in shared memory              1.47   1.01
constexpr int mostMolecules = 32, fewLanes = 640, mostLanes = 1024;

// A CPU rasteriser, nanoseconds of a processor a molecule and frame, minimum: 4,096 molecules, `leapfrog`, 5
// substeps, uniform wind, drag by direction where there are triangles; without and with a plane
// (shoal-gl "[.lanes-cost]"; 2 cores of an Intel Xeon, llvmpipe, Mesa 22.3.6).
//
//   vertices, springs, triangles   a lane a molecule   a lane a vertex
//   24, 0, 0                         492     805        1,655    2,220
//   24, 45, 0                      1,009   1,266       20,746   21,241
//   24, 96, 30                     1,880   2,208       46,865   48,914
//   33, 63, 0                      1,464   1,838       31,656   31,469
//   33, 130, 40                    2,590   3,017       65,716   71,599
//   48, 0, 0                       1,065   1,783        3,354    4,373
//   48, 220, 70                    4,344   4,493      105,512  100,848
//   64, 0, 0                       1,341   2,411        4,250    5,507
//   64, 125, 0                     2,850   3,638       54,612   54,772
//   64, 306, 98                    5,566   6,683      138,159  149,755
//
// A lane a molecule is always best, but what is written out takes long to compile: then a lane a vertex,
// unless it takes longer over the frames of the run. These seconds of a processor it takes more, a substep of
// a molecule, for each spring and vertex; so many frames are as usual, where the run does not say.
constexpr double moreOfSpring = 85e-9, moreOfVertex = 11e-9;
constexpr int usualFrames = 600;
constexpr double mostSeconds = 5;      // to the first frame, where there is a choice
constexpr double longestSeconds = 12;  // where there is none: more is refused

// The parts of secondsToCompile(), in s; fitted to 62 kernels of 4 to 64 vertices on the same machine, of
// which it is off by 9 % (root mean square) and by 30 % at most. Fields and loops that are kept were fitted
// to a few apart. Loops are written out (simulate/fused_kernel.cpp): those that are kept take several times
// as long.
constexpr double start = 0.7;     // of everything else
constexpr double ofMatrix = 3.5;  // all of it, with a lane a vertex and a matrix (compile/newton.h)
constexpr double ofVertex = 0.0048, ofTriangle = 0.0103;
constexpr double ofCollider = 0.0187, ofJointContact = 0.0888;  // of a vertex
constexpr double ofField = 0.004, ofLongField = 0.03;           // of a vertex
constexpr double crowding = 57;  // vertices: twice as long for the same text, as registers run out

// Whether a run takes a CPU rasteriser fewer seconds of its processors with a lane a molecule. Bodies, which
// the two forms answer in different ways, do not depend on how long a run is.
bool paysToCompile(const Plan& plan, const GroupPlan& group) {
    const double seconds = secondsToCompile(plan, group);
    if (seconds <= mostSeconds) return true;
    if (group.rigid || seconds > longestSeconds) return false;
    const double more = double(plan.frames > 0 ? plan.frames : usualFrames) * group.count * plan.substeps *
                        (group.springCount * moreOfSpring + group.vertexCount * moreOfVertex);
    return seconds <= more;
}

bool prefersLane(const Plan& plan, const GroupPlan& group, const PathLimits& limits) {
    if (limits.software) return paysToCompile(plan, group);
    return group.vertexCount <= (group.needs.collide ? gpuLane : gpuLaneFree);
}

// Error: its code would take a CPU rasteriser too long.
void checkSeconds(const Plan& plan, const GroupPlan& group, const PathLimits& limits, const char* instead) {
    if (!limits.software || !takesLong(plan, group)) return;
    throw Error(group.location,
                concat("a CPU rasteriser would take about ", std::lround(secondsToCompile(plan, group)),
                       " s to compile \"", group.name, "\", ", group.vertexCount, " vertices and ",
                       group.springCount, " springs, with ", name(group.solver), " in one lane; more than ",
                       longestSeconds, " s are refused: ", instead));
}

}  // namespace

const char* name(Lanes lanes) {
    static constexpr const char* names[] = {"auto", "molecule", "vertex"};
    return names[size_t(lanes)];
}

Lanes lanes(const std::string& word) {
    for (const Lanes lanes : {Lanes::automatic, Lanes::molecule, Lanes::vertex})
        if (word == name(lanes)) return lanes;
    throw Error(concat("unknown lanes \"", word, "\"", suggestion(word, {"auto", "molecule", "vertex"})));
}

bool fitsLane(const GroupPlan& group) {
    return group.vertexCount <= FusedLimits::laneVertices && group.springCount <= FusedLimits::laneSprings;
}

WorkgroupShape workgroupShape(int vertices, int sharedBytes) {
    WorkgroupShape out;
    out.molecules = mostMolecules;
    while (out.molecules > 1 && out.molecules * FusedLimits::sharedBytes(vertices) > sharedBytes)
        out.molecules /= 2;
    EXPECTS(out.molecules * FusedLimits::sharedBytes(vertices) <= sharedBytes);
    const auto parts = [](int whole, int part) { return (whole + part - 1) / part; };
    out.vertices = parts(vertices * out.molecules, fewLanes);
    if (out.vertices > 2) out.vertices = std::max(2, parts(vertices * out.molecules, mostLanes));
    out.rows = parts(vertices, out.vertices);
    return out;
}

double secondsToCompile(const Plan& plan, const GroupPlan& group, Lanes lanes) {
    if (lanes == Lanes::vertex) return solver(group.solver).spread ? ofMatrix : 0;
    const double vertices = group.vertexCount;
    double ofEach = ofVertex;
    if (group.needs.collide) ofEach += plan.jointContact ? ofJointContact : ofCollider;
    if (group.needs.fields) ofEach += double(plan.fieldCount) * (plan.longFields ? ofLongField : ofField);
    const double text = vertices * ofEach + group.springCount * solver(group.solver).secondsPerSpring +
                        (group.needs.directionalDrag ? group.triangleCount : 0) * ofTriangle;
    return start + text * (1 + vertices / crowding);
}

bool takesLong(const Plan& plan, const GroupPlan& group) {
    return secondsToCompile(plan, group) > longestSeconds;
}

int piecesOf(const Plan& plan, int vertices, int matrixTurns, int substeps, int mostTurns) {
    if (plan.contact.any()) return std::min(plan.contact.steps, substeps);
    constexpr double looks = 3;      // at all colliders, of a vertex and substep
    constexpr double marches = 300;  // turns of the way among those that are near, seldom more
    double turns = double(matrixTurns) * substeps;
    if (plan.colliders.turns > 0)
        turns += (looks * double(plan.colliders.turns) + marches) * vertices * substeps;
    return int(std::clamp(std::ceil(turns / (0.9 * mostTurns)), 1.0, double(substeps)));
}

Lanes chooseLanes(const Plan& plan, const GroupPlan& group, Lanes wanted, const PathLimits& limits) {
    if (solver(group.solver).spread && wanted == Lanes::molecule)
        throw Error(group.location,
                    concat(name(group.solver), ", which \"", group.name,
                           "\" takes, has a lane a vertex, in compute shaders alone: leave out --lanes "
                           "molecule, or use another solver"));
    const bool implicit = solver(group.solver).implicit && !solver(group.solver).spread;
    if (implicit && (wanted == Lanes::vertex || group.vertexCount > FusedLimits::laneVertices))
        throw Error(
            group.location,
            wanted == Lanes::vertex
                ? concat(name(group.solver), ", which \"", group.name,
                         "\" takes, goes over the springs of a molecule one after the other, in one lane: "
                         "leave out --lanes vertex or use an explicit solver")
                : concat(name(group.solver), " keeps a molecule in one lane, which holds at most ",
                         FusedLimits::laneVertices, " vertices; a molecule of \"", group.name, "\" has ",
                         group.vertexCount, ": use bdf2-newton or an explicit solver"));
    if (implicit && group.springCount > FusedLimits::laneSprings)
        throw Error(group.location,
                    concat(name(group.solver), " writes out the springs of a molecule, at most ",
                           FusedLimits::laneSprings, "; a molecule of \"", group.name, "\" has ",
                           group.springCount, ": use bdf2-newton or an explicit solver"));
    if (group.needs.life && group.vertexCount > FusedLimits::laneVertices)
        throw Error(group.location, concat("molecules of more than ", FusedLimits::laneVertices,
                                           " vertices cannot be born or die; one of \"", group.name,
                                           "\" has ", group.vertexCount));
    if (implicit) {
        checkSeconds(plan, group, limits, "use bdf2-newton or an explicit solver");
        return Lanes::molecule;
    }
    if (wanted != Lanes::molecule && group.vertexCount > FusedLimits::vertices(limits.maxSharedBytes)) {
        if (wanted == Lanes::automatic && fitsLane(group) && !solver(group.solver).spread)
            return Lanes::molecule;
        throw Error(group.location, concat("a molecule of \"", group.name, "\" has ", group.vertexCount,
                                           " vertices; a workgroup holds at most ",
                                           FusedLimits::vertices(limits.maxSharedBytes), " in ",
                                           limits.maxSharedBytes, " bytes of shared memory"));
    }
    if (solver(group.solver).spread) return Lanes::vertex;
    if (wanted == Lanes::automatic)
        return fitsLane(group) && prefersLane(plan, group, limits) ? Lanes::molecule : Lanes::vertex;
    if (wanted == Lanes::molecule && group.vertexCount > FusedLimits::laneVertices)
        throw Error(group.location, concat("a molecule of \"", group.name, "\" has ", group.vertexCount,
                                           " vertices; a lane holds at most ", FusedLimits::laneVertices));
    if (wanted == Lanes::molecule) checkSeconds(plan, group, limits, "leave out --lanes molecule");
    return wanted;
}

void checkLane(const Plan& plan, const GroupPlan& group, const PathLimits& limits) {
    PathLimits any = limits;
    any.software = false;
    chooseLanes(plan, group, Lanes::molecule, any);
}

}  // namespace shoal
