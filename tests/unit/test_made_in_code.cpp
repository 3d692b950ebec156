// Scenes made in code are held to the rules of the readers: each mistake is made twice, in a file and in
// code, and both must be refused with the same words at the same path.
#include <functional>
#include <limits>

#include "compile/plan.h"
#include "molecule/molecule_file.h"
#include "scene/collider_kinds.h"
#include "scene/field_kinds.h"
#include "scene/force_kinds.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"

using namespace shoal;

namespace {

const std::string folder = SHOAL_SOURCE_DIR "/models/made-in-code/";

// Single quotes are easier to read in C++.
std::string json(std::string text) {
    for (char& c : text)
        if (c == '\'') c = '"';
    return text;
}

const std::string sceneText = json(R"({
  'format': 'shoal-scene-1', 'frameRate': 60, 'gravity': [0, -9.81, 0],
  'solver': {'substeps': 4}, 'contact': {'iterations': 4},
  'camera': {'eye': [0, 2, 8], 'target': [0, 1, 0], 'exposure': 1},
  'light': {'direction': [0, -1, 0], 'intensity': 3}, 'sky': {'fog': 0}, 'water': {'caustics': 0.5},
  'fields': [
    {'type': 'uniform', 'velocity': [1, 0, 0], 'weight': 1},
    {'type': 'gust', 'direction': [1, 0, 0], 'length': 8},
    {'type': 'vortex', 'axis': [0, 1, 0], 'radius': 1, 'box': {'low': [0, 0, 0], 'high': [1, 1, 1]}},
    {'type': 'curlNoise', 'octaves': 2},
    {'type': 'waves', 'trains': [{'direction': [1, 0, 0], 'amplitude': 0.1, 'wavelength': 6}]},
    {'type': 'hurricane', 'shape': 1.5}
  ],
  'forces': [
    {'type': 'attract', 'strength': 1, 'most': 10, 'groups': ['cloth'],
     'path': {'keyframes': [{'time': 0}, {'time': 1}]}},
    {'type': 'vortexLine', 'core': 0.5},
    {'type': 'thrust', 'rate': 1, 'limit': 2}
  ],
  'colliders': [
    {'type': 'plane', 'normal': [0, 1, 0], 'surface': 'wood', 'thickness': 0.002},
    {'type': 'sphere', 'center': [0, 0, 0], 'radius': 1, 'restitution': 0.5},
    {'type': 'box', 'center': [0, 0, 0], 'size': [1, 2, 3]},
    {'type': 'capsule', 'from': [0, 0, 0], 'to': [0, 1, 0], 'radius': 0.25,
     'path': {'keyframes': [{'time': 0}, {'time': 2}]}}
  ],
  'surfacePairs': [{'between': ['wood', 'wood'], 'friction': 0.5}],
  'groups': [
    {'name': 'cloth', 'molecule': '../../molecules/quad.json', 'count': 3,
     'place': {'on': 'volume', 'box': {'low': [0, 0, 0], 'high': [1, 1, 1]}, 'tilt': 0.1, 'scale': [1, 2]},
     'drag': {'normal': 6, 'tangent': 0.6}, 'velocity': [0, 1, 0], 'stiffness': 1, 'friction': 0.5,
     'contact': {'radius': 0.01}, 'colorBy': {'to': 2}, 'school': {'radius': 0.5, 'cruise': 0.4}},
    {'name': 'stand', 'molecule': '../../molecules/quad.json',
     'place': {'on': 'grid', 'cells': [2, 1, 2], 'spacing': [1, 1, 1]}},
    {'name': 'listed', 'molecule': '../../molecules/quad.json',
     'place': {'on': 'list', 'items': [{'scale': 1}]}},
    {'name': 'dust', 'particle': {'mass': 1, 'size': 0.02, 'growth': [1, 0],
                                  'colors': [{'age': 0, 'color': [40, 1, 1]}, {'age': 1, 'opacity': 0.5}]},
     'life': {'span': 2, 'capacity': 100, 'dies': {'outside': {'low': [0, 0, 0], 'high': [1, 1, 1]}}},
     'emitters': [{'from': 'sphere', 'radius': 0.5, 'rate': 10, 'begin': 0, 'until': 5, 'speed': [1, 2],
                   'spread': 0.1, 'bursts': [{'count': 5}]}]},
    {'name': 'splash', 'particle': {}, 'life': {'span': 1, 'capacity': 100},
     'emitters': [{'from': 'death', 'of': 'dust', 'count': 2}]}
  ]
})");

const std::string moleculeText = json(R"({
  'format': 'shoal-molecule-1',
  'vertices': [{'position': [0, 0, 0], 'mass': 1}, {'position': [1, 0, 0], 'mass': 2, 'uv': [0, 1]},
               {'position': [0, 1, 0], 'mass': 1}],
  'springs': [{'a': 0, 'b': 1, 'stiffness': 50, 'damping': 0.1, 'restLength': 0.9},
              {'a': 1, 'b': 2, 'stiffness': 50,
               'actuation': {'amplitude': 0.2, 'frequency': 2, 'phase': 0}}],
  'triangles': [[0, 1, 2]],
  'skin': {'weights': [[0, 1], [1, 1], [2, 0.5, 0, 0.5]], 'triangles': [[0, 1, 2]]},
  'material': {'color': [0.2, 0.5, 0.1], 'roughness': 0.75, 'pointSize': 0.01}
})");

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Mistake {
    const char *text, *wrong;  // in the file
    std::function<void(Scene&)> make;
};
struct MoleculeMistake {
    const char *text, *wrong;
    std::function<void(Molecule&)> make;
};

std::string with(const std::string& whole, const char* text, const char* wrong) {
    const std::string from = json(text);
    const size_t at = whole.find(from);
    INFO(text);
    REQUIRE(at != std::string::npos);
    return std::string(whole).replace(at, from.size(), json(wrong));
}

template <typename Work>
std::optional<Error> errorOf(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return error;
    }
    return {};
}

Scene goodScene() {
    return parseScene(sceneText, folder + "good.scene.json");
}

template <typename F>
F& field(Scene& scene, size_t i) {
    return std::get<F>(*scene.fields[i].shape);
}
template <typename F>
F& force(Scene& scene, size_t i) {
    return std::get<F>(*scene.forces[i].shape);
}
template <typename C>
C& collider(Scene& scene, size_t i) {
    return std::get<C>(*scene.colliders[i].shape);
}

const Mistake mistakes[] = {
    {"'frameRate': 60", "'frameRate': 0", [](Scene& s) { s.frameRate = 0; }},
    {"'gravity': [0, -9.81, 0]", "'gravity': [0, -1e+16, 0]", [](Scene& s) { s.gravity.y = -1e16; }},
    {"'substeps': 4", "'substeps': 0", [](Scene& s) { s.solver.substeps = 0; }},
    {"'iterations': 4", "'iterations': 257", [](Scene& s) { s.contact.iterations = 257; }},
    {"'iterations': 4", "'iterations': 4, 'tolerance': 1e-06", [](Scene& s) { s.contact.tolerance = 1e-6; }},
    {"'eye': [0, 2, 8]", "'eye': [0, 1, 0]", [](Scene& s) { s.camera.eye = s.camera.target; }},
    {"'exposure': 1", "'exposure': 0", [](Scene& s) { s.camera.exposure = 0; }},
    {"'light': {'direction': [0, -1, 0]", "'light': {'direction': [0, 0, 0]",
     [](Scene& s) {
         s.light.direction = {0, 0, 0};
     }},
    {"'intensity': 3", "'intensity': -3", [](Scene& s) { s.light.intensity = -3; }},
    {"'fog': 0", "'fog': -0.5", [](Scene& s) { s.sky.fog = -0.5; }},
    {"'caustics': 0.5", "'caustics': 2", [](Scene& s) { s.water->caustics = 2; }},
    // fields
    {"'velocity': [1, 0, 0]", "'velocity': [1, 1e+20, 0]",
     [](Scene& s) { field<UniformField>(s, 0).velocity.y = 1e20; }},
    {"'direction': [1, 0, 0], 'length'", "'direction': [0, 0, 0], 'length'",
     [](Scene& s) { field<GustField>(s, 1).direction = glm::dvec3(0); }},
    {"'length': 8", "'length': 0", [](Scene& s) { field<GustField>(s, 1).length = 0; }},
    {"'axis': [0, 1, 0], 'radius': 1", "'axis': [0, 1, 0], 'radius': -1",
     [](Scene& s) { field<VortexField>(s, 2).radius = -1; }},
    {"'high': [1, 1, 1]}},\n    {'type': 'curl", "'high': [1, 0, 1]}},\n    {'type': 'curl",
     [](Scene& s) { s.fields[2].box->high.y = 0; }},
    {"'octaves': 2", "'octaves': 5", [](Scene& s) { field<CurlNoiseField>(s, 3).octaves = 5; }},
    {"[{'direction': [1, 0, 0], 'amplitude': 0.1, 'wavelength': 6}]", "[]",
     [](Scene& s) { field<WavesField>(s, 4).trains.clear(); }},
    {"'amplitude': 0.1", "'amplitude': 2", [](Scene& s) { field<WavesField>(s, 4).trains[0].amplitude = 2; }},
    {"'shape': 1.5", "'shape': 4", [](Scene& s) { field<HurricaneField>(s, 5).shape = 4; }},
    // forces
    {"'most': 10", "'most': 0", [](Scene& s) { force<AttractForce>(s, 0).most = 0; }},
    {"'groups': ['cloth']", "'groups': ['clot']", [](Scene& s) { s.forces[0].groups = {"clot"}; }},
    {"{'keyframes': [{'time': 0}, {'time': 1}]}", "{'keyframes': [{'time': 0}, {'time': 0}]}",
     [](Scene& s) { s.forces[0].path->keyframes[1].time = 0; }},
    {"{'keyframes': [{'time': 0}, {'time': 1}]}", "{'keyframes': [{'time': 0}]}",
     [](Scene& s) { s.forces[0].path->keyframes.pop_back(); }},
    {"'core': 0.5", "'core': 0", [](Scene& s) { force<VortexLineForce>(s, 1).core = 0; }},
    {"'limit': 2", "'limit': -2", [](Scene& s) { force<ThrustForce>(s, 2).limit = -2; }},
    {"'limit': 2", "'limit': 2, 'mouse': true", [](Scene& s) { s.forces[2].mouse = true; }},
    // colliders
    {"'normal': [0, 1, 0]", "'normal': [0, 0, 0]",
     [](Scene& s) { collider<PlaneCollider>(s, 0).normal = glm::dvec3(0); }},
    {"'thickness': 0.002", "'thickness': -1", [](Scene& s) { s.colliders[0].thickness = -1; }},
    {"'center': [0, 0, 0], 'radius': 1", "'center': [0, 0, 0], 'radius': 0",
     [](Scene& s) { collider<SphereCollider>(s, 1).radius = 0; }},
    {"'restitution': 0.5", "'restitution': 1.5", [](Scene& s) { s.colliders[1].restitution = 1.5; }},
    {"'size': [1, 2, 3]", "'size': [1, -2, 3]", [](Scene& s) { collider<BoxCollider>(s, 2).size.y = -2; }},
    {"'radius': 0.25", "'radius': 0", [](Scene& s) { collider<CapsuleCollider>(s, 3).radius = 0; }},
    {"{'keyframes': [{'time': 0}, {'time': 2}]}", "{'keyframes': [{'time': 0}, {'time': -2}]}",
     [](Scene& s) { s.colliders[3].path->keyframes[1].time = -2; }},
    {"'between': ['wood', 'wood']", "'between': ['wood', 'iron']",
     [](Scene& s) { s.surfacePairs[0].b = "iron"; }},
    // groups
    {"'count': 3", "'count': 0", [](Scene& s) { s.groups[0].count = 0; }},
    {"'count': 3", "'count': 2000000000", [](Scene& s) { s.groups[0].count = 2000000000; }},
    {"{'on': 'volume', 'box': {'low': [0, 0, 0]", "{'on': 'volume', 'box': {'low': [0, 2, 0]",
     [](Scene& s) { s.groups[0].place.box.low.y = 2; }},
    {"'tilt': 0.1", "'tilt': 4", [](Scene& s) { s.groups[0].place.tilt = 4; }},
    {"'scale': [1, 2]", "'scale': [2, 1]",
     [](Scene& s) {
         s.groups[0].place.scale = {2, 1};
     }},
    {"'normal': 6", "'normal': -6", [](Scene& s) { s.groups[0].drag.normal = -6; }},
    {"'velocity': [0, 1, 0]", "'velocity': [0, 1e+17, 0]", [](Scene& s) { s.groups[0].velocity.y = 1e17; }},
    {"'stiffness': 1", "'stiffness': -1", [](Scene& s) { s.groups[0].stiffness = -1; }},
    {"'friction': 0.5,\n", "'friction': -0.5,\n", [](Scene& s) { s.groups[0].friction = -0.5; }},
    {"'contact': {'radius': 0.01}", "'contact': {'radius': -1}",
     [](Scene& s) { s.groups[0].contact->radius = -1; }},
    {"'colorBy': {'to': 2}", "'colorBy': {'to': -2}", [](Scene& s) { s.groups[0].colorBy->to = -2; }},
    {"'cruise': 0.4", "'cruise': 0", [](Scene& s) { s.groups[0].school->cruise = 0; }},
    {"'cells': [2, 1, 2]", "'cells': [2, 0, 2]", [](Scene& s) { s.groups[1].place.cells.y = 0; }},
    {"'name': 'stand'", "'name': 'stand', 'count': 5", [](Scene& s) { s.groups[1].count = 5; }},
    {"'items': [{'scale': 1}]", "'items': [{'scale': 0}]",
     [](Scene& s) { s.groups[2].place.items[0].scale = 0; }},
    {"'items': [{'scale': 1}]", "'items': []", [](Scene& s) { s.groups[2].place.items.clear(); }},
    // birth and death
    {"'particle': {'mass': 1", "'particle': {'mass': -1", [](Scene& s) { s.groups[3].particle->mass = -1; }},
    {"'growth': [1, 0]", "'growth': [0, 0]",
     [](Scene& s) {
         s.groups[3].particle->growth = {0, 0};
     }},
    {"{'age': 1, 'opacity': 0.5}", "{'age': 0, 'opacity': 0.5}",
     [](Scene& s) { s.groups[3].particle->colors[1].age = 0; }},
    {"'span': 2", "'span': 0",
     [](Scene& s) {
         s.groups[3].life->life = {0, 0};
     }},
    {"'span': 2, 'capacity': 100", "'span': 2, 'capacity': 1073741825",
     [](Scene& s) { s.groups[3].life->capacity = 1073741825; }},
    {"'outside': {'low': [0, 0, 0]", "'outside': {'low': [2, 0, 0]",
     [](Scene& s) { s.groups[3].life->within->low.x = 2; }},
    {"'from': 'sphere', 'radius': 0.5", "'from': 'sphere', 'radius': 0",
     [](Scene& s) { s.groups[3].life->emitters[0].radius = 0; }},
    {"'rate': 10", "'rate': -10", [](Scene& s) { s.groups[3].life->emitters[0].rate = -10; }},
    {"'until': 5", "'until': 0", [](Scene& s) { s.groups[3].life->emitters[0].end = 0; }},
    {"'speed': [1, 2]", "'speed': [2, 1]",
     [](Scene& s) {
         s.groups[3].life->emitters[0].speed = {2, 1};
     }},
    {"'bursts': [{'count': 5}]", "'bursts': [{'count': 0}]",
     [](Scene& s) { s.groups[3].life->emitters[0].bursts[0].count = 0; }},
    {"'count': 2}", "'count': 2000}", [](Scene& s) { s.groups[4].life->emitters[0].perDeath = 2000; }},
    {"'of': 'dust'", "'of': 'rust'", [](Scene& s) { s.groups[4].life->emitters[0].group = "rust"; }},
};

const MoleculeMistake moleculeMistakes[] = {
    {"'position': [1, 0, 0]", "'position': [1, 2e+06, 0]",
     [](Molecule& m) { m.vertices[1].position.y = 2e6; }},
    {"'mass': 2", "'mass': -2", [](Molecule& m) { m.vertices[1].mass = -2; }},
    {"'mass': 2", "'mass': 1e+13", [](Molecule& m) { m.vertices[1].mass = 1e13; }},
    {"'uv': [0, 1]", "'uv': [0, 1e+07]", [](Molecule& m) { m.vertices[1].uv.y = 1e7; }},
    {"'b': 2, 'stiffness': 50", "'b': 3, 'stiffness': 50", [](Molecule& m) { m.springs[1].b = 3; }},
    {"'a': 0, 'b': 1", "'a': -1, 'b': 1", [](Molecule& m) { m.springs[0].a = -1; }},
    {"'a': 0, 'b': 1", "'a': 1, 'b': 1", [](Molecule& m) { m.springs[0].a = 1; }},
    {"'a': 1, 'b': 2", "'a': 1, 'b': 0", [](Molecule& m) { m.springs[1].b = 0; }},
    {"'stiffness': 50, 'damping'", "'stiffness': -50, 'damping'",
     [](Molecule& m) { m.springs[0].stiffness = -50; }},
    {"'damping': 0.1", "'damping': 1e+16", [](Molecule& m) { m.springs[0].damping = 1e16; }},
    {"'restLength': 0.9", "'restLength': 1e-12", [](Molecule& m) { m.springs[0].restLength = 1e-12; }},
    {"{'position': [0, 1, 0]", "{'position': [1, 0, 0]",
     [](Molecule& m) {
         m.vertices[2].position = {1, 0, 0};
     }},
    {"'amplitude': 0.2", "'amplitude': 1", [](Molecule& m) { m.springs[1].actuation->amplitude = 1; }},
    {"'triangles': [[0, 1, 2]],", "'triangles': [[0, 1, 1]],", [](Molecule& m) { m.triangles[0].c = 1; }},
    {"[2, 0.5, 0, 0.5]", "[2, 0.5, 0, 0.75]",
     [](Molecule& m) { m.skin.vertices[2].weights[1].weight = 0.75; }},
    {"'roughness': 0.75", "'roughness': -1", [](Molecule& m) { m.material.roughness = -1; }},
    {"'pointSize': 0.01", "'pointSize': 0", [](Molecule& m) { m.material.pointSize = 0; }},
};

bool endsWith(const std::string& text, const std::string& end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

TEST_CASE("A scene made in code is refused with the words that its file would be refused with", "[made]") {
    REQUIRE_FALSE(errorOf([] { compile(goodScene()); }));
    for (const Mistake& mistake : mistakes) {
        INFO(mistake.text << " -> " << mistake.wrong);
        const std::string text = with(sceneText, mistake.text, mistake.wrong);
        const std::optional<Error> inFile = errorOf([&] { parseScene(text, folder + "wrong.scene.json"); });
        Scene scene = goodScene();
        mistake.make(scene);
        const std::optional<Error> inCode = errorOf([&] { compile(scene); });
        REQUIRE(inFile);
        REQUIRE(inCode);
        CHECK(inCode->message() == inFile->message());
    }
}

TEST_CASE("A molecule made in code is refused with the words of its reader, at its path", "[made]") {
    const Molecule good = parseMolecule(moleculeText, "good.json");
    for (const MoleculeMistake& mistake : moleculeMistakes) {
        INFO(mistake.text << " -> " << mistake.wrong);
        const std::string text = with(moleculeText, mistake.text, mistake.wrong);
        const std::optional<Error> inFile = errorOf([&] { parseMolecule(text, "wrong.json"); });
        Scene scene = goodScene();
        scene.groups[0].molecule = good;
        mistake.make(scene.groups[0].molecule);
        const std::optional<Error> inCode = errorOf([&] { compile(scene); });
        REQUIRE(inFile);
        REQUIRE(inCode);
        CHECK(inCode->message() == inFile->message());
        CHECK(inCode->location().file.empty());
        const std::string path = inFile->location().path;
        INFO(inCode->location().path << " and " << path);
        CHECK(inCode->location().path.rfind("$.groups[0].molecule", 0) == 0);
        CHECK(endsWith(inCode->location().path, path.substr(1)));
    }
}

TEST_CASE("What only code can get wrong is refused with its path", "[made]") {
    const auto refused = [](const char* words, const char* path, const std::function<void(Scene&)>& make) {
        Scene scene = goodScene();
        make(scene);
        const std::optional<Error> error = errorOf([&] { compile(scene); });
        INFO(path);
        REQUIRE(error);
        CHECK_THAT(error->message(), Catch::Contains(words));
        CHECK(error->location().path == path);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refused("found nan", "$.groups[0].molecule.vertices[0].mass",
            [&](Scene& s) { s.groups[0].molecule.vertices[0].mass = nan; });
    refused("found inf", "$.gravity[1]", [](Scene& s) { s.gravity.y = infinite; });
    refused("found nan", "$.groups[0].place.box.low[2]",
            [&](Scene& s) { s.groups[0].place.box.low.z = nan; });
    refused("at least one vertex", "$.groups[0].molecule.vertices",
            [](Scene& s) { s.groups[0].molecule = Molecule(); });
    refused("out of range", "$.groups[0].molecule.triangles[0]",
            [](Scene& s) { s.groups[0].molecule.triangles[0].a = 70000; });
    refused("at least one group", "$.groups", [](Scene& s) { s.groups.clear(); });
    refused("has no models", "$.groups[0].place.model",
            [](Scene& s) { s.groups[0].place.kind = Placement::Kind::surface; });
    refused("from 0 to 2", "$.groups[0].place.turn",
            [](Scene& s) { s.groups[0].place.turn = Placement::Turn(7); });
    refused("heights", "$.colliders[0].heights", [](Scene& s) {
        HeightFieldCollider heights;
        heights.columns = heights.rows = 3;
        heights.high = {1, 1};
        heights.heights.resize(8);
        s.colliders[0].shape = heights;
    });
    refused("values", "$.fields[0].values", [](Scene& s) {
        GridField grid;
        grid.resolution = {2, 2, 2};
        grid.high = {1, 1, 1};
        s.fields[0].shape = grid;
    });
}
