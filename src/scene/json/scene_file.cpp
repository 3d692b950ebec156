#include "scene/json/scene_file.h"

#include "core/file.h"
#include "core/file_format.h"
#include "core/json.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

template <typename V>
void members(V&& v, Either<SolverSettings> auto& solver) {
    v.number("substeps", solver.substeps, Range::between(1, maxSubsteps));
    v.word("fieldSampling", solver.fieldSampling, {"vertexSubstep", "vertexFrame", "moleculeFrame"});
}

template <typename V>
void members(V&& v, Either<ContactSettings> auto& contact) {
    v.word("search", contact.search, {"exact", "single", "staggered"});
    v.word("response", contact.response, {"simultaneous", "nearest"});
    v.number("neighbors", contact.neighbors, Range::between(1, 64));
    v.unlessZero("steps", contact.steps, Range::between(1, maxSubsteps));
    v.number("iterations", contact.iterations, Range::between(1, 64));
    v.number("cell", contact.cell, aboveZero());
}

template <typename V>
void members(V&& v, Either<Camera> auto& camera) {
    v.number("eye", camera.eye);
    v.number("target", camera.target);
    v.number("fieldOfView", camera.fieldOfView, Range::between(0.01, 3.1));
    v.number("exposure", camera.exposure, aboveZero());
}

template <typename V>
void members(V&& v, Either<Light> auto& light) {
    v.direction("direction", light.direction);
    v.color("color", light.color);
    v.number("intensity", light.intensity, Range::atLeast(0));
    v.flag("shadows", light.shadows);
}

template <typename V>
void members(V&& v, Either<Sky> auto& sky) {
    v.color("zenith", sky.zenith);
    v.color("horizon", sky.horizon);
    v.color("ground", sky.ground);
    v.number("intensity", sky.intensity, Range::atLeast(0));
    v.number("fog", sky.fog, Range::atLeast(0));
}

// What a scene says of itself.
template <typename V>
void members(V&& v, Either<Scene> auto& scene) {
    v.number("frameRate", scene.frameRate, Range{1, 1e5, false});
    v.number("gravity", scene.gravity);
}

void checkCamera(const Camera& camera, const Where& where) {
    if (camera.eye == camera.target) throw Error(where.here(), "expected eye and target apart");
}

void readSolver(JsonReader& scene, SolverSettings& solver) {
    auto r = scene.object("solver");
    if (!r) return;
    solver.location = r->here();
    int word = 0;
    r->choose("method", solverWords(), word);
    solver.kind = solverOf(solverWords()[size_t(word)]);
    members(ReadScene(*r), solver);
    r->finish();
}

void readContactSettings(JsonReader& scene, ContactSettings& contact) {
    auto r = scene.object("contact");
    if (!r) return;
    contact.location = r->here();
    members(ReadScene(*r), contact);
    if (r->has("neighbors") && contact.search == ContactSearch::exact)
        throw Error(r->at("neighbors"), "the exact search finds all: \"neighbors\" is of the others");
    r->finish();
}

void readCamera(JsonReader& scene, Camera& camera) {
    auto r = scene.object("camera");
    if (!r) return;
    members(ReadScene(*r), camera);
    checkCamera(camera, *r);
    r->finish();
}

void readLight(JsonReader& scene, Light& light) {
    auto r = scene.object("light");
    if (!r) return;
    members(ReadScene(*r), light);
    r->finish();
}

void readSky(JsonReader& scene, Sky& sky) {
    auto r = scene.object("sky");
    if (!r) return;
    members(ReadScene(*r), sky);
    r->finish();
}

}  // namespace

Scene parseScene(const std::string& text, const std::string& file, const FieldBaking& baking) {
    const JsonValue root = parseJson(text, file);
    JsonReader r(root, file);
    needFormat(r, "shoal-scene-1");
    refuseHugeNumbers(root, file);

    Scene scene;
    scene.file = file;
    r.get("name", scene.name);
    r.get("comment", scene.comment);
    r.get("seed", scene.seed);
    members(ReadScene(r), scene);
    readSolver(r, scene.solver);
    readContactSettings(r, scene.contact);
    readCamera(r, scene.camera);
    readLight(r, scene.light);
    readSky(r, scene.sky);
    scene.water = readDescribed<Water>(r, "water");
    scene.fields = readFields(r);
    scene.models = readModels(r);
    scene.colliders = readColliders(r, scene.models, baking, scene.warnings);
    scene.groups = readGroups(r, scene.models, scene.warnings);
    scene.forces = readForces(r, scene.groups);
    scene.surfacePairs = readSurfacePairs(r, scene.colliders, scene.groups);
    r.finish();
    return scene;
}

void checkScene(const Scene& scene) {
    const Where whole;
    const auto check = [&whole](const char* key, const auto& part) {
        const Where where = whole.in(key);
        members(CheckScene(where), part);
    };
    members(CheckScene(whole), scene);
    check("solver", scene.solver);
    check("contact", scene.contact);
    check("camera", scene.camera);
    checkCamera(scene.camera, whole.in("camera"));
    check("light", scene.light);
    check("sky", scene.sky);
    if (scene.water) describe(&*scene.water).check(*scene.water, whole.in("water"), largestNumber);
    checkFields(scene.fields);
    checkModels(scene.models);
    checkGroups(scene.groups, scene.models);
    checkForces(scene.forces, scene.groups);
    checkColliders(scene);
}

Scene readScene(const std::string& file, const FieldBaking& baking) {
    return parseScene(readFile(file), file, baking);
}

}  // namespace shoal
