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
// A GPU: one NVIDIA H100 (driver 580.159.04), 22 November 2026, fused milliseconds a frame, minimum;
// `leapfrog`, 5 substeps, uniform wind, drag by direction; without and with a plane. "By hand" is a kernel
// written in CUDA of the idea of a lane a vertex: ours is not measured on a GPU yet.
//
//   molecule, vertices   number       a lane a molecule   by hand, with a plane
//   quad, 4              1,048,576    0.11     0.13       0.23
//   leaf, 9              1,048,576    0.38     0.43       0.84
//   cross, 12            1,048,576    0.44     0.50       0.92
//   fry, 20              16,384       0.056    1.22       0.044
//                        131,072      0.25     1.70       0.30
//                        1,048,576    1.38     13.4       2.29
//   fish, 24             16,384       0.106    2.71       0.051
//                        131,072      0.73     20.7       0.35
//                        1,048,576    5.72     160        2.56
//   cloth, 64            131,072                          1.04
//
// A lane a molecule is best up to 12 vertices, and without colliders up to 20 from 131,072 molecules on.
constexpr int gpuLane = 12, gpuLaneFree = 20, many = 131072;

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
// A lane a molecule is always best, but what is written out takes long to compile: then a lane a vertex.
constexpr double mostSeconds = 5;      // to the first frame, where there is a choice
constexpr double longestSeconds = 12;  // where there is none: more is refused

// The parts of secondsToCompile(), in s; fitted to 62 kernels of 4 to 64 vertices on the same machine, of
// which it is off by 9 % (root mean square) and by 30 % at most. Fields and loops that are kept were fitted
// to a few apart. Loops are written out (simulate/fused_kernel.cpp): those that are kept take several times
// as long.
constexpr double start = 0.7;  // of everything else
constexpr double ofVertex = 0.0048, ofTriangle = 0.0103;
constexpr double ofCollider = 0.0187, ofJointContact = 0.0888;  // of a vertex
constexpr double ofField = 0.004, ofLongField = 0.03;           // of a vertex
constexpr double crowding = 57;  // vertices: twice as long for the same text, as registers run out

// Returns the part of a spring.
double secondsOf(SolverKind solver) {
    switch (solver) {
    case SolverKind::euler:
    case SolverKind::verlet:
        return 0.0013;
    case SolverKind::leapfrog:
        return 0.0042;
    case SolverKind::rk4:
        return 0.0048;
    case SolverKind::xpbd:
        return 0.0021;
    case SolverKind::bdf2Xpbd:
        return 0.0246;
    case SolverKind::bdf2Corotated:
        return 0.0653;
    }
    EXPECTS(false);
    return 0;
}

bool prefersLane(const Plan& plan, const GroupPlan& group, const PathLimits& limits) {
    if (limits.software) return secondsToCompile(plan, group) <= mostSeconds;
    return group.vertexCount <= (!group.needs.collide && group.count >= many ? gpuLaneFree : gpuLane);
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
    constexpr int mostMolecules = 32, mostLanes = 512, mostOfLane = 4, fewestRows = 8;
    WorkgroupShape out;
    out.molecules = mostMolecules;
    while (out.molecules > 1 && out.molecules * FusedLimits::sharedBytes(vertices) > sharedBytes)
        out.molecules /= 2;
    EXPECTS(out.molecules * FusedLimits::sharedBytes(vertices) <= sharedBytes);
    const auto parts = [](int whole, int part) { return (whole + part - 1) / part; };
    out.vertices = std::clamp(parts(vertices, fewestRows), 1, mostOfLane);
    out.vertices = std::max(out.vertices, parts(vertices, mostLanes / out.molecules));
    out.rows = parts(vertices, out.vertices);
    return out;
}

double secondsToCompile(const Plan& plan, const GroupPlan& group) {
    const double vertices = group.vertexCount;
    double ofEach = ofVertex;
    if (group.needs.collide) ofEach += plan.jointContact ? ofJointContact : ofCollider;
    if (group.needs.fields) ofEach += double(plan.fieldCount) * (plan.longFields ? ofLongField : ofField);
    const double text = vertices * ofEach + group.springCount * secondsOf(group.solver) +
                        (group.needs.directionalDrag ? group.triangleCount : 0) * ofTriangle;
    return start + text * (1 + vertices / crowding);
}

bool takesLong(const Plan& plan, const GroupPlan& group) {
    return secondsToCompile(plan, group) > longestSeconds;
}

Lanes chooseLanes(const Plan& plan, const GroupPlan& group, Lanes wanted, const PathLimits& limits) {
    const bool implicit = solver(group.solver).implicit;
    if (implicit && (wanted == Lanes::vertex || group.vertexCount > FusedLimits::laneVertices))
        throw Error(
            group.location,
            wanted == Lanes::vertex
                ? concat(name(group.solver), ", which \"", group.name,
                         "\" takes, goes over the springs of a molecule one after the other, in one lane: "
                         "leave out --lanes vertex or use an explicit solver")
                : concat(name(group.solver), " keeps a molecule in one lane, which holds at most ",
                         FusedLimits::laneVertices, " vertices; a molecule of \"", group.name, "\" has ",
                         group.vertexCount, ": use an explicit solver"));
    if (implicit && group.springCount > FusedLimits::laneSprings)
        throw Error(group.location,
                    concat(name(group.solver), " writes out the springs of a molecule, at most ",
                           FusedLimits::laneSprings, "; a molecule of \"", group.name, "\" has ",
                           group.springCount, ": use an explicit solver"));
    if (group.needs.life && group.vertexCount > FusedLimits::laneVertices)
        throw Error(group.location, concat("molecules of more than ", FusedLimits::laneVertices,
                                           " vertices cannot be born or die; one of \"", group.name,
                                           "\" has ", group.vertexCount));
    if (implicit) {
        checkSeconds(plan, group, limits, "use an explicit solver");
        return Lanes::molecule;
    }
    if (wanted != Lanes::molecule && group.vertexCount > FusedLimits::vertices(limits.maxSharedBytes)) {
        if (wanted == Lanes::automatic && fitsLane(group)) return Lanes::molecule;
        throw Error(group.location, concat("a molecule of \"", group.name, "\" has ", group.vertexCount,
                                           " vertices; a workgroup holds at most ",
                                           FusedLimits::vertices(limits.maxSharedBytes), " on this device"));
    }
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
