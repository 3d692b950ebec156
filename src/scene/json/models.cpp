// "models": meshes that stand still.
#include <cmath>

#include "geometry/load_model.h"
#include "scene/json/reader.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<Model> auto& model) {
    v.number("position", model.position);
    v.rotation("rotation", model.rotation);
    v.number("scale", model.scale, aboveZero());
    v.flag("draw", model.draw);
    v.color("color", model.color);
    v.number("roughness", model.roughness, Range::between(0, 1));
    v.number("grain", model.grain, Range::between(0, 1));
}

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

void checkReach(const Mesh& mesh, const Where& where) {
    for (const glm::dvec3& corner : {mesh.low, mesh.high})
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(corner[i]) < largestNumber))
                throw Error(where.here(), concat("the model reaches ", corner[i],
                                                 " m after scaling, beyond single precision"));
}

Model readModel(JsonReader& r) {
    Model model;
    model.file = needFile(r, "file");
    model.name = std::filesystem::path(model.file).stem().string();
    r.get("name", model.name);
    members(ReadScene(r), model);
    r.finish();
    try {
        model.mesh = loadMesh(model.file);
    } catch (const Error& error) {
        throw Error(r.at("file"), error.what());
    }
    placeMesh(model.mesh, model);
    checkReach(model.mesh, r);
    return model;
}

// What a mesh made in code could get wrong; a reader of models sees to it.
void checkMesh(const Mesh& mesh, const Where& where) {
    const size_t count = mesh.positions.size();
    if (mesh.triangles.empty() || mesh.normals.size() != count || mesh.weld.size() != count)
        throw Error(where.here(), "has no triangles, expected a mesh with at least one");
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            if (t[i] < 0 || size_t(t[i]) >= count)
                throw Error(where.here(),
                            concat("has a triangle with vertex ", t[i], " of a mesh of ", count));
    for (const int welded : mesh.weld)
        if (welded < 0 || size_t(welded) >= mesh.weldedPositions.size())
            throw Error(where.here(),
                        concat("welds to vertex ", welded, " of ", mesh.weldedPositions.size()));
}

}  // namespace

void checkModels(const std::vector<Model>& models) {
    const Where whole;
    std::vector<std::string> names;
    for (size_t i = 0; i < models.size(); ++i) {
        const Where where = whole.in("models", i);
        takeName(where, names, models[i].name);
        members(CheckScene(where), models[i]);
        checkMesh(models[i].mesh, where.in("mesh"));
        checkReach(models[i].mesh, where);
    }
}

std::vector<Model> readModels(JsonReader& scene) {
    std::vector<Model> models;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("models")) {
        models.push_back(readModel(r));
        takeName(r, names, models.back().name);
    }
    return models;
}

}  // namespace shoal
