// "models": meshes that stand still.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/describe.h"
#include "geometry/mesh.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

const std::vector<std::string> grainKinds = {"earth", "stone"};

// Applies the model's scale, rotation and position, in this order.
void placeMesh(Mesh& mesh, const Model& model) {
    const glm::dmat3 turn = glm::mat3_cast(model.rotation);
    for (auto* points : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& p : *points)
            p = turn * (p * model.scale) + model.position;
    for (auto* normals : {&mesh.normals, &mesh.weldedNormals})
        for (glm::dvec3& n : *normals)
            n = glm::normalize(turn * n);
    const auto findBox = [&mesh] {
        mesh.low = mesh.high = mesh.positions.front();
        for (const glm::dvec3& p : mesh.positions) {
            mesh.low = glm::min(mesh.low, p);
            mesh.high = glm::max(mesh.high, p);
        }
    };
    findBox();
    if (!model.stand) return;
    const double raised = model.position.y - mesh.low.y;
    for (auto* points : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& p : *points)
            p.y += raised;
    findBox();
}

void load(Model& model, const Where& where, SceneReading& reading) {
    if (!where.given("name")) model.name = std::filesystem::path(model.file).stem().string();
    try {
        model.mesh = loadMesh(model.file, reading.lenient);
    } catch (const Error& error) {
        throw Error(where.locate("file"), error.what());
    }
    for (const std::string& note : model.mesh.notes)
        reading.warnings.push_back({where.locate("file"), concat("model \"", model.name, "\": ", note)});
    placeMesh(model.mesh, model);
    const glm::dvec3 reach = glm::max(glm::abs(model.mesh.low), glm::abs(model.mesh.high));
    const double size = glm::distance(model.mesh.low, model.mesh.high);
    const double rounding = std::ldexp(std::max({reach.x, reach.y, reach.z}), -24);
    constexpr double seen = 1e-4;  // of the size
    if (rounding > seen * size && size > 0)
        reading.warnings.push_back(
            {where.locate("file"),
             concat("model \"", model.name, "\" is ", size, " m large and lies so far from the origin that ",
                    "single precision rounds its places by up to ", rounding,
                    " m: give it a \"position\" that takes it there")});
}

// Checks a mesh made in code; the readers of models see to theirs.
void checkMesh(const Mesh& mesh, const Where& where) {
    const size_t count = mesh.positions.size();
    if (mesh.positions.empty() || mesh.normals.size() != count || mesh.weld.size() != count)
        throw Error(where.here(), noTriangles);
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            if (t[i] < 0 || size_t(t[i]) >= count)
                throw Error(where.here(), "has a triangle with vertex ", t[i], " of a mesh of ", count);
    for (const int welded : mesh.weld)
        if (welded < 0 || size_t(welded) >= mesh.weldedPositions.size())
            throw Error(where.here(), "welds to vertex ", welded, " of ", mesh.weldedPositions.size());
}

void checkModel(const Model& model, const Where& where) {
    checkMesh(model.mesh, where.in("mesh"));
    for (const glm::dvec3& corner : {model.mesh.low, model.mesh.high})
        for (int i = 0; i < 3; ++i)
            if (!(std::abs(corner[i]) < largestNumber))
                throw Error(where.here(), "the model reaches ", corner[i],
                            " m after scaling, beyond single precision");
}

}  // namespace

const Description& describe(const Model*) {
    static const auto readFileOf = [](JsonReader& r, Model& model, void*) {
        model.file = needFile(r, "file");
    };
    static const Description description =
        Describe<Model>("model",
                        "A mesh that stands still: it is drawn, carries molecules, and makes colliders.")
            .byHand("file", {.notEmpty = true},
                    {"the name of a file",
                     "OBJ, PLY, glTF, 3MF, XYZ (points), or any format that Assimp reads, within [limits of "
                     "time and "
                     "memory](architecture.md#errors); transforms of nodes are applied, "
                     "and vertices are welded by position. [Materials](#materials-of-models) come with it."},
                    readFileOf)
            .needed()
            .key("name", &Model::name, {"", "Its name; no two have the same."})
            .usually("the file's name without its ending")
            .key("position", &Model::position, {"m", "Where it is moved, after rotation and scale."})
            .rotation("rotation", &Model::rotation, {"", "How it is turned."})
            .key("scale", &Model::scale, {"", "Its size.", aboveZero()})
            .key("stand", &Model::stand,
                 {"", "Whether its lowest point is at the height of `position`, as on the ground at y = 0."})
            .key("draw", &Model::draw, {"", "Whether it is drawn."})
            .color("color", &Model::color,
                   {"", "What multiplies the colours of its materials, images and vertices."})
            .key("roughness", &Model::roughness, {"", "How dull it is.", Range::between(0, 1)})
            .usually("as its materials say, else 0.9")
            .key("grain", &Model::grain, {"", "The strength of the drawn grain.", Range::between(0, 1)})
            .word("grainOf", &Model::grainOf, grainKinds,
                  {"",
                   "What the grain is of: earth is soil and grass on what faces up, and bark elsewhere; "
                   "stone is "
                   "alike in all directions."})
            .derive(load)
            .rule(checkModel);
    return description;
}

}  // namespace shoal
