#include "compile/lanes.h"

#include <algorithm>

#include "compile/path.h"
#include "core/contract.h"
#include "core/error.h"

namespace shoal {

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
    if (wanted == Lanes::automatic)
        return laneFits && (limits.software || group.vertexCount <= 16) ? Lanes::molecule : Lanes::vertex;
    if (wanted == Lanes::molecule && group.vertexCount > FusedLimits::laneVertices)
        throw Error(group.location, concat("a molecule of \"", group.name, "\" has ", group.vertexCount,
                                           " vertices; a lane holds at most ", FusedLimits::laneVertices));
    return wanted;
}

}  // namespace shoal
