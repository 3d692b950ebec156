#include "compile/path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "compile/corotated.h"
#include "compile/passes.h"
#include "core/error.h"

namespace shoal {

namespace {

// All groups' vertices share the rows of one texture.
void checkTextures(const Plan& plan, const PathLimits& limits) {
    int64_t rows = 0;
    for (const GroupPlan& group : plan.groups) {
        const int64_t vertices = group.vertexCount, own = vertices * stateRows(size_t(group.count));
        if (rows + own > limits.maxTextureSize) {
            const int64_t fit = std::max<int64_t>(0, (limits.maxTextureSize - rows) / vertices) * stateWidth;
            throw Error(
                group.location,
                concat(many(group.count, "molecule", "molecules"), " of ",
                       many(vertices, "vertex", "vertices"), " take ", own,
                       " rows of the ping-pong path's textures (", (own * stateWidth * 16 * 4) >> 20, " MiB)",
                       rows > 0 ? ", beside the groups before" : "", "; this context holds ",
                       limits.maxTextureSize - rows, " more rows: at most ", fit, " such molecules fit"));
        }
        rows += own;
    }
}

// Fragments and passes read these tables from textures. A distance field's samples grow with the cube of its
// resolution.
void checkTables(const Plan& plan, const PathLimits& limits) {
    const size_t most = size_t(limits.maxTextureSize) * stateWidth;
    if (plan.topology.size() > most)
        throw Error(concat("the molecules' springs and triangles take ", plan.topology.size(),
                           " texels, and a table of this context holds ", most));
    if (plan.samples.size() > most)
        throw Error(concat("grids, height fields and distance fields have ", plan.samples.size(),
                           " samples, and a table of this context holds ", most,
                           ": distance fields alone would fit at ",
                           std::floor(95 * std::cbrt(double(most) / double(plan.samples.size()))),
                           " % of their resolutions"));
}

// Contact in fragment shaders has tables of its own.
void checkContact(const Plan& plan, const PathLimits& limits) {
    const ContactPlan& contact = plan.contact;
    constexpr int targets = contactsInFragments / 4 + 1;
    if (contact.any() && limits.targets < targets)
        throw Error(contact.settings.location,
                    concat("contact between molecules draws into ", targets,
                           " textures at once; this context allows ", limits.targets));
    size_t cells = contact.cells();
    while (1 << rowBits(cells) > limits.maxTextureSize)
        cells /= 2;
    if (cells == contact.cells()) return;
    throw Error(contact.settings.location,
                concat("contact between ", contact.spheres,
                       " spheres is more than the textures of this context hold: at most ", cells / 2));
}

void checkPingPong(const Plan& plan, const PathLimits& limits) {
    if (plan.fieldSampling != FieldSampling::vertexSubstep)
        throw Error(concat("the ping-pong path reads fields at every vertex and substep: field sampling ",
                           name(plan.fieldSampling), " needs the fused path"));
    for (const GroupPlan& group : plan.groups)
        if (group.needs.life) throw Error(group.life->cycle.location, "birth and death need the fused path");
    if (plan.school.any())
        throw Error(plan.school.members[0].school.location, "schooling needs the fused path");
    for (const GroupPlan& group : plan.groups)
        if (solver(group.solver).implicit)
            throw Error(group.location, concat(name(group.solver), ", which \"", group.name,
                                               "\" takes, needs the fused path; the explicit solvers "
                                               "run on the ping-pong path as well"));
    for (const ContactGroup& group : plan.contact.groups)
        if (group.triangles || group.self)
            throw Error(
                plan.groups[group.group].location,
                concat(group.triangles ? "contact of spheres on triangles" : "contact within a molecule",
                       ", which \"", plan.groups[group.group].name, "\" asks for, needs the fused path"));
    checkTables(plan, limits);
    checkContact(plan, limits);
    checkTextures(plan, limits);
}

// The matrix of bdf2-corotated is a uniform block, but for CPU rasterisers.
void checkMatrix(const GroupPlan& group, const PathLimits& limits) {
    if (!group.factored() || limits.software) return;
    const int bytes = corotatedElements(blockPattern(group.shape, group.needs.pins)) * int(sizeof(glm::vec4));
    if (bytes <= limits.maxUniformBlockBytes) return;
    throw Error(group.location,
                concat("the matrix of \"", group.name, "\" takes ", bytes, " bytes; a uniform block holds ",
                       limits.maxUniformBlockBytes, " on this device: use bdf2-xpbd"));
}

void checkUniforms(const Plan& plan, const PathLimits& limits) {
    // beside the two arrays a kernel has about 40 numbers of its own
    size_t own = 0;
    for (const GroupPlan& group : plan.groups)
        own = std::max(own, group.forces.parameterCount +
                                (countsMuscles(group.needs) ? muscleAngles(group.muscles, 0).size() : 0));
    const size_t uniforms = 4 * (plan.fields.parameters.size() + plan.colliders.parameters.size() + own) + 64;
    if (uniforms > size_t(limits.maxUniformComponents))
        throw Error(concat("fields, forces, colliders and muscles take ", uniforms,
                           " numbers of uniforms; a shader holds ", limits.maxUniformComponents,
                           " on this device"));
}

void checkFused(const Plan& plan, const PathLimits& limits, Lanes lanes) {
    if (!limits.compute)
        throw Error(concat("compute shaders need OpenGL 4.3; this context has ", limits.version));
    checkUniforms(plan, limits);
    for (const GroupPlan& group : plan.groups) {
        checkMatrix(group, limits);
        chooseLanes(plan, group, lanes, limits);
    }
}

// A molecule is a texel of each layer.
void checkLayers(const GroupPlan& group, const PathLimits& limits) {
    const int layers = group.layout().stateElements();
    if (layers > limits.maxTextureLayers)
        throw Error(group.location,
                    concat("a molecule of \"", group.name, "\" takes ", layers,
                           " layers of a texture; this context has ", limits.maxTextureLayers));
    const int64_t fit = int64_t(limits.maxTextureSize) * stateWidth;
    if (group.count > fit)
        throw Error(group.location, concat(many(group.count, "molecule", "molecules"), " of \"", group.name,
                                           "\" do not fit a texture of this context: at most ", fit, " do"));
}

void checkFragments(const Plan& plan, const PathLimits& limits) {
    constexpr int fewest = 4;  // as WebGL 2 has: bodies of schools, and records of spheres
    if (limits.targets < fewest)
        throw Error(concat("fragments draw into ", fewest, " textures at once; this context allows ",
                           limits.targets));
    checkTables(plan, limits);
    checkContact(plan, limits);
    checkUniforms(plan, limits);
    for (const GroupPlan& group : plan.groups) {
        checkMatrix(group, limits);
        if (!group.isStill()) checkLane(plan, group, limits);
        checkLayers(group, limits);
    }
}

template <typename Check>
std::optional<Error> complaintOf(const Check& check) {
    try {
        check();
    } catch (const Error& error) {
        return error;
    }
    return {};
}

}  // namespace

const char* name(Path path) {
    static constexpr const char* names[] = {"auto", "fused", "fragments", "ping-pong"};
    return names[size_t(path)];
}

Path path(const std::string& word) {
    for (const Path path : {Path::automatic, Path::fused, Path::fragments, Path::pingPong})
        if (word == name(path)) return path;
    throw Error(
        concat("unknown path \"", word, "\"", suggestion(word, {"auto", "fused", "fragments", "ping-pong"})));
}

PathChoice choosePath(const Plan& plan, Path wanted, const PathLimits& limits, Lanes lanes) {
    if (wanted == Path::pingPong) {
        if (lanes != Lanes::automatic) throw Error("lanes are of the fused path, not of ping-pong");
        checkPingPong(plan, limits);
        return {Path::pingPong, "as asked"};
    }
    const bool inFragments = wanted == Path::fragments || !limits.compute;
    if (inFragments && lanes == Lanes::vertex)
        throw Error(concat("a lane a vertex needs compute shaders",
                           limits.compute ? "" : concat(", OpenGL 4.3; this context has ", limits.version)));
    if (wanted == Path::fragments) {
        checkFragments(plan, limits);
        return {Path::fragments, "as asked"};
    }
    const bool asked = wanted == Path::fused || lanes != Lanes::automatic;
    if (asked && limits.compute) {
        checkFused(plan, limits, lanes);
        return {Path::fused, "as asked", lanes};
    }
    if (asked) {
        checkFragments(plan, limits);
        return {Path::fragments,
                concat("as asked, in fragment shaders: OpenGL ", limits.version, " has no compute shaders")};
    }
    const auto checkRight = [&](Path path) {
        if (const std::string& why = limits.wrong[size_t(path)]; !why.empty()) throw Error(why);
    };
    const std::optional<Error> fused = complaintOf([&] {
        checkRight(Path::fused);
        checkFused(plan, limits, lanes);
    });
    if (!fused) return {Path::fused, "each molecule is read and written once a frame"};
    // What a CPU rasteriser would compile for too long as compute shaders, it would for as long as fragments.
    const bool tooLong = limits.compute && limits.software &&
                         std::any_of(plan.groups.begin(), plan.groups.end(),
                                     [&](const GroupPlan& group) { return takesLong(plan, group); });
    const std::optional<Error> fragments = tooLong ? fused : complaintOf([&] {
        checkRight(Path::fragments);
        checkFragments(plan, limits);
    });
    if (!fragments) return {Path::fragments, fused->message()};
    const std::optional<Error> other = complaintOf([&] {
        checkRight(Path::pingPong);
        checkPingPong(plan, limits);
    });
    const Error& first = limits.compute ? *fused : *fragments;
    if (other)
        throw Error(first.location().empty() ? other->location() : first.location(),
                    concat("no path can run this scene: ", first.message(), "; ", other->message()));
    return {Path::pingPong, first.message()};
}

static int mostVertices(Path wanted, const PathLimits& limits) {
    const int fused = std::max(FusedLimits::vertices(limits.maxSharedBytes), FusedLimits::laneVertices);
    // what never moves has no step in fragments, only layers: of 3 floats a vertex, positions and velocities
    const int fragments = std::max(limits.maxTextureLayers * 4 / 6, FusedLimits::laneVertices);
    const int pingPong = limits.maxTextureSize;  // a row for each vertex
    switch (wanted) {
    case Path::automatic:
        return std::max({limits.compute ? fused : 0, fragments, pingPong});
    case Path::fused:
        return limits.compute ? fused : fragments;
    case Path::fragments:
        return fragments;
    case Path::pingPong:
        return pingPong;
    }
    return 0;
}

void checkVertices(const Scene& scene, Path wanted, const PathLimits& limits) {
    const int most = mostVertices(wanted, limits);
    for (const Group& group : scene.groups) {
        const size_t vertices = group.molecule.vertices.size();
        if (vertices > size_t(most))
            throw Error(
                group.location,
                concat("a molecule of \"", group.name.empty() ? group.molecule.name : group.name, "\" has ",
                       vertices, " vertices; ",
                       wanted == Path::automatic ? "no path holds"
                                                 : concat("the path ", name(wanted), " does not hold"),
                       " more than ", most, " on this device"));
    }
}

static size_t layerBytes(const Plan& plan, bool drawn) {
    size_t texels = 0;
    for (const GroupPlan& group : plan.groups) {
        const BufferLayout layout = group.layout();
        const int layers = 2 * layout.stateElements() + (group.needs.records ? 2 : 1) +
                           (group.needs.scale || group.needs.phase ? 1 : 0) +
                           (drawn && group.needs.normals ? layout.positionElements() : 0) +
                           (group.needs.steers ? 2 * steeringElements : 0);
        texels += size_t(layers) * stateWidth * size_t(stateRows(size_t(group.count)));
    }
    return texels * sizeof(glm::vec4);
}

size_t stateBytes(const Plan& plan, Path path, bool drawn, bool inPlace) {
    if (path == Path::pingPong) {
        bool acceleration = false, normals = false, stages = false;
        size_t rows = 0, recordRows = 0;
        for (const GroupPlan& group : plan.groups) {
            recordRows += size_t(stateRows(size_t(group.count)));
            rows += size_t(group.vertexCount) * size_t(stateRows(size_t(group.count)));
            acceleration |= keepsAcceleration(group);
            normals |= group.needs.normals;
            stages |= solver(group.solver).rungeKutta();
        }
        const size_t textures = 4 + (acceleration ? 2 : 0) + (stages ? 8 : 0) + (normals ? 1 : 0);
        return (textures * rows + 3 * recordRows) * stateWidth * sizeof(glm::vec4);
    }
    if (path == Path::fragments) return layerBytes(plan, drawn);
    size_t elements = 0;
    for (const GroupPlan& group : plan.groups) {
        const BufferLayout layout = group.layout();
        const size_t state = size_t(layout.stateElements()) * (inPlace ? 1 : 2);
        const size_t normals = drawn && group.needs.normals ? size_t(layout.positionElements()) : 0;
        const size_t constants = group.needs.scale || group.needs.phase ? 1 : 0;
        const size_t steering = group.needs.steers ? size_t(steeringElements) : 0;
        elements += layout.padded(size_t(group.count)) * (state + normals + 1 + constants + steering);
    }
    return elements * sizeof(glm::vec4);
}

size_t tableBytes(const Plan& plan, Path path) {
    const auto texels = [&](const std::vector<glm::vec4>& table) {
        return path == Path::fused ? table.size() : size_t(stateRows(table.size())) * stateWidth;
    };
    size_t tiles = 0;
    for (const NoiseTile& tile : plan.fields.noiseTiles)
        tiles += tile.bytes();
    return (texels(plan.topology) + texels(plan.samples)) * sizeof(glm::vec4) + tiles;
}

}  // namespace shoal
