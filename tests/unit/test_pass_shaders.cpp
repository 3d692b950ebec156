// The shaders of drawing, sorts, births, contact and schools through the reference compiler, with each set of
// defines that a plan can ask for.
#include <algorithm>

#include "compile/contact_plan.h"
#include "support/catch.h"
#include "support/shapes.h"
#include "unit/shader_validator.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("the renderer's shaders are sound GLSL, of WebGL 2 as well", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const char* file : {"render/screen.vert", "render/sky.frag", "render/picture.frag"})
        validator.addPicture(file, {});
    const std::vector<const char*> ofMolecules = {"render/molecule.vert",        "render/molecule.frag",
                                                  "render/molecule_shadow.frag", "render/points.vert",
                                                  "render/points.frag",          "render/points_shadow.frag"};
    for (const Defines& lit : combinations({"SHADOWS"})) {
        for (const char* file : ofMolecules) {
            for (Defines set : combinations({"TEXTURED"})) {
                set.insert(set.end(), lit.begin(), lit.end());
                set.insert(set.end(), {"TEXTURES", "STATE_WIDTH 1024", "BLEND noneBlend", "SKIN_WEIGHTS 0"});
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
        }
        for (const Defines& look : {Defines{},
                                    {"PLANE", "GRID", "GRAINY"},
                                    {"COLOR_IMAGE", "CUT", "GRAINY", "STONY"},
                                    {"NORMAL_IMAGE", "ROUGHNESS_IMAGE", "EMISSIVE_IMAGE"}}) {
            Defines set = lit;
            set.insert(set.end(), look.begin(), look.end());
            validator.addPicture("render/surface.vert", set);
            validator.addPicture("render/surface.frag", set);
        }
    }
    for (const char* blend : {"BLEND additiveBlend", "BLEND multiplicativeBlend"})
        validator.addPicture("render/molecule.frag", {blend, "SKIN_WEIGHTS 0"});
    for (const char* file : {"render/molecule.vert", "render/points.vert"})
        validator.addPicture(file, {"TEXTURES", "STATE_WIDTH 1024", "COLOR_BY"});
    for (const char* file : {"render/molecule.frag", "render/points.frag", "render/surface.frag"})
        validator.addPicture(file, {"SHADOWS", "WATER", "METALLIC", "BLEND noneBlend", "SKIN_WEIGHTS 0"});
    for (const Defines& scaled : combinations({"SCALED"})) {
        Defines set = scaled;
        set.insert(set.end(), {"TEXTURES", "STATE_WIDTH 1024"});
        validator.addPicture("render/spring_lines.vert", set);
    }
    validator.addPicture("render/sky.frag", {"WATER"});
    validator.addPicture("render/picture.frag", {"BEAMS", "OCCLUSION"});
    for (const char* file : {"render/occlusion.frag", "render/occlusion_smooth.frag"})
        validator.addPicture(file, {});
    for (const char* blend : {"BLEND additiveBlend", "BLEND multiplicativeBlend", "BLEND alphaBlend"})
        validator.addPicture("particles/particle.frag",
                             {"WATER", "LIT", "SHAPE quadsShape", "FACING cameraFacing", blend});
    validator.addPicture("render/beams.frag", {});
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
    for (const Defines& set : combinations({"BLENDED", "HOLES"}))
        validator.addPicture("render/surface_shadow.frag", set);
    validator.check();
}

TEST_CASE("the shaders that draw in order are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    const std::vector<Defines> orders = {{"ORDER_BUFFER"}, {"ORDER_PAIRED"}, {}};
    for (const Defines& order : orders) {
        for (const char* turns : {"", "SLABS", "SLAB_DRAWS"}) {
            Defines set = order;
            set.insert(set.end(), {"TEXTURES", "STATE_WIDTH 1024", "ORDERED", "BLEND alphaBlend",
                                   "LINEAR_LIGHT", "SKIN_WEIGHTS 0"});
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
    validator.check();
}

TEST_CASE("the shaders of drawn particles are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    const std::vector<Defines> shapes = {
        {"SHAPE pointsShape", "FACING cameraFacing", "TILES oneTile"},
        {"SHAPE spritesShape", "FACING cameraFacing", "SIZES", "TURNS", "IMAGE", "TILES tileOfSeed"},
        {"SHAPE quadsShape", "FACING cameraFacing", "SIZES", "GROWS", "TURNS", "IMAGE", "TILES tilesAgain",
         "FADES", "AGES", "LIFE"},
        {"SHAPE quadsShape", "FACING velocityFacing", "TILES oneTile", "AGES", "LIFE"},
        {"SHAPE quadsShape", "FACING freeFacing", "TURNS", "IMAGE", "TILES tilesOnce", "AGES", "LIFE"}};
    const std::vector<Defines> looks = {{"BLEND noneBlend"},
                                        {"BLEND noneBlend", "LIT"},
                                        {"BLEND alphaBlend", "LIT", "SHADOWS", "SOFT", "ORDERED", "SLABS"},
                                        {"BLEND additiveBlend", "SOFT", "ORDERED", "SLAB_DRAWS"},
                                        {"BLEND multiplicativeBlend", "LINEAR_LIGHT"}};
    for (const Defines& shape : shapes) {
        for (Defines set : looks) {
            const bool quads = shape[0] == "SHAPE quadsShape";
            set.insert(set.end(), shape.begin(), shape.end());
            set.insert(set.end(),
                       {"TEXTURES", "STATE_WIDTH 1024", "BATCH 64", quads ? "CORNERS 4" : "CORNERS 1"});
            validator.addPicture("particles/particle.vert", set);
            validator.addPicture("particles/particle.frag", set);
            validator.addPicture("particles/particle_shadow.frag", set);
        }
    }
    CHECK(validator.count() == 189);
    validator.check();
}

TEST_CASE("the sorts' shaders are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    for (const char* file : {"sort/odd_even_merge.frag", "sort/bitonic.frag"})
        validator.addBoth(file, {});
    validator.addBoth("sort/bitonic.frag", {"TIES_BY_INDEX"});
    validator.arrays = "contact";
    validator.addBoth("sort/starts.pass.glsl", {"ROW_BITS 4"});
    validator.arrays.clear();
    const Defines sizes = {"LANES 256", "MOST_DIGITS 2048", "TILE_PAIRS 2048"};
    for (const char* file : {"sort/pieces_count.comp", "sort/pieces_scan.comp", "sort/pieces_scatter.comp",
                             "sort/tiles_count.comp", "sort/tiles_scan.comp", "sort/tiles_scatter.comp"})
        validator.add(file, sizes, gpu::header430());
    validator.check();
}

TEST_CASE("the shaders of births are sound GLSL, of WebGL 2 as well", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    validator.arrays = "births";
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
    const auto addPass = [&validator](const std::string& file, Defines defines) {
        validator.add(concat("births/", file, ".pass.glsl"), defines, gpu::header430());
        defines.insert(defines.end(), {"LAYERED", "STATE_WIDTH 1024", "ROW_BITS 10", "POSITION_ELEMENTS 1",
                                       "STATE_ELEMENTS 2"});
        validator.addBoth(concat("births/", file, ".pass.glsl"), defines);
    };
    for (const char* file : {"sums", "control", "list"})
        addPass(file, {"MOST_DEATH_RUNS 4", "BIRTH_LANES 64", "MOST_GROUPS 65535"});
    addPass("sums", {"BITS"});
    CHECK(validator.count() == 34);
    validator.check();
}

TEST_CASE("the compute shaders of contact are sound GLSL", "[shaders]") {
    if (!hasValidator()) return;
    Validator validator;
    validator.generated = generate({}, collidersToValidate());
    using Facts = ContactFacts;
    using GroupFacts = ContactGroupFacts;
    const auto add = [&](const std::string& pass, const Facts& facts, const GroupFacts& group = {},
                         Defines more = {}) {
        more.insert(more.end(), {"BLOCK 16", "POSITION_ELEMENTS 3", "STATE_ELEMENTS 12", "VERTICES 4",
                                 "SPHERES 6", "HISTORY", "NO_HISTORY 1e30", "LANES 256", "LINE_WORDS 32",
                                 "CONTACT_RADIUS 0.1", "CONTACT_GROWTH vec2(1.0, 2.0)"});
        if (facts.counted) more.emplace_back("CELL_TILE 1024");
        validator.addContact(pass, facts, group, more);
    };
    const Facts remembers = {.remembers = true};
    forFacts(remembers, {&Facts::counted, &Facts::rests, &Facts::staggers}, [&](const Facts& facts) {
        add("grid/order", facts);
        add("grid/spheres", facts);
    });
    for (const Defines& more : combinations({"MEMBERS"}))
        add("grid/starts", {.counted = true}, {}, more);
    forFacts(Facts(), {&Facts::staggers, &Facts::sweeps}, [&](const Facts& facts) {
        add("search/neighbors", facts);
        if (facts.staggers) add("search/neighbors", facts, {}, {"SECOND_GRID"});
    });
    forFacts(remembers, {&Facts::self, &Facts::sweeps, &Facts::colliders}, [&](Facts facts) {
        add("search/find", facts);
        facts.rests = true;
        for (const char* pass : {"search/find", "rest/awake", "rest/wake", "rest/load_change"})
            add(pass, facts);
        add("search/find", facts, {}, {"MARKED"});
        for (const bool release : {false, true})
            add("rest/rest", facts, {.release = release});
    });
    forFacts(remembers, {&Facts::rests, &Facts::colliders, &Facts::spreads, &Facts::rigid},
             [&](const Facts& facts) {
                 for (const char* pass : {"choose", "strike", "prepare", "solve", "store"})
                     add(concat("response/", pass), facts);
                 for (const char* pass : {"choose", "solve"})
                     add(concat("response/", pass), facts, {}, {"FIRST"});
             });
    const Facts spreads = {.remembers = true, .spreads = true, .colliders = true, .rigid = true};
    forFacts(GroupFacts(), {&GroupFacts::triangles, &GroupFacts::rigid}, [&](GroupFacts group) {
        for (const char* pass : {"spread", "apply"})
            add(concat("response/", pass), spreads, group);
        add("response/spread", spreads, group, {"VELOCITIES"});
        for (const Defines& life : {Defines{}, Defines{"LIFE"}})
            add("grid/spheres", spreads, group, life);
        group.collides = group.severalColliders = true;
        add("grid/spheres", spreads, group);
    });
    for (const bool rests : {false, true})
        add("response/apply", {.remembers = true, .rests = rests});
    add("response/apply", Facts());
    CHECK(validator.count() > 80);
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
    validator.arrays = "school";
    validator.generated["generated/body.glsl"] = plan.school.bodies.at(0).text;
    std::vector<glm::vec4> samples;
    validator.generated["generated/colliders.glsl"] =
        generateColliders(collidersToValidate(), samples).source;
    const auto addBothForms = [&](const std::string& name, Defines set) {
        set.insert(set.end(), {"BODY_ELEMENTS 4", "STEERING_ELEMENTS 3", "GRIDS 3"});
        Defines compute = set, fragments = set;
        compute.emplace_back("BLOCK 16");
        validator.add("school/" + name + ".pass.glsl", compute, gpu::header430());
        fragments.insert(fragments.end(), {"ROW_BITS 4", "LAYERED", "STATE_WIDTH 1024"});
        validator.addBoth("school/" + name + ".pass.glsl", fragments);
    };
    addBothForms("keys", {});
    addBothForms("order", {});
    validator.addBoth("school/steer.pass.glsl", {"MOLECULES", "BODY_ELEMENTS 4", "STEERING_ELEMENTS 3",
                                                 "ROW_BITS 4", "STATE_WIDTH 1024"});
    for (const Defines& set : {Defines{"STATE_ELEMENTS 4"}, Defines{"STATE_ELEMENTS 4", "LIFE"},
                               Defines{"STATE_ELEMENTS 5", "LIFE"}}) {
        Defines sizes = {"POSITION_ELEMENTS 2"};
        sizes.insert(sizes.end(), set.begin(), set.end());
        addBothForms("bodies", sizes);
    }
    for (const Defines& set : {Defines{"TARGETS 0"}, Defines{"TARGETS 2"}, Defines{"TARGETS 1", "WALLS"}}) {
        Defines all = {"CLOCK_PERIOD float(0.25)", "POSITION_ELEMENTS 2", "STATE_ELEMENTS 4"};
        all.insert(all.end(), set.begin(), set.end());
        addBothForms("steer", all);
    }
    CHECK(validator.count() == 26);
    validator.check();
}
