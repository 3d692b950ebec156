// "colliders" and "surfacePairs": what molecules meet, and how.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/description.h"
#include "geometry/distance_field_cache.h"
#include "scene/height_field.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

void checkRectangle(const glm::dvec2& low, const glm::dvec2& high, const Where& where) {
    for (int i = 0; i < 2; ++i)
        if (!(low[i] < high[i]))
            throw Error(where.at("high"), concat("expected high above low along ", i == 0 ? "x" : "z",
                                                 ", found ", high[i], " against ", low[i]));
}

HeightFieldCollider readImageHeights(JsonReader& r) {
    const std::string file = needFile(r, "image");
    glm::dvec2 low(0), high(0), heights(0);
    r.need("low", low);
    r.need("high", high);
    r.need("heights", heights);
    checkRectangle(low, high, r);
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

// All keys of a height field.
void readHeightField(JsonReader& r, HeightFieldCollider& heights, SceneReading* reading) {
    if (r.has("image") == r.has("model"))
        throw Error(r.here(), "expected either \"image\" or \"model\" for a height field");
    heights = r.has("image") ? readImageHeights(r) : readModelHeights(r, reading->models, reading->warnings);
    int normals = 0;
    r.choose("normals", {"stored", "sampled"}, normals);
    heights.sampledNormals = normals == 1;
}

// All keys of a distance field.
void readDistanceField(JsonReader& r, DistanceFieldCollider& out, SceneReading* reading) {
    const Model& model = reading->models[size_t(needModel(r, "model", reading->models))];
    out.model = model.name;
    FieldRequest& request = out.request;
    request.thickness = Collider().thickness;
    r.get("thickness", request.thickness, Range::atLeast(0));
    if (r.has("resolution") && r.has("error"))
        throw Error(r.at("error"), "expected either \"resolution\" or \"error\", found both");
    int resolution = 0;
    if (r.get("resolution", resolution, Range::between(leastResolution, mostResolution)))
        request.resolution = resolution;
    getOptional(r, "error", request.error, aboveZero());
    getOptional(r, "shell", request.shell, aboveZero());
    try {
        out.field = distanceFieldOf(model.mesh, request, reading->baking, reading->warnings);
    } catch (const Error& error) {
        const char* key = request.error ? "error" : request.resolution ? "resolution" : "model";
        throw Error(r.at(key), concat("model \"", model.name, "\": ", error.message()));
    }
    for (const std::string& warning : fieldWarnings(out.field, request))
        reading->warnings.push_back({r.at("model"), concat("model \"", model.name, "\" ", warning)});
}

void checkHeights(const HeightFieldCollider& field, const Where& where) {
    needWithin(where.at("columns"), field.columns, Range::atLeast(2));
    needWithin(where.at("rows"), field.rows, Range::atLeast(2));
    const Range finite = Range::between(-largestNumber, largestNumber);
    for (int i = 0; i < 2; ++i) {
        needWithin(where.at(concat("low[", i, "]")), field.low[i], finite);
        needWithin(where.at(concat("high[", i, "]")), field.high[i], finite);
    }
    checkRectangle(field.low, field.high, where);
    const size_t samples = size_t(field.columns) * size_t(field.rows);
    if (field.heights.size() != samples)
        throw Error(where.at("heights"),
                    concat("expected ", samples, " heights, found ", field.heights.size()));
    for (const float height : field.heights)
        if (!(std::abs(height) <= largestNumber)) needWithin(where.at("heights"), double(height), finite);
}

void checkDistances(const DistanceFieldCollider& collider, const Where& where) {
    const DistanceField& field = collider.field;
    if (field.distances.empty() || field.distances.size() != field.grid.count())
        throw Error(where.at("field"),
                    concat("expected ", field.grid.count(), " distances, one a sample of a grid, found ",
                           field.distances.size()));
}

}  // namespace

const Description& describe(const HeightFieldCollider*) {
    static const char* const number = R"({"type": "integer", "minimum": 2, "maximum": 4096, "default": 257})";
    static const char* const pair = R"({"$ref": "#/$defs/vector2"})";
    static const Description it =
        Describe<HeightFieldCollider>("heightField", "Heights over a rectangle in x and z, solid below.")
            .byHand<SceneReading>(
                "image", R"({"type": "string", "minLength": 1})",
                {"the name of a grey PNG",
                 "The heights, of 8 or 16 bits; the left column is the lowest x, the top row the lowest z."},
                readHeightField)
            .told("low", pair, {"two numbers, m", "The x and z of the first sample, with `image`."})
            .told("high", pair, {"two numbers, m", "The x and z of the last sample, with `image`."})
            .told("heights", pair, {"two numbers, m", "The heights of black and of white, with `image`."})
            .told("model", R"({"type": "string"})",
                  {"the name of a model",
                   "The model whose highest surface counts, over its bounding box; samples without a surface "
                   "take its "
                   "lowest height."})
            .told("resolution", number,
                  {"whole number from 2 to 4096", "The number of samples along x and along z, with `model`."})
            .told("normals", R"({"enum": ["stored", "sampled"], "default": "stored"})",
                  {"`\"stored\"`, `\"sampled\"`",
                   "Whether normals are kept beside the heights, or taken from three samples."})
            .rule(checkHeights, R"({"oneOf": [
                      {"required": ["image", "low", "high", "heights"],
                       "not": {"anyOf": [{"required": ["model"]}, {"required": ["resolution"]}]}},
                      {"required": ["model"],
                       "not": {"anyOf": [{"required": ["image"]}, {"required": ["low"]}, {"required": ["high"]},
                                         {"required": ["heights"]}]}}]})");
    return it;
}

const Description& describe(const DistanceFieldCollider*) {
    static const char* const length = R"({"type": "number", "minimum": 1e-9})";
    static const Description it =
        Describe<DistanceFieldCollider>("distanceField",
                                        "The surface of a model, by signed distances on a grid.")
            .byHand<SceneReading>("model", R"({"type": "string", "minLength": 1})",
                                  {"the name of a model", "The model."}, readDistanceField)
            .needed()
            .told(
                "resolution", R"({"type": "integer", "minimum": 4, "maximum": 2048})",
                {"whole number from 4 to 2048",
                 "The number of cells along the model's longest side; 96 without `resolution` and `error`."})
            .told(
                "error", length,
                {"number above 0, m", "The grid is refined until no probe near the surface is off by more."})
            .told("shell", length,
                  {"number above 0, m", "The thickness of a model that is not closed; two cells without it."})
            .rule(checkDistances, R"({"not": {"required": ["resolution", "error"]}})");
    return it;
}

namespace {

// A name of "between", which some collider or group must have.
void needSurface(const Where& r, const std::string& name, const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    throw Error(r.at("between"),
                "no collider and no group has the surface \"" + name + "\"" +
                    (known.empty() ? " (none names a \"surface\")" : suggestion(name, known)));
}

std::vector<std::string> surfaceNames(const std::vector<Collider>& colliders,
                                      const std::vector<Group>& groups) {
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    };
    for (const Collider& collider : colliders)
        add(collider.surface);
    for (const Group& group : groups)
        add(group.surface);
    return names;
}

void checkNew(const SurfaceRule& rule, std::span<const SurfaceRule> before, const Where& where) {
    for (const SurfaceRule& earlier : before)
        if ((earlier.a == rule.a && earlier.b == rule.b) || (earlier.a == rule.b && earlier.b == rule.a))
            throw Error(where.at("between"),
                        concat("\"", rule.a, "\" and \"", rule.b, "\" already have an entry"));
}

}  // namespace

void checkSurfaces(const Scene& scene, const Where& whole) {
    const std::vector<std::string> known = surfaceNames(scene.colliders, scene.groups);
    for (size_t i = 0; i < scene.surfacePairs.size(); ++i) {
        const SurfaceRule& rule = scene.surfacePairs[i];
        const Where where = whole.in("surfacePairs", i);
        needSurface(where, rule.a, known);
        needSurface(where, rule.b, known);
        checkNew(rule, std::span(scene.surfacePairs).first(i), where);
    }
}

}  // namespace shoal
