// "models" and "colliders": what stands still.
#include <cmath>

#include "scene/height_field.h"
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
    r.finish();
    model.mesh = loadMesh(model.file);
    placeMesh(model.mesh, model);
    for (const glm::dvec3& corner : {model.mesh.low, model.mesh.high})
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(corner[i]) < largestNumber))
                throw Error(r.here(), concat("the model reaches ", corner[i],
                                             " m after scaling, beyond single precision"));
    return model;
}

PlaneCollider readPlane(JsonReader& r) {
    PlaneCollider plane;
    r.get("point", plane.point);
    getDirection(r, "normal", plane.normal);
    return plane;
}

SphereCollider readSphere(JsonReader& r) {
    SphereCollider sphere;
    r.need("center", sphere.center);
    r.need("radius", sphere.radius, aboveZero());
    return sphere;
}

HeightFieldCollider readImageHeights(JsonReader& r) {
    const std::string file = needFile(r, "image");
    glm::dvec2 low(0), high(0), heights(0);
    r.need("low", low);
    r.need("high", high);
    r.need("heights", heights);
    for (int i = 0; i < 2; ++i)
        if (!(low[i] < high[i]))
            throw Error(r.at("high"), concat("expected high above low along ", i == 0 ? "x" : "z", ", found ",
                                             high[i], " against ", low[i]));
    const HeightImage image = readHeightPng(file);
    if (image.width < 2 || image.height < 2)
        throw Error(Location{file, 0, 0, {}}, concat("expected an image of at least 2 by 2 pixels, found ",
                                                     image.width, " by ", image.height));
    return heightFieldFromImage(image, low, high, heights);
}

HeightFieldCollider readModelHeights(JsonReader& r, const std::vector<Model>& models,
                                     std::vector<Warning>& warnings) {
    const Model& model = models[size_t(needModel(r, "model", models))];
    int resolution = 257;
    r.get("resolution", resolution, Range::between(2, 4096));
    const Mesh& mesh = model.mesh;
    if (!(mesh.low.x < mesh.high.x && mesh.low.z < mesh.high.z))
        throw Error(r.at("model"), "expected a model that covers an area in x and z, found one seen edge-on");
    int missed = 0;
    HeightFieldCollider heights = heightFieldFromMesh(mesh, resolution, resolution, &missed);
    if (missed > 0)
        warnings.push_back({r.at("model"), concat(missed, " of ", resolution * resolution,
                                                  " height samples have no surface of model \"", model.name,
                                                  "\" beneath; they take its lowest height")});
    return heights;
}

HeightFieldCollider readHeightField(JsonReader& r, const std::vector<Model>& models,
                                    std::vector<Warning>& warnings) {
    if (r.has("image") == r.has("model"))
        throw Error(r.here(), "expected either \"image\" or \"model\" for a height field");
    HeightFieldCollider heights =
        r.has("image") ? readImageHeights(r) : readModelHeights(r, models, warnings);
    int normals = 0;
    r.choose("normals", {"stored", "sampled"}, normals);
    heights.sampledNormals = normals == 1;
    return heights;
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

std::vector<Collider> readColliders(JsonReader& scene, const std::vector<Model>& models,
                                    std::vector<Warning>& warnings) {
    std::vector<Collider> colliders;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("colliders")) {
        Collider collider;
        r.get("name", collider.name);
        refuseRepeated(r, names, collider.name);
        names.push_back(collider.name);
        int type = 0;
        r.require("type");
        r.choose("type", {"plane", "sphere", "heightField"}, type);
        if (type == 0) collider.shape = readPlane(r);
        if (type == 1) collider.shape = readSphere(r);
        if (type == 2) collider.shape = readHeightField(r, models, warnings);
        r.get("restitution", collider.restitution, Range::between(0, 1));
        r.get("friction", collider.friction, Range::atLeast(0));
        r.get("thickness", collider.thickness, Range::atLeast(0));
        r.get("draw", collider.draw);
        getColor(r, "color", collider.color);
        r.finish();
        colliders.push_back(std::move(collider));
    }
    return colliders;
}

}  // namespace shoal
