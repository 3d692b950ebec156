// "models": meshes that stand still.
#include <cmath>

#include "scene/load_model.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

// Applies the model's scale, rotation and position, in this order.
void placeMesh(Mesh& mesh, const Model& model) {
    const glm::dmat3 turn = glm::mat3_cast(model.rotation);
    for (auto* points : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& p : *points)
            p = turn * (p * model.scale) + model.position;
    for (auto* normals : {&mesh.normals, &mesh.weldedNormals})
        for (glm::dvec3& n : *normals)
            n = glm::normalize(turn * n);
    mesh.low = mesh.high = mesh.positions.front();
    for (const glm::dvec3& p : mesh.positions) {
        mesh.low = glm::min(mesh.low, p);
        mesh.high = glm::max(mesh.high, p);
    }
}

Model readModel(JsonReader& r) {
    Model model;
    model.file = needFile(r, "file");
    model.name = std::filesystem::path(model.file).stem().string();
    r.get("name", model.name);
    r.get("position", model.position);
    getRotation(r, "rotation", model.rotation);
    r.get("scale", model.scale, aboveZero());
    r.get("draw", model.draw);
    getColor(r, "color", model.color);
    r.get("roughness", model.roughness, Range::between(0, 1));
    r.get("grain", model.grain, Range::between(0, 1));
    r.finish();
    try {
        model.mesh = loadMesh(model.file);
    } catch (const Error& error) {
        throw Error(r.at("file"), error.what());
    }
    placeMesh(model.mesh, model);
    for (const glm::dvec3& corner : {model.mesh.low, model.mesh.high})
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(corner[i]) < largestNumber))
                throw Error(r.here(), concat("the model reaches ", corner[i],
                                             " m after scaling, beyond single precision"));
    return model;
}

}  // namespace

std::vector<Model> readModels(JsonReader& scene) {
    std::vector<Model> models;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("models")) {
        models.push_back(readModel(r));
        refuseRepeated(r, names, models.back().name);
        names.push_back(models.back().name);
    }
    return models;
}

}  // namespace shoal
