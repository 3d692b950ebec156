#include "simulate/self_check.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/cache_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "gpu/program_cache.h"
#include "scene/field_kinds.h"
#include "scene/known_colliders.h"
#include "simulate/simulation.h"

namespace shoal {

namespace {

constexpr int checkedFrames = 8;
constexpr double side = 0.1;  // m, of a square

// A square with its diagonals, so stiff that it bends little in the time.
Molecule square() {
    Molecule out;
    out.name = "self-check";
    for (const glm::dvec3& corner : {glm::dvec3(0), {side, 0, 0}, {side, 0, side}, {0, 0, side}})
        out.vertices.push_back({.position = corner, .mass = 0.01});
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}})
        out.springs.push_back({a, b, 50, 0.02, {}, {}});
    out.triangles = {{0, 2, 1}, {0, 3, 2}};
    return out;
}

Group groupAt(const char* name, Molecule molecule, const std::vector<glm::dvec3>& places) {
    Group out;
    out.name = name;
    out.molecule = std::move(molecule);
    out.count = int(places.size());
    out.place.kind = Placement::Kind::list;
    out.place.turn = Placement::Turn::none;
    for (const glm::dvec3& place : places)
        out.place.items.push_back({.position = place});
    return out;
}

// Squares that spin fall onto a plane in a wind.
void addSquares(Scene& scene) {
    Field wind;
    wind.shape = UniformField{.velocity = {1, 0, 0.5}};
    scene.fields.push_back(std::move(wind));
    Collider floor;
    floor.shape = PlaneCollider{};
    scene.colliders.push_back(std::move(floor));
    scene.groups.push_back(
        groupAt("squares", square(), {{0, 0.06, 0}, {0.5, 0.08, 0}, {0, 0.1, 0.5}, {0.5, 0.12, 0.5}}));
    Group& group = scene.groups.back();
    group.drag = {.normal = 4, .tangent = 0.5};
    group.velocity = {0, -1, 0};
    group.spin = {3, 0, 2};
}

// Marbles come to rest on, and roll off, two that are held.
void addMarbles(Scene& scene) {
    Molecule marble;
    marble.name = "marble";
    marble.vertices.push_back({.position = {0, 0, 0}, .mass = 0.1});
    scene.groups.push_back(
        groupAt("marbles", marble, {{0, 0.1, 0}, {0.09, 0.105, 0}, {0.04, 0.19, 0.01}, {0.05, 0.3, -0.01}}));
    marble.vertices[0].pinned = true;
    scene.groups.push_back(groupAt("held", marble, {{0, 0, 0}, {0.09, 0, 0}}));
    for (Group& group : scene.groups)
        group.contact.emplace().radius = 0.05;
    scene.contact.iterations = 8;
}

Scene checkedScene(CheckedPart part) {
    Scene scene;
    scene.name = "self-check";
    scene.gravity = {0, -9.81, 0};
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 2;
    part == CheckedPart::step ? addSquares(scene) : addMarbles(scene);
    return scene;
}

using Middles = std::array<glm::dvec3, 4>;

// Returns where the middle of each molecule of the first group should be after the last frame, m, as the
// paths have it within a few units of the last place.
const Middles& expected(CheckedPart part) {
    static const Middles step = {{{0.0502417, 0.0020000, 0.0530920},
                                  {0.5503501, 0.0020006, 0.0536696},
                                  {0.0496269, 0.0026453, 0.5560571},
                                  {0.5499380, 0.0047720, 0.5563266}}};
    static const Middles contact = {{{-0.0044317, 0.0994030, -0.0000648},
                                     {0.0951754, 0.0993647, 0.0000019},
                                     {0.0435281, 0.1858363, 0.0108360},
                                     {0.0530110, 0.2827823, -0.0094628}}};
    return part == CheckedPart::step ? step : contact;
}

// Returns the key of a verdict within this process: the driver, the path, the part, and the folder of the
// shaders.
std::string keyOf(const gpu::Context& context, Path path, CheckedPart part) {
    const gpu::ContextInfo& info = context.info();
    return concat(gpu::name(info.kind), "\n", info.renderer, "\n", info.vendor, "\n", info.version, "\n",
                  name(path), "\n", int(part), "\n", context.shaders());
}

// Returns the key of a verdict between runs: that of the process, `all`, and the text of all shaders.
std::string fileKey(const gpu::Context& context, std::string all) {
    std::vector<std::filesystem::path> files;
    std::error_code code;  // a context without shaders says so when a program is made
    for (std::filesystem::recursive_directory_iterator file(context.shaders(), code), end;
         !code && file != end; file.increment(code))
        if (file->is_regular_file(code)) files.push_back(file->path());
    std::sort(files.begin(), files.end());
    for (const std::filesystem::path& file : files)
        all += readFile(file);
    return contentKey(all);
}

}  // namespace

double selfCheckError(gpu::Context& context, Path path, CheckedPart part) {
    SimulationOptions options;
    options.path = path;
    Simulation simulation(context, compile(checkedScene(part)), options);
    for (int i = 0; i < checkedFrames; ++i)
        simulation.frame();
    const Snapshot state = simulation.snapshot(0);
    const Middles& wanted = expected(part);
    const size_t vertices = size_t(state.vertexCount);
    double worst = 0;
    for (size_t m = 0; m < wanted.size(); ++m) {
        glm::dvec3 middle(0);
        for (size_t v = 0; v < vertices; ++v)
            middle += state.positions[vertices * m + v] / double(vertices);
        const double off = glm::distance(middle, wanted[m]);
        worst = off >= 0 ? std::max(worst, off) : std::numeric_limits<double>::infinity();
    }
    return worst;
}

std::string selfCheck(gpu::Context& context, Path path, CheckedPart part) {
    static std::map<std::string, std::string> known;
    const std::string key = keyOf(context, path, part);
    if (const auto found = known.find(key); found != known.end()) return found->second;
    const std::filesystem::path folder = context.cache().folder();
    const std::filesystem::path file =
        folder.empty() ? std::filesystem::path() : folder / concat("check-", fileKey(context, key), ".txt");
    std::error_code code;
    if (!file.empty() && std::filesystem::is_regular_file(file, code)) {
        try {
            return known[key] = readFile(file, 1000);
        } catch (const Error&) {  // is checked again
        }
    }
    const gpu::OtherCache uncounted(context, "");  // runs of the program count its own programs alone
    std::string why;
    try {
        const double error = selfCheckError(context, path, part);
        if (!(error < selfCheckTolerance))
            why = concat(part == CheckedPart::contact ? "contact" : "the step", " is off by ", error * 1000,
                         " mm with ", context.info().version);
    } catch (const Error&) {
        return {};  // whoever runs the path is told why it cannot be had
    }
    if (!file.empty()) {
        try {
            writeFile(file, why);
        } catch (const Error&) {  // the next run checks again
        }
    }
    return known[key] = why;
}

}  // namespace shoal
