// Every shader through the reference compiler: the passes as desktop 3.3 and as WebGL 2's language, with each
// set of defines that a plan can ask for; the fused path's kernels as 4.3. A driver that is generous hides
// mistakes.
#include <algorithm>
#include <filesystem>
#include <regex>

#include "compile/contact_plan.h"
#include "core/file.h"
#include "scene/field_kinds.h"
#include "simulate/watchdog.h"
#include "support/catch.h"
#include "unit/shader_validator.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// A pass that is told which of its constants hold: those that `set` names.
void addPass(Validator& validator, const std::string& file, Defines set) {
    for (const char* name : {"PINS", "RELEASE", "ANCHORS_MOVE"}) {
        const bool holds = std::erase(set, name) > 0;
        set.push_back(gpu::constant(name, holds));
    }
    validator.addBoth(concat("passes/", file), set);
}

}  // namespace

TEST_CASE("the passes are sound in desktop and in embedded GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    validator.generated = generate(fieldsToValidate(), collidersToValidate());
    addPass(validator, "fullscreen.vert", {});
    for (const Defines& set :
         combinations({"LEAPFROG", "SPRINGS", "FIELDS", "DIRECTIONAL_DRAG", "ANCHORS_MOVE"}))
        addPass(validator, "advect.frag", set);
    for (const Defines& set : combinations({"LEAPFROG", "FIELDS", "FORCES"})) {
        addPass(validator, "advect.frag", set);
        addPass(validator, "stage.frag", set);
    }
    for (const Defines& set : combinations({"VERLET", "PINS"})) {
        addPass(validator, "thrust.frag", set);
        Defines forced = set;
        forced.emplace_back("FORCES");
        addPass(validator, "collide.frag", set);
        addPass(validator, "collide.frag", forced);
    }
    for (const Defines& pins : {Defines{}, Defines{"PINS"}, Defines{"PINS", "RELEASE"}}) {
        addPass(validator, "collide.frag", pins);
        for (const Defines& set :
             std::vector<Defines>{{"ACCELERATION"}, {"LEAPFROG", "ACCELERATION"}, {"STAGES 4"}}) {
            Defines sprung = pins;
            sprung.insert(sprung.end(), set.begin(), set.end());
            sprung.emplace_back("SPRINGS");
            addPass(validator, "collide.frag", sprung);
        }
        for (Defines set : combinations({"LEAPFROG", "ACCELERATION", "MUSCLES 2"})) {
            set.insert(set.end(), pins.begin(), pins.end());
            set.emplace_back("SPRINGS");
            addPass(validator, "restore.frag", set);
            addPass(validator, "records.frag", set);
            set.emplace_back("SPRING_DAMPING");
            addPass(validator, "restore.frag", set);
            addPass(validator, "records.frag", set);
        }
    }
    for (const Defines& set : combinations({"LEAPFROG", "DIRECTIONAL_DRAG", "SPRINGS"}))
        addPass(validator, "normals.frag", set);
    addPass(validator, "watch.frag", {fastestDefine()});
    CHECK(validator.count() > 20);
    validator.check();
}

TEST_CASE("the passes of contact in fragments are sound in desktop and in embedded GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    validator.generated = generate({}, collidersToValidate());
    addPass(validator, "touched.frag", {"ROW_BITS 6", "PINS"});
    addPass(validator, "touched.frag", {"ROW_BITS 6", "PINS", "RELEASE"});
    using Facts = ContactFacts;
    using GroupFacts = ContactGroupFacts;
    const auto add = [&](const std::string& pass, Facts facts, const GroupFacts& group = {},
                         const Defines& more = {}) {
        facts.textures = true;
        validator.addContact(pass, facts, group, more);
    };
    for (const char* pass :
         {"grid/keys", "grid/order", "search/find", "search/neighbors", "response/nearest"})
        add(pass, Facts());
    add("grid/keys", Facts(), {}, {"SLOTS"});
    for (const bool release : {false, true})
        add("grid/spheres", Facts(), {.pins = release, .release = release, .vertexTextures = true},
            {"SPHERES 4"});
    const Facts remembers = {.remembers = true};
    forFacts(remembers, {&Facts::self, &Facts::sweeps, &Facts::colliders}, [&](Facts facts) {
        for (const char* pass : {"search/find", "search/neighbors"})
            add(pass, facts);
        facts.staggers = true;
        add("search/neighbors", facts, {}, {"SECOND_GRID"});
    });
    forFacts(remembers, {&Facts::colliders, &Facts::spreads, &Facts::rigid}, [&](const Facts& facts) {
        for (const char* pass : {"choose", "strike", "prepare", "solve", "store"})
            add(concat("response/", pass), facts);
        for (const char* pass : {"prepare", "solve"})
            add(concat("response/", pass), facts, {}, {"ENTRIES"});
        for (const char* pass : {"choose", "solve"})
            add(concat("response/", pass), facts, {}, {"FIRST"});
    });
    const Defines sizes = {
        "LAYERED",    "STATE_WIDTH 1024", "POSITION_ELEMENTS 3", "STATE_ELEMENTS 6",
        "VERTICES 4", "SPHERES 6",        "CONTACT_RADIUS 0.1",  "CONTACT_GROWTH vec2(1.0, 2.0)"};
    const Facts spreads = {.remembers = true, .spreads = true, .colliders = true, .rigid = true};
    for (Defines set : combinations({"CONSTANTS", "LIFE"})) {
        set.insert(set.end(), sizes.begin(), sizes.end());
        forFacts(GroupFacts{.severalColliders = true}, {&GroupFacts::triangles, &GroupFacts::rigid},
                 [&](const GroupFacts& group) {
                     for (const char* pass : {"response/spread", "response/gains", "grid/spheres"})
                         add(pass, spreads, group, set);
                     const auto addWith = [&](const std::string& pass, const char* define) {
                         Defines more = set;
                         more.emplace_back(define);
                         add(pass, spreads, group, more);
                     };
                     addWith("response/spread", "VELOCITIES");
                     addWith("grid/spheres", "COLLIDES");
                 });
    }
    CHECK(validator.count() > 90);
    validator.check();
}

TEST_CASE("each field and each collider is sound GLSL by itself", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const Field& one : fieldsToValidate()) {
        validator.generated = generate({one}, collidersToValidate());
        addPass(validator, "advect.frag", {"LEAPFROG", "SPRINGS", "FIELDS"});
    }
    for (const Collider& one : collidersToValidate()) {
        validator.generated = generate(fieldsToValidate(), {one});
        addPass(validator, "collide.frag", {});
    }
    validator.check();
}

TEST_CASE("the kernels in fragments are sound GLSL, of WebGL 2 as well", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const Solver& solver : solvers()) {
        if (solver.spread) continue;
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
    addPass(validator, "advect.frag", {"FIELDS"});
    addPass(validator, "collide.frag", {});
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
                if (lanes == Lanes::molecule ? !solver.spread : solver.spread || !solver.implicit)
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
    CHECK(signs.contains("FLAG"));
    for (const auto& file : files) {
        const std::string text = readFile(file);
        for (std::sregex_iterator at(text.begin(), text.end(), compared), end; at != end; ++at) {
            CAPTURE(file, at->str());
            CHECK(!((*at)[2].matched || signs.contains((*at)[1])));
        }
    }
}
