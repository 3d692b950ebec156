// "colliders" and "surfacePairs": what molecules meet, and how.
#include <algorithm>
#include <cmath>
#include <span>

#include "core/describe.h"
#include "core/image.h"
#include "scene/collider_kinds.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

void checkRectangle(const glm::dvec2& low, const glm::dvec2& high, const Where& where) {
    for (int i = 0; i < 2; ++i)
        if (!(low[i] < high[i]))
            throw Error(where.locate("high"), "expected high above low along ", i == 0 ? "x" : "z",
                        ", found ", high[i], " against ", low[i]);
}

HeightFieldCollider heightsOfImage(const HeightSource& source, const Where& where) {
    const std::string file = needFile(where, "image", source.image);
    checkRectangle(source.low, source.high, where);
    const HeightImage image = readHeightPng(file);
    if (image.width < 2 || image.height < 2)
        throw Error(Location{file}, "expected an image of at least 2 by 2 pixels, found ", image.width,
                    " by ", image.height);
    return heightFieldFromImage(image, source.low, source.high, source.heights);
}

HeightFieldCollider heightsOfModel(const HeightSource& source, const Where& where,
                                   const SceneReading& reading) {
    const Model& model = reading.models[size_t(needModel(where, "model", source.model, reading.models))];
    const int resolution = source.resolution;
    const Mesh& mesh = model.mesh;
    if (mesh.triangles.empty())
        throw Error(where.locate("model"), "model \"", model.name, "\" ", noTriangles);
    if (!(mesh.low.x < mesh.high.x && mesh.low.z < mesh.high.z))
        throw Error(where.locate("model"),
                    "expected a model that covers an area in x and z, found one seen edge-on");
    int missed = 0;
    HeightFieldCollider heights = heightFieldFromMesh(mesh, resolution, resolution, &missed);
    if (missed > 0)
        reading.warnings.push_back(
            {where.locate("model"),
             concat(missed, " of ", resolution * resolution, " height samples have no surface of model \"",
                    model.name, "\" beneath; they take its lowest height")});
    return heights;
}

void load(HeightFieldCollider& out, const Where& where, SceneReading& reading) {
    if (where.given("image") == where.given("model"))
        throw Error(where.here(), "expected either \"image\" or \"model\" for a height field");
    HeightFieldCollider heights =
        where.given("image") ? heightsOfImage(out.source, where) : heightsOfModel(out.source, where, reading);
    heights.source = out.source;
    heights.sampledNormals = out.sampledNormals;
    out = std::move(heights);
}

void load(DistanceFieldCollider& out, const Where& where, SceneReading& reading) {
    needModel(where, "model", out.model, reading.models);
    if (out.request.resolution && out.request.error)
        throw Error(where.locate("error"), "expected either \"resolution\" or \"error\", found both");
}

// m: of the spheres that molecules carry.
double largestRadius(const Scene& scene) {
    double out = 0;
    for (const Group& group : scene.groups) {
        if (!group.contact || !group.collide) continue;
        double scale = group.place.scale.y;
        if (group.life) scale = std::max(scale, group.life->scale.y);
        if (group.particle) scale *= std::max(group.particle->growth.x, group.particle->growth.y);
        out = std::max(out, group.contact->radius * scale);
    }
    return out;
}

void checkHeights(const HeightFieldCollider& field, const Where& where) {
    needWithin(where.locate("columns"), field.columns, Range::atLeast(2));
    needWithin(where.locate("rows"), field.rows, Range::atLeast(2));
    const Range finite = Range::between(-largestNumber, largestNumber);
    for (int i = 0; i < 2; ++i) {
        needWithin(where.locate(concat("low[", i, "]")), field.low[i], finite);
        needWithin(where.locate(concat("high[", i, "]")), field.high[i], finite);
    }
    checkRectangle(field.low, field.high, where);
    const size_t samples = size_t(field.columns) * size_t(field.rows);
    if (field.heights.size() != samples)
        throw Error(where.locate("heights"), "expected ", samples, " heights, found ", field.heights.size());
    for (const float height : field.heights)
        if (!(std::abs(height) <= largestNumber)) needWithin(where.locate("heights"), double(height), finite);
}

void checkDistances(const DistanceFieldCollider& collider, const Where& where) {
    const DistanceField& field = collider.field;
    if (where.given("model")) return;  // of a file they are baked when all else is read
    if (field.distances.empty() || field.distances.size() != field.grid.count())
        throw Error(where.locate("field"), "expected ", field.grid.count(),
                    " distances, one a sample of a grid, found ", field.distances.size());
}

}  // namespace

static const Description& describe(const HeightSource*) {
    using H = HeightSource;
    static const Description description =
        Describe<H>("source", "Where heights come from.")
            .key("image", &H::image,
                 {"the name of a grey PNG",
                  "The heights, of 8 or 16 bits; the left column is the lowest x, the top row the lowest z."})
            .key("low", &H::low, {"m", "The x and z of the first sample."})
            .needed()
            .only("image", {})
            .key("high", &H::high, {"m", "The x and z of the last sample."})
            .needed()
            .only("image", {})
            .key("heights", &H::heights, {"m", "The heights of black and of white."})
            .needed()
            .only("image", {})
            .key("model", &H::model,
                 {"the name of a model",
                  "The model whose highest surface counts, over its bounding box; samples without a surface "
                  "take its lowest height."})
            .key("resolution", &H::resolution,
                 {"", "The number of samples along x and along z.", Range::between(2, 4096)})
            .only("model", {});
    return description;
}

const Description& describe(const HeightFieldCollider*) {
    using H = HeightFieldCollider;
    static const Description description =
        Describe<H>("heightField", "Heights over a rectangle in x and z, solid below.")
            .keysOf(&H::source)
            .word("normals", &H::sampledNormals, {"stored", "sampled"},
                  {"", "Whether normals are kept beside the heights, or taken from three samples."})
            .derive<SceneReading>(load)
            .rule(checkHeights, R"({"oneOf": [{"required": ["image"]}, {"required": ["model"]}]})");
    return description;
}

static const Description& describe(const FieldRequest*) {
    using R = FieldRequest;
    static const Description description =
        Describe<R>("request", "How fine a distance field is.")
            .key("resolution", &R::resolution,
                 {"", "The number of cells along the model's longest side.",
                  Range::between(leastResolution, mostResolution)})
            .usually(concat(defaultResolution, " without `error`"))
            .key("error", &R::error,
                 {"m", "The grid is refined until no probe near the surface is off by more.", aboveZero()})
            .key("shell", &R::shell, {"m", "The thickness of a model that is not closed.", aboveZero()})
            .usually("two cells");
    return description;
}

const Description& describe(const DistanceFieldCollider*) {
    using D = DistanceFieldCollider;
    static const Description description =
        Describe<D>("distanceField", "The surface of a model, by signed distances on a grid.")
            .key("model", &D::model, {"the name of a model", "The model."})
            .needed()
            .keysOf(&D::request)
            .derive<SceneReading>(load)
            .rule(checkDistances, R"({"not": {"required": ["resolution", "error"]}})");
    return description;
}

namespace {

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
            throw Error(where.locate("between"), "\"", rule.a, "\" and \"", rule.b,
                        "\" already have an entry");
}

}  // namespace

void checkSurfaces(const Scene& scene, const Where& whole) {
    const std::vector<std::string> known = surfaceNames(scene.colliders, scene.groups);
    for (size_t i = 0; i < scene.surfacePairs.size(); ++i) {
        const SurfaceRule& rule = scene.surfacePairs[i];
        const Where where = whole.in("surfacePairs", i);
        for (const std::string& name : {rule.a, rule.b})
            needNamed(name, known, where.locate("between"), "no collider and no group has the surface",
                      " (none names a \"surface\")");
        checkNew(rule, std::span(scene.surfacePairs).first(i), where);
    }
}

void bakeFields(Scene& scene, const FieldBaking& baking, const Where& whole) {
    const double radius = largestRadius(scene);
    for (size_t i = 0; i < scene.colliders.size(); ++i) {
        auto* out = std::get_if<DistanceFieldCollider>(&*scene.colliders[i].shape);
        if (!out) continue;
        const Where where = whole.in("colliders", i);
        const Model& model = scene.models[size_t(needModel(where, "model", out->model, scene.models))];
        FieldRequest& request = out->request;
        request.thickness = std::max(scene.colliders[i].thickness, radius);
        try {
            out->field = distanceFieldOf(model.mesh, request, baking, scene.warnings);
        } catch (const Error& error) {
            const char* key = request.error ? "error" : request.resolution ? "resolution" : "model";
            throw Error(where.locate(key), "model \"", model.name, "\": ", error.message());
        }
        for (const std::string& warning : fieldWarnings(out->field, request))
            scene.warnings.push_back({where.locate("model"), concat("model \"", model.name, "\" ", warning)});
    }
}

}  // namespace shoal
