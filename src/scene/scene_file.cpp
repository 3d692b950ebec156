#include "scene/scene_file.h"

#include "core/file.h"
#include "core/file_format.h"
#include "core/json.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

void readSolver(JsonReader& scene, SolverSettings& solver) {
    auto r = scene.object("solver");
    if (!r) return;
    solver.location = r->here();
    int word = 0;
    r->choose("method", solverWords(), word);
    solver.kind = solverOf(solverWords()[size_t(word)]);
    r->get("substeps", solver.substeps, Range::between(1, maxSubsteps));
    int sampling = static_cast<int>(solver.fieldSampling);
    r->choose("fieldSampling", {"vertexSubstep", "vertexFrame", "moleculeFrame"}, sampling);
    solver.fieldSampling = static_cast<FieldSampling>(sampling);
    r->finish();
}

void readContactSettings(JsonReader& scene, ContactSettings& contact) {
    auto r = scene.object("contact");
    if (!r) return;
    contact.location = r->here();
    int search = static_cast<int>(contact.search), response = static_cast<int>(contact.response);
    r->choose("search", {"exact", "single", "staggered"}, search);
    r->choose("response", {"simultaneous", "nearest"}, response);
    contact.search = static_cast<ContactSearch>(search);
    contact.response = static_cast<ContactResponse>(response);
    if (r->get("neighbors", contact.neighbors, Range::between(1, 64)) &&
        contact.search == ContactSearch::exact)
        throw Error(r->at("neighbors"), "the exact search finds all: \"neighbors\" is of the others");
    r->get("steps", contact.steps, Range::between(1, maxSubsteps));
    r->get("iterations", contact.iterations, Range::between(1, 64));
    getOptional(*r, "cell", contact.cell, aboveZero());
    r->finish();
}

void readCamera(JsonReader& scene, Camera& camera) {
    auto r = scene.object("camera");
    if (!r) return;
    r->get("eye", camera.eye);
    r->get("target", camera.target);
    if (camera.eye == camera.target) throw Error(r->here(), "expected eye and target apart");
    r->get("fieldOfView", camera.fieldOfView, Range::between(0.01, 3.1));
    r->get("exposure", camera.exposure, aboveZero());
    r->finish();
}

void readLight(JsonReader& scene, Light& light) {
    auto r = scene.object("light");
    if (!r) return;
    getDirection(*r, "direction", light.direction);
    getColor(*r, "color", light.color);
    r->get("intensity", light.intensity, Range::atLeast(0));
    r->get("shadows", light.shadows);
    r->finish();
}

void readSky(JsonReader& scene, Sky& sky) {
    auto r = scene.object("sky");
    if (!r) return;
    getColor(*r, "zenith", sky.zenith);
    getColor(*r, "horizon", sky.horizon);
    getColor(*r, "ground", sky.ground);
    r->get("intensity", sky.intensity, Range::atLeast(0));
    r->get("fog", sky.fog, Range::atLeast(0));
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
    r.get("frameRate", scene.frameRate, Range{1, 1e5, false});
    r.get("gravity", scene.gravity);
    readSolver(r, scene.solver);
    readContactSettings(r, scene.contact);
    readCamera(r, scene.camera);
    readLight(r, scene.light);
    readSky(r, scene.sky);
    scene.water = readWater(r);
    scene.fields = readFields(r);
    scene.models = readModels(r);
    scene.colliders = readColliders(r, scene.models, baking, scene.warnings);
    scene.groups = readGroups(r, scene.models, scene.warnings);
    scene.forces = readForces(r, scene.groups);
    scene.surfacePairs = readSurfacePairs(r, scene.colliders, scene.groups);
    r.finish();
    return scene;
}

Scene readScene(const std::string& file, const FieldBaking& baking) {
    return parseScene(readFile(file), file, baking);
}

}  // namespace shoal
