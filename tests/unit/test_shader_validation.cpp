// Every shader through the reference compiler: the passes as desktop 3.3 and as WebGL 2's language, with each
// set of defines that a plan can ask for; the renderer's as 3.3; the fused path's kernels as 4.3. A driver
// that is generous hides mistakes.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "compile/contact_plan.h"
#include "compile/generate.h"
#include "compile/generate_forces.h"
#include "core/file.h"
#include "gpu/shader_source.h"
#include "scene/field_kinds.h"
#include "simulate/fused_kernel.h"
#include "simulate/watchdog.h"
#include "support/catch.h"
#include "support/every_kind.h"
#include "support/scratch.h"
#include "support/shapes.h"

using namespace shoal;

namespace {

using Defines = std::vector<std::string>;

// WebGL 2's language, and the precisions that it demands.
constexpr const char* header300es =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp sampler3D;\n"
    "precision highp sampler2DShadow;\n"
    "precision highp sampler2DArray;\n"
    "precision highp usampler2D;\n"
    "precision highp usampler2DArray;\n";

bool hasValidator() {
    static const bool found = std::system("glslangValidator --version >/dev/null 2>&1") == 0;
    if (!found)
        WARN("skipped: glslangValidator is not installed (on Debian and Ubuntu: apt install glslang-tools)");
    return found;
}

struct Output {
    bool ok = false;
    std::string log;
};

Output validate(const std::string& files) {
    std::FILE* pipe = ::popen(("glslangValidator " + files + " 2>&1").c_str(), "r");
    if (!pipe) return {false, "glslangValidator cannot be started"};
    Output out;
    char chunk[4096];
    while (const size_t count = std::fread(chunk, 1, sizeof chunk, pipe))
        out.log.append(chunk, count);
    out.ok = ::pclose(pipe) == 0;
    return out;
}

// Returns the validator's complaint about a file, with its lines led back to the files that they came from.
std::string complaint(const std::string& file, const gpu::ShaderSource& source) {
    const Output output = validate(file);
    return output.ok ? std::string() : source.rewriteLog(output.log);
}

// Gathers shaders, each text once, and validates them together; one by one only when something is wrong.
class Validator {
  public:
    std::map<std::string, std::string> generated;

    void add(const std::string& file, const Defines& defines, const char* header) {
        add(file, defines, header,
            gpu::resolveShader(std::string(SHOAL_SOURCE_DIR) + "/shaders", file, defines, generated, header));
    }
    void addKernel(const Plan& plan, const KernelOptions& options) {
        const gpu::ProgramOptions program = kernelProgram(plan, 0, options);
        for (const std::string& file : {program.compute, program.vertex, program.fragment}) {
            if (file.empty()) continue;
            for (const char* header : options.targets ? std::vector{gpu::header330(), header300es}
                                                      : std::vector{gpu::header430()}) {
                gpu::ShaderSource source =
                    gpu::resolveShader(std::string(SHOAL_SOURCE_DIR) + "/shaders", file, program.defines,
                                       program.generated, header);
                program.rewrite(source);
                add(file, program.defines, header, std::move(source));
            }
        }
    }
    // All that is drawn of a group in fragments.
    void addFragments(const Plan& plan, KernelOptions options) {
        options.targets = 4;
        const auto add = [&](bool need, KernelOptions::Work work) {
            options.work = work;
            if (need) addKernel(plan, options);
        };
        add(true, KernelOptions::Work::frame);
        add(true, KernelOptions::Work::watch);
        add(plan.groups[0].needs.normals, KernelOptions::Work::normals);
        add(plan.contact.any(), KernelOptions::Work::touched);
        add(plan.groups[0].life.has_value(), KernelOptions::Work::births);
    }
    // For each form of the state: with TEXTURES among the defines, in layers as well. What needs a buffer is
    // not for WebGL 2.
    void addPicture(const std::string& file, Defines defines) {
        const auto has = [&defines](const char* name) {
            return std::find(defines.begin(), defines.end(), name) != defines.end();
        };
        const bool ofBuffers = has("ORDER_BUFFER") || has("SLAB_DRAWS") || has("BLOCK 64");
        const bool inTextures = has("TEXTURES");
        for (const bool layered : {false, true}) {
            if (layered && !inTextures) break;
            if (!layered && inTextures && has("LIFE")) continue;  // the ping-pong path has no births
            if (layered) {
                std::replace(defines.begin(), defines.end(), std::string("TEXTURES"), std::string("LAYERED"));
                defines.insert(defines.end(), {"POSITION_ELEMENTS 3", "STATE_ELEMENTS 6"});
            }
            add(file, defines, gpu::header330());
            if (!ofBuffers) add(file, defines, header300es);
        }
    }
    void addBoth(const std::string& file, Defines defines) {
        defines.emplace_back("TEXTURES");
        add(file, defines, gpu::header330());
        add(file, defines, header300es);
    }
    void check() const {
        std::string all;
        for (const Shader& shader : shaders_)
            all += shader.path + " ";
        REQUIRE(!all.empty());
        const bool sound = validate(all).ok;
        CHECK(sound);
        if (sound) return;
        for (const Shader& shader : shaders_) {
            INFO(shader.what);
            CHECK(complaint(shader.path, shader.source) == "");
        }
    }
    size_t count() const { return shaders_.size(); }

  private:
    struct Shader {
        std::string path, what;
        gpu::ShaderSource source;
    };
    void add(const std::string& file, const Defines& defines, const char* header, gpu::ShaderSource source) {
        if (!seen_.insert(source.text).second) return;
        const std::string stage = file.substr(file.rfind('.'));
        const std::string path = scratch_.write("shader" + std::to_string(seen_.size()) + stage, source.text);
        std::string what =
            file + " as " + std::string(header).substr(0, std::string(header).find('\n')) + ", defines:";
        for (const std::string& define : defines)
            what += " " + define;
        shaders_.push_back({path, what, std::move(source)});
    }

    test::Scratch scratch_;
    std::set<std::string> seen_;
    std::vector<Shader> shaders_;
};

template <typename Shape>
Field field(Shape shape, bool boxed = false) {
    Field out;
    out.shape = std::move(shape);
    if (boxed) out.box = Box{};
    return out;
}

std::vector<Field> everyField() {
    std::vector<Field> out = test::everyField();
    GridField wrapped;
    wrapped.resolution = {2, 1, 1};
    wrapped.high = {1, 1, 1};
    wrapped.values.resize(2);
    wrapped.wrap = true;
    CurlNoiseField eddies;
    eddies.octaves = 4;
    eddies.seed = 0xffffffffu;  // beyond an int
    GustField vertical;
    vertical.direction = {0, 1, 0};
    out.push_back(field(eddies));
    out.push_back(field(vertical, true));
    out.push_back(field(std::move(wrapped), true));
    return out;
}

std::vector<Collider> everyCollider() {
    std::vector<Collider> out;
    for (test::KindOfCollider& kind : test::kindsOfCollider())
        out.emplace_back().shape = std::move(kind.shape);
    return out;
}

std::vector<Force> everyForce() {
    std::vector<Force> out = test::everyForce();
    for (size_t i = 0; i < out.size(); ++i)
        out[i].name = concat("force ", i, "\n}}} #error \\");  // must not leave its comment
    return out;
}

// Every combination of the words given.
std::vector<Defines> combinations(const Defines& words) {
    std::vector<Defines> out;
    for (size_t bits = 0; bits < size_t(1) << words.size(); ++bits) {
        Defines set;
        for (size_t i = 0; i < words.size(); ++i)
            if (bits >> i & 1) set.push_back(words[i]);
        out.push_back(std::move(set));
    }
    return out;
}

std::map<std::string, std::string> generate(const std::vector<Field>& fields,
                                            const std::vector<Collider>& colliders) {
    std::vector<glm::vec4> samples;
    return {{"generated/fields.glsl", generateFields(fields, samples).source},
            {"generated/scene_forces.glsl", generateForces(everyForce(), "", true).source},
            {"generated/colliders.glsl", generateColliders(colliders, samples).source}};
}

// A leaf with what the words name.
Scene leafScene(const Defines& words, SolverKind solver, FieldSampling sampling) {
    const auto has = [&](const char* word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    Scene scene;
    scene.solver = {solver, 32, sampling, {}};
    Group group;
    group.name = "leaf\n}}} #error \\";  // must not leave its comment
    group.molecule = test::leaf(200, 1);
    group.count = 1;
    if (has("muscles")) group.molecule.springs[2].actuation = Actuation{0.1, 1, 0};
    if (has("instances differ")) group.place.scale = {0.5, 0.6}, group.phaseSpread = 1;
    if (!has("springs")) group.molecule.springs.clear();
    if (!has("triangles")) group.molecule.triangles.clear();
    group.drag = has("drag by direction") ? Drag{4, 1} : Drag{1, 1};
    group.molecule.vertices[1].pinned = has("pins") || has("release");
    if (has("release")) group.release = Release{1.0, 1.0, 0};
    if (has("fields")) scene.fields = everyField();
    if (has("colliders")) scene.colliders = everyCollider();
    if (has("forces")) scene.forces = everyForce();
    scene.groups.push_back(std::move(group));
    return scene;
}

constexpr SolverKind bothSolvers[] = {SolverKind::euler, SolverKind::leapfrog};
constexpr Lanes bothLanes[] = {Lanes::molecule, Lanes::vertex};

}  // namespace

TEST_CASE("the passes are sound in desktop and in embedded GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    validator.generated = generate(everyField(), everyCollider());
    validator.addBoth("passes/fullscreen.vert", {});
    for (const Defines& set : combinations({"LEAPFROG", "SPRINGS", "FIELDS", "DIRECTIONAL_DRAG", "RECORDS"}))
        validator.addBoth("passes/advect.frag", set);
    for (const Defines& set : combinations({"LEAPFROG", "FIELDS", "FORCES"})) {
        validator.addBoth("passes/advect.frag", set);
        validator.addBoth("passes/stage.frag", set);
    }
    for (const Defines& set : combinations({"VERLET", "PINS"})) {
        validator.addBoth("passes/thrust.frag", set);
        Defines forced = set;
        forced.emplace_back("FORCES");
        validator.addBoth("passes/collide.frag", set);
        validator.addBoth("passes/collide.frag", forced);
    }
    for (const Defines& pins : {Defines{}, Defines{"PINS"}, Defines{"PINS", "RELEASE", "RECORDS"}}) {
        validator.addBoth("passes/collide.frag", pins);
        for (const Defines& set :
             std::vector<Defines>{{"ACCELERATION"}, {"LEAPFROG", "ACCELERATION"}, {"RK4"}}) {
            Defines sprung = pins;
            sprung.insert(sprung.end(), set.begin(), set.end());
            sprung.emplace_back("SPRINGS");
            validator.addBoth("passes/collide.frag", sprung);
        }
        for (Defines set : combinations({"LEAPFROG", "ACCELERATION", "MUSCLES 2"})) {
            set.insert(set.end(), pins.begin(), pins.end());
            set.emplace_back("SPRINGS");
            validator.addBoth("passes/restore.frag", set);
            validator.addBoth("passes/records.frag", set);
            set.emplace_back("SPRING_DAMPING");
            validator.addBoth("passes/restore.frag", set);
            validator.addBoth("passes/records.frag", set);
        }
    }
    for (const Defines& set : combinations({"LEAPFROG", "DIRECTIONAL_DRAG", "SPRINGS"}))
        validator.addBoth("passes/normals.frag", set);
    validator.addBoth("passes/watch.frag", {fastestDefine()});
    const Defines textures{"ROW_BITS 6",
                           "LIST 24",
                           "NEIGHBORS 4",
                           concat("NEAR ", ContactPlan::near),
                           concat("MOST_WALLS ", ContactPlan::mostWalls),
                           "ENTRIES_A_DRAW 8"};
    const auto contact = [&](const char* file, Defines set = {}) {
        set.insert(set.end(), textures.begin(), textures.end());
        validator.addBoth(std::string("contact/") + file + ".frag", set);
    };
    for (const char* file : {"spheres", "keys", "order", "slots", "find", "neighbors", "nearest", "apply"})
        contact(file);
    for (const char* file : {"spheres", "apply"})
        contact(file, {"PINS", "RELEASE"});
    for (Defines set : combinations({"SELF", "STAGGERED", "SWEPT", "WALLS"})) {
        set.emplace_back("REMEMBERS");
        for (const char* file : {"order", "slots", "find", "neighbors"})
            contact(file, set);
    }
    for (const Defines& spread : {Defines{}, Defines{"SPREAD"}, Defines{"SPREAD", "BODIES"}}) {
        for (Defines set : combinations({"WALLS"})) {
            set.insert(set.end(), spread.begin(), spread.end());
            set.emplace_back("REMEMBERS");
            for (const char* file : {"prepare", "prepare_sums", "constrain", "relax", "relax_sums", "settle"})
                contact(file, set);
        }
    }
    const Defines sizes = {"LAYERED",          "STATE_WIDTH 1024", "POSITION_ELEMENTS 3",
                           "STATE_ELEMENTS 6", "VERTICES 4",       "SPHERES 6"};
    for (Defines set : combinations({"TRIANGLES", "CONSTANTS", "LIFE", "RIGID"})) {
        const bool rigid = std::find(set.begin(), set.end(), "RIGID") != set.end();
        set.insert(set.end(), sizes.begin(), sizes.end());
        Defines walls = set;
        walls.insert(walls.end(), {"WALLS", "CONTACT_RADIUS 0.1"});
        contact("walls", walls);
        if (rigid) set.emplace_back("BODIES");
        for (const char* file : {"spheres", "effective_sum", "spread"})
            contact(file, set);
        set.emplace_back("APPLIES");
        contact("gains", set);
        set.emplace_back("MANY");
        contact("gains", set);
    }
    CHECK(validator.count() > 120);
    validator.check();
}

TEST_CASE("each field and each collider is sound GLSL by itself", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const Field& one : everyField()) {
        validator.generated = generate({one}, everyCollider());
        validator.addBoth("passes/advect.frag", {"LEAPFROG", "SPRINGS", "FIELDS"});
    }
    for (const Collider& one : everyCollider()) {
        validator.generated = generate(everyField(), {one});
        validator.addBoth("passes/collide.frag", {});
    }
    validator.check();
}

TEST_CASE("the kernels in fragments are sound GLSL, of WebGL 2 as well", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const Solver& solver : solvers()) {
        for (const char* more : {"colliders", "fields", "muscles", "release"}) {
            Scene scene = leafScene({"springs", "triangles", "drag by direction", "forces", "pins", more},
                                    solver.kind, FieldSampling::vertexSubstep);
            scene.groups[0].place.scale = {0.5, 0.6};
            scene.groups[0].contact.emplace().radius = 0.01;
            scene.groups[0].contact->triangles = solver.implicit;
            const bool live = solver.kind != SolverKind::bdf2Corotated && more == std::string("muscles");
            validator.addFragments(compile(scene, {.liveSprings = live}), {});
        }
    }
    for (const FieldSampling sampling : {FieldSampling::vertexFrame, FieldSampling::moleculeFrame})
        validator.addFragments(compile(leafScene({"fields"}, SolverKind::euler, sampling)),
                               {.software = true});
    CHECK(validator.count() > 150);
    validator.check();
}

TEST_CASE("names of fields and colliders cannot leave their comment", "[shaders]") {
    if (!hasValidator()) return;
    std::vector<Field> fields{field(UniformField{})};
    std::vector<Collider> colliders(1);
    fields[0].name = colliders[0].name = "wind\n}}} #error \\";
    Validator validator;
    validator.generated = generate(fields, colliders);
    validator.addBoth("passes/advect.frag", {"FIELDS"});
    validator.addBoth("passes/collide.frag", {});
    validator.check();
}

TEST_CASE("the kernels of every need are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    int number = 0;
    for (const SolverKind solver : bothSolvers) {
        for (const Defines& words : combinations({"springs", "triangles", "drag by direction", "fields",
                                                  "colliders", "pins", "release", "muscles"})) {
            Scene scene = leafScene(words, solver, FieldSampling::vertexSubstep);
            if (++number % 2 == 0) scene.groups[0].place.scale = {0.5, 0.6};
            const Plan plan = compile(scene);
            for (const Lanes lanes : bothLanes)
                validator.addKernel(plan, {.lanes = lanes, .normals = number % 3 == 0});
        }
    }
    CHECK(validator.count() > 300);
    validator.check();
}

TEST_CASE("the kernels of every device and use are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    const Defines all{"springs", "triangles", "drag by direction", "fields",          "colliders",
                      "pins",    "release",   "muscles",           "instances differ"};
    for (const SolverKind solver : bothSolvers) {
        for (const FieldSampling sampling :
             {FieldSampling::vertexSubstep, FieldSampling::vertexFrame, FieldSampling::moleculeFrame}) {
            const Plan plan = compile(leafScene(all, solver, sampling));
            for (const Lanes lanes : bothLanes) {
                for (int bits = 0; bits < 8; ++bits) {
                    KernelOptions options{.lanes = lanes};
                    options.groupVote = (bits & 1) != 0;
                    options.software = (bits & 2) != 0;
                    options.normals = (bits & 4) != 0;
                    options.watch = options.ahead = options.normals;
                    validator.addKernel(plan, options);
                    options.work =
                        options.normals ? KernelOptions::Work::normals : KernelOptions::Work::frame;
                    validator.addKernel(plan, options);
                }
            }
        }
    }
    for (const Solver& solver : solvers()) {
        for (const char* more : {"colliders", "fields"}) {
            const Plan plan = compile(leafScene({"springs", "triangles", "forces", "pins", more}, solver.kind,
                                                FieldSampling::vertexSubstep));
            for (const Lanes lanes : bothLanes)
                if (lanes == Lanes::molecule || !solver.implicit)
                    validator.addKernel(plan, {.lanes = lanes, .normals = true});
        }
    }
    Scene large = leafScene(all, SolverKind::leapfrog, FieldSampling::vertexSubstep);
    Molecule& molecule = large.groups[0].molecule;
    // one contact after the other; what a lane holds at most; more than a workgroup's lanes
    for (const int vertices : {1, 2, 9, 33, 64, 1365}) {
        molecule.springs.clear();
        molecule.triangles.clear();
        molecule.vertices.assign(size_t(vertices), Vertex{});
        const Plan plan = compile(large);
        for (const Lanes lanes : bothLanes)
            if (lanes == Lanes::vertex || fitsLane(plan.groups[0]))
                validator.addKernel(plan, {.lanes = lanes, .normals = true, .groupVote = true});
    }
    CHECK(validator.count() > 80);
    validator.check();
}

TEST_CASE("the renderer's shaders are sound GLSL, of WebGL 2 as well", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const char* file : {"render/screen.vert", "render/sky.frag", "render/picture.frag"})
        validator.addPicture(file, {});
    for (const Defines& lit : combinations({"SHADOWS"})) {
        for (const char* file :
             {"render/molecule.vert", "render/molecule.frag", "render/points.vert", "render/points.frag"}) {
            for (Defines set : combinations({"TEXTURED"})) {
                set.insert(set.end(), lit.begin(), lit.end());
                set.insert(set.end(), {"TEXTURES", "STATE_WIDTH 1024", "BLEND noneBlend"});
                validator.addPicture(file, set);
            }
        }
        for (Defines set : combinations({"SKIN_OFFSETS", "TEXTURES", "GROWS"})) {
            const bool inTextures = std::find(set.begin(), set.end(), "TEXTURES") != set.end();
            set.insert(set.end(), lit.begin(), lit.end());
            set.insert(set.end(), {"BLEND noneBlend", "SKIN_WEIGHTS 8", "STATE_WIDTH 1024"});
            if (!inTextures) set.insert(set.end(), {"BLOCK 64", "POSITION_ELEMENTS 3", "STATE_ELEMENTS 6"});
            validator.addPicture("render/skinned.vert", set);
            validator.addPicture("render/molecule.frag", set);
            set.push_back("DEPTH_ONLY");
            validator.addPicture("render/skinned.vert", set);
        }
        for (Defines set : {Defines{}, Defines{"PLANE"}}) {
            set.insert(set.end(), lit.begin(), lit.end());
            validator.addPicture("render/surface.vert", set);
            validator.addPicture("render/surface.frag", set);
        }
    }
    for (Defines set : combinations({"TEXTURED"})) {
        set.insert(set.end(), {"TEXTURES", "STATE_WIDTH 1024", "DEPTH_ONLY"});
        for (const char* file : {"render/molecule.vert", "render/molecule_shadow.frag", "render/points.vert",
                                 "render/points.frag"})
            validator.addPicture(file, set);
    }
    const std::vector<Defines> orders = {{"ORDER_BUFFER"}, {"ORDER_PAIRED"}, {}};
    for (const Defines& order : orders) {
        for (const char* turns : {"", "SLABS", "SLAB_DRAWS"}) {
            Defines set = order;
            set.insert(set.end(),
                       {"TEXTURES", "STATE_WIDTH 1024", "ORDERED", "BLEND alphaBlend", "LINEAR_LIGHT"});
            if (*turns != 0) set.emplace_back(turns);
            for (const char* file :
                 {"render/molecule.vert", "render/molecule.frag", "render/points.vert", "render/points.frag"})
                validator.addPicture(file, set);
        }
        Defines keys = order;
        keys.insert(keys.end(), {"TEXTURES", "STATE_WIDTH 1024"});
        validator.addPicture("render/slabs.frag", order);
        if (order != orders[0]) {
            validator.addPicture("render/order_keys.frag", keys);
            continue;
        }
        keys.emplace_back("LANES 64");
        validator.add("render/order_keys.comp", keys, gpu::header430());
        keys.emplace_back("STREAMS 6");
        validator.add("render/slab_draws.comp", keys, gpu::header430());
    }
    for (const char* blend : {"BLEND additiveBlend", "BLEND multiplicativeBlend"})
        validator.addPicture("render/molecule.frag", {blend});
    for (const char* file : {"render/molecule.vert", "render/points.vert"})
        validator.addPicture(file, {"TEXTURES", "STATE_WIDTH 1024", "COLOR_BY"});
    for (const char* file : {"render/molecule.frag", "render/points.frag", "render/surface.frag"})
        validator.addPicture(file, {"SHADOWS", "WATER", "BLEND noneBlend"});
    validator.addPicture("render/sky.frag", {"WATER"});
    validator.addPicture("render/picture.frag", {"BEAMS", "OCCLUSION"});
    for (const Defines& pass : {Defines{}, Defines{"BLUR"}})
        validator.addPicture("render/occlusion.frag", pass);
    for (const char* blend : {"BLEND additiveBlend", "BLEND multiplicativeBlend", "BLEND alphaBlend"})
        validator.addPicture("particles/particle.frag", {"WATER", "LIT", "FACING cameraFacing", blend});
    validator.addPicture("water/rays.frag", {});
    validator.addPicture("water/caustics.vert", {"CELLS 176", "MARGIN 0.15"});
    validator.addPicture("water/caustics.frag", {"TEXELS 512"});
    validator.addPicture("render/sky.frag", {"LINEAR_LIGHT"});
    validator.addPicture("render/sky.frag", {"CLOUDS"});
    validator.addPicture("render/clouds.frag", {});
    for (const char* medium : {"WATER", "WIDE_SHADOWS"})
        validator.addPicture("render/surface.frag", {"LINEAR_LIGHT", "SHADOWS", "REFRACTS", medium});
    validator.addPicture("render/picture.frag", {"LINEAR_LIGHT"});
    validator.addPicture("render/picture.frag", {"CLEAR"});
    validator.addPicture("render/picture.frag", {"CLEAR", "LINEAR", "OCCLUSION"});
    validator.addPicture("render/covered.frag", {});
    validator.addPicture("render/surface.vert", {"DEPTH_ONLY"});
    validator.addPicture("render/surface_shadow.frag", {"DEPTH_ONLY"});
    for (const auto& more :
         {std::vector<std::string>{"BLENDED"}, {"IMAGES", "HOLES"}, {"BLENDED", "IMAGES", "HOLES"}}) {
        std::vector<std::string> defines = {"DEPTH_ONLY"};
        defines.insert(defines.end(), more.begin(), more.end());
        validator.addPicture("render/surface_shadow.frag", defines);
    }
    validator.check();
}

TEST_CASE("the shaders of drawn particles are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    const std::vector<Defines> shapes = {
        {"POINTS", "FACING cameraFacing"},
        {"SPRITES", "FACING cameraFacing", "SIZES", "TURNS", "IMAGE", "TILES tileOfSeed", "FADES false"},
        {"FACING cameraFacing", "SIZES", "GROWS", "TURNS", "COLORS", "IMAGE", "TILES tilesAgain",
         "FADES true", "LIFE"},
        {"FACING velocityFacing", "COLORS", "LIFE"},
        {"FACING freeFacing", "TURNS", "IMAGE", "TILES tilesOnce", "FADES false", "LIFE"}};
    const std::vector<Defines> looks = {{"BLEND noneBlend", "DEPTH_ONLY"},
                                        {"BLEND noneBlend", "LIT"},
                                        {"BLEND alphaBlend", "LIT", "SHADOWS", "SOFT", "ORDERED", "SLABS"},
                                        {"BLEND additiveBlend", "SOFT", "ORDERED", "SLAB_DRAWS"},
                                        {"BLEND multiplicativeBlend", "LINEAR_LIGHT"}};
    for (const Defines& shape : shapes) {
        for (Defines set : looks) {
            const bool quads = shape[0] != "POINTS" && shape[0] != "SPRITES";
            set.insert(set.end(), shape.begin(), shape.end());
            set.insert(set.end(),
                       {"TEXTURES", "STATE_WIDTH 1024", "BATCH 64", quads ? "CORNERS 4" : "CORNERS 1"});
            validator.addPicture("particles/particle.vert", set);
            validator.addPicture("particles/particle.frag", set);
        }
    }
    CHECK(validator.count() == 118);
    validator.check();
}

TEST_CASE("the sorts' shaders are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const char* file : {"sort/odd_even_merge.frag", "sort/bitonic.frag"})
        validator.addBoth(file, {});
    validator.addBoth("sort/bitonic.frag", {"TIES_BY_INDEX"});
    validator.addBoth("sort/starts.frag", {"ROW_BITS 4"});
    const Defines sizes = {"LANES 256", "MOST_DIGITS 2048", "TILE_PAIRS 2048"};
    for (const char* file : {"sort/pieces_count.comp", "sort/pieces_scan.comp", "sort/pieces_scatter.comp",
                             "sort/tiles_count.comp", "sort/tiles_scan.comp", "sort/tiles_scatter.comp"})
        validator.add(file, sizes, gpu::header430());
    validator.check();
}

TEST_CASE("the shaders of births are sound GLSL, of WebGL 2 as well", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const Allocator allocator : {Allocator::gpu, Allocator::ring}) {
        Scene scene =
            leafScene({"springs", "triangles", "drag by direction", "fields", "colliders", "forces"},
                      SolverKind::bdf2Xpbd, FieldSampling::vertexSubstep);
        Group& group = scene.groups[0];
        group.name = "leaves";
        group.place.scale = {0.5, 0.6};
        Lifecycle& life = group.life.emplace();
        life.capacity = 2 * group.count;
        life.allocator = allocator;
        life.within = Box{{-1, -1, -1}, {1, 1, 1}};
        life.afterContact = 1;
        using From = Emitter::From;
        for (const From from : {From::point, From::line, From::disc, From::sphere, From::box, From::death}) {
            if (from == From::death && allocator != Allocator::gpu) continue;
            Emitter& emitter = life.emitters.emplace_back();
            emitter.from = from;
            emitter.radius = 1;
            emitter.rate = from == From::death ? 0 : 1;
            emitter.group = from == From::death ? "sparks" : "";
            if (from == From::sphere) emitter.along = Emitter::Along::outward;
        }
        Group sparks = group;
        sparks.name = "sparks";
        sparks.life->emitters.clear();
        scene.groups.push_back(sparks);
        const Plan plan = compile(scene);
        validator.addKernel(plan, {.work = KernelOptions::Work::births});
        validator.addFragments(plan, {});
    }
    for (const char* levels : {"LEVELS 1", "LEVELS 2", "LEVELS 3", "LEVELS 4"}) {
        for (const char* what : {"DEATHS", "CUTS", "WORDS"}) {
            const Defines set = {levels, what, "STATE_WIDTH 1024"};
            for (const char* file : {"control", "list", "sums"})
                validator.addBoth(concat("particles/", file, ".frag"), set);
        }
        for (const char* file : {"control", "sums"})
            validator.addBoth(concat("particles/", file, ".frag"), {levels, "STATE_WIDTH 1024"});
    }
    for (const Defines& set : combinations({"DEATHS", "LIFE"})) {
        Defines all = {"LAYERED", "STATE_WIDTH 1024", "POSITION_ELEMENTS 1", "STATE_ELEMENTS 2"};
        all.insert(all.end(), set.begin(), set.end());
        validator.addBoth("particles/bits.frag", all);
    }
    CHECK(validator.count() > 80);
    validator.check();
}

TEST_CASE("the compute shaders of contact are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    validator.generated = generate({}, everyCollider());
    const Defines common{"LIST 24",
                         "NEIGHBORS 4",
                         concat("NEAR ", ContactPlan::near),
                         concat("MOST_WALLS ", ContactPlan::mostWalls),
                         "REMEMBERS",
                         "BLOCK 16",
                         "POSITION_ELEMENTS 3",
                         "VERTICES 4",
                         "SPHERES 6",
                         "HISTORY",
                         "NO_HISTORY 1e30"};
    const auto add = [&](const char* file, const Defines& set, Defines more = {}) {
        more.insert(more.end(), set.begin(), set.end());
        more.insert(more.end(), common.begin(), common.end());
        more.emplace_back("STATE_ELEMENTS 12");
        validator.add(concat("contact/", file, ".comp"), more, gpu::header430());
    };
    for (const Defines& set : combinations({"RESTING", "SELF", "SWEPT", "WALLS"})) {
        for (const char* file : {"order", "find", "prepare", "relax", "settle"})
            add(file, set);
        for (const Defines& spread : {Defines{"SPREAD"}, Defines{"SPREAD", "BODIES"}})
            for (const char* file : {"prepare", "relax", "settle"})
                add(file, set, spread);
        for (const Defines& first :
             {Defines{"FIRST"}, Defines{"FIRST", "SPREAD"}, Defines{"FIRST", "SPREAD", "BODIES"}})
            add("relax", set, first);
    }
    for (const Defines& set : combinations({"SELF", "SWEPT", "WALLS", "RELEASE"})) {
        for (const char* file : {"sift", "wake", "weigh", "rest"})
            add(file, set, {"RESTING"});
        add("find", set, {"RESTING", "AMONG_RESTING"});
    }
    for (const Defines& set : combinations({"RESTING", "TRIANGLES", "RIGID", "LIFE"})) {
        for (const char* file : {"spheres", "effective_sum", "spread"})
            add(file, set);
        add("apply", set, {"APPLIES", "MANY"});
    }
    add("apply", {"RESTING"}, {"APPLIES"});
    CHECK(validator.count() > 70);
    validator.check();
}

TEST_CASE("the schools' shaders are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Scene scene;
    Group group;
    group.name = "pairs";
    group.molecule = test::pair(1, 2, 100, 0);
    group.count = 3;
    group.school = School{};
    scene.groups = {group};
    const Plan plan = compile(scene);
    Validator validator;
    validator.generated["generated/body.glsl"] = plan.school.bodies.at(0).text;
    std::vector<glm::vec4> samples;
    validator.generated["generated/colliders.glsl"] = generateColliders(everyCollider(), samples).source;
    const auto addBothForms = [&](const std::string& name, Defines set) {
        set.insert(set.end(), {"BODY_ELEMENTS 4", "STEERING_ELEMENTS 3", "GRIDS 3"});
        Defines compute = set, fragments = set;
        compute.emplace_back("BLOCK 16");
        validator.add("school/" + name + ".comp", compute, gpu::header430());
        fragments.insert(fragments.end(), {"ROW_BITS 4", "LAYERED", "STATE_WIDTH 1024"});
        validator.addBoth("school/" + name + ".frag", fragments);
    };
    addBothForms("keys", {});
    addBothForms("order", {});
    validator.addBoth("school/steered.frag",
                      {"BODY_ELEMENTS 4", "STEERING_ELEMENTS 3", "ROW_BITS 4", "STATE_WIDTH 1024"});
    for (const Defines& set : {Defines{"STATE_ELEMENTS 4"}, Defines{"STATE_ELEMENTS 4", "LIFE"},
                               Defines{"STATE_ELEMENTS 5", "LIFE"}}) {
        Defines sizes = {"POSITION_ELEMENTS 2"};
        sizes.insert(sizes.end(), set.begin(), set.end());
        addBothForms("body", sizes);
    }
    for (const Defines& set : {Defines{"TARGETS 0"}, Defines{"TARGETS 2"}, Defines{"TARGETS 1", "WALLS"}}) {
        Defines all = {"CLOCK_PERIOD float(0.25)", "POSITION_ELEMENTS 2", "STATE_ELEMENTS 4"};
        all.insert(all.end(), set.begin(), set.end());
        addBothForms("steer", all);
    }
    CHECK(validator.count() == 26);
    validator.check();
}

TEST_CASE("a mistake in a shader is found, and located in its own file", "[shaders]") {
    if (!hasValidator()) return;
    const test::Scratch scratch;
    scratch.write("shaders/lib/part.glsl", "\nint half(float x) { return x; }\n");
    const gpu::ShaderSource source =
        gpu::resolveShader(scratch.path("shaders"), "main.frag", {},
                           {{"main.frag", "#include \"lib/part.glsl\"\nvoid main() {}\n"}}, header300es);
    const std::string log = complaint(scratch.write("wrong.frag", source.text), source);
    CHECK_THAT(log, Catch::Contains("part.glsl:2: "));
}

// Mesa 25 makes a comparison of floats of it, for which small integers are denormals, and 0
// (docs/testing.md).
TEST_CASE("no shader masks out a sign bit before it compares with 0", "[shaders]") {
    const std::regex signBit(R"(const uint (\w+) = 0x80000000u)");
    const std::regex compared(R"(&\s*(?:~\s*(\w+)|(0x7fffffffu?))\s*\)\s*[!=]=\s*0)");
    std::set<std::string> signs = {"0x80000000u"};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(SHOAL_SOURCE_DIR "/shaders"))
        if (entry.is_regular_file()) files.push_back(entry.path());
    for (const auto& file : files) {
        const std::string text = readFile(file);
        for (std::sregex_iterator at(text.begin(), text.end(), signBit), end; at != end; ++at)
            signs.insert((*at)[1]);
    }
    CHECK(signs.contains("FRESH"));
    for (const auto& file : files) {
        const std::string text = readFile(file);
        for (std::sregex_iterator at(text.begin(), text.end(), compared), end; at != end; ++at) {
            CAPTURE(file, at->str());
            CHECK(!((*at)[2].matched || signs.contains((*at)[1])));
        }
    }
}
