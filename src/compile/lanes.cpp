#include "compile/lanes.h"

#include <algorithm>

#include "compile/path.h"
#include "core/contract.h"
#include "core/error.h"

namespace shoal {

namespace {

// What the choice rests on.
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

// A CPU rasteriser runs a lane a molecule 12 to 35 times faster (docs/performance.md), but takes long to
// compile what is written out. Seconds to the first frame on 2 busy cores of an Intel Xeon, llvmpipe,
// Mesa 22.3.6, no cache, chains in a gust over a plane: a lane a molecule 6.1 with 32 vertices, 29 with 60,
// and 9.6 with 60 without the plane; a lane a vertex 3.2 with 32 and with 60.
constexpr int softwareLane = 32, softwareLaneTouching = 24;

int mostOfLane(const GroupPlan& group, const PathLimits& limits) {
    if (limits.software) return group.needs.collide ? softwareLaneTouching : softwareLane;
    return !group.needs.collide && group.count >= many ? gpuLaneFree : gpuLane;
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

Lanes chooseLanes(const GroupPlan& group, Lanes wanted, const PathLimits& limits) {
    const bool implicit = solver(group.solver).implicit;
    const bool laneFits =
        group.vertexCount <= FusedLimits::laneVertices && group.springCount <= FusedLimits::laneSprings;
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
    if (implicit) return Lanes::molecule;
    if (wanted != Lanes::molecule && group.vertexCount > FusedLimits::vertices(limits.maxSharedBytes)) {
        if (wanted == Lanes::automatic && laneFits) return Lanes::molecule;
        throw Error(group.location, concat("a molecule of \"", group.name, "\" has ", group.vertexCount,
                                           " vertices; a workgroup holds at most ",
                                           FusedLimits::vertices(limits.maxSharedBytes), " on this device"));
    }
    if (wanted == Lanes::automatic)
        return laneFits && group.vertexCount <= mostOfLane(group, limits) ? Lanes::molecule : Lanes::vertex;
    if (wanted == Lanes::molecule && group.vertexCount > FusedLimits::laneVertices)
        throw Error(group.location, concat("a molecule of \"", group.name, "\" has ", group.vertexCount,
                                           " vertices; a lane holds at most ", FusedLimits::laneVertices));
    return wanted;
}

}  // namespace shoal
