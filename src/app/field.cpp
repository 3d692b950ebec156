// `shoal field`: bakes the distance fields of a scene, or of a model, and reports them.
#include <iostream>

#include "app/commands.h"
#include "app/field_slice.h"
#include "core/file.h"
#include "core/json.h"
#include "core/printable.h"
#include "geometry/load_model.h"
#include "run/progress.h"
#include "scene/json/scene_file.h"

namespace shoal::app {

namespace {

struct BakedField {
    std::string name;  // of the collider, else of the model
    Mesh mesh;
    FieldRequest request;
    DistanceField field;
};

std::vector<BakedField> ofScene(const Options& options, std::vector<Warning>& warnings) {
    const Options::Field& asked = options.field;
    if (asked.resolution || asked.error || asked.shell || asked.thickness)
        throw Error(
            "--resolution, --error, --shell and --thickness are of a model file: a scene has its own");
    FieldWatch watch;
    const Scene scene = readScene(options.files.front(), watch.baking());
    warnings = scene.warnings;
    std::vector<BakedField> out;
    for (const Collider& collider : scene.colliders) {
        const auto* field = std::get_if<DistanceFieldCollider>(&collider.shape);
        if (!field) continue;
        for (const Model& model : scene.models)
            if (model.name == field->model)
                out.push_back({collider.name.empty() ? field->model : collider.name, model.mesh,
                               field->request, field->field});
    }
    if (out.empty())
        throw Error(Location{options.files.front(), 0, 0, {}}, "has no collider of type \"distanceField\"");
    return out;
}

std::vector<BakedField> ofModel(const Options& options, std::vector<Warning>& warnings) {
    const std::string& file = options.files.front();
    BakedField out;
    out.name = std::filesystem::path(file).stem().string();
    out.request.resolution = options.field.resolution;
    out.request.error = options.field.error;
    out.request.shell = options.field.shell;
    out.request.thickness = options.field.thickness.value_or(Collider{}.thickness);
    out.mesh = loadMesh(file);
    FieldWatch watch;
    try {
        out.field = distanceFieldOf(out.mesh, out.request, watch.baking(), warnings);
    } catch (const Error& error) {
        throw Error(Location{file, 0, 0, {}}, error.message());
    }
    for (const std::string& warning : fieldWarnings(out.field, out.request))
        warnings.push_back({{file, 0, 0, {}}, warning});
    return {std::move(out)};
}

std::string triple(const glm::dvec3& v) {
    return concat("(", v.x, ", ", v.y, ", ", v.z, ")");
}

std::string asText(const BakedField& baked) {
    const DistanceField& field = baked.field;
    const SampleGrid& grid = field.grid;
    const double mebibytes = double(field.bytesOnDevice()) / (1 << 20);
    std::string out =
        concat("field \"", printable(baked.name), "\": ", field.surface.triangles, " triangles, ",
               field.surface.closed() ? std::string("closed") : "not closed: " + whyOpen(field.surface));
    if (field.shell > 0) out += concat("\n  a shell ", field.shell, " m thick");
    out += concat("\n  resolution ", field.resolution, ": ", grid.size.x, " x ", grid.size.y, " x ",
                  grid.size.z, " samples ", grid.cell, " m apart, from ", triple(grid.low), " to ",
                  triple(grid.high()), "; ", std::round(10 * mebibytes) / 10, " MiB on the device");
    out += concat("\n  ", field.cached ? "from the cache; baked in " : "baked in ",
                  std::round(1000 * field.seconds) / 1000, " s");
    out += concat("\n  error against exact distances, at ", field.error.probes,
                  " points within a cell of the surface: at most ", field.error.most, " m (",
                  field.error.most / grid.cell, " cells) at ", triple(field.error.where), ", RMS ",
                  field.error.rms, " m (", field.error.rms / grid.cell, " cells)\n");
    return out;
}

JsonValue asJson(const glm::dvec3& v) {
    JsonValue out = JsonValue::makeArray();
    for (int i = 0; i < 3; ++i)
        out.items.push_back(JsonValue::makeNumber(v[i]));
    return out;
}

JsonValue asJson(const BakedField& baked) {
    const DistanceField& field = baked.field;
    JsonValue out = JsonValue::makeObject(), error = JsonValue::makeObject();
    error.add("probes", JsonValue::makeNumber(double(field.error.probes)))
        .add("most", JsonValue::makeNumber(field.error.most))
        .add("rms", JsonValue::makeNumber(field.error.rms))
        .add("where", asJson(field.error.where));
    out.add("name", JsonValue::makeString(baked.name))
        .add("triangles", JsonValue::makeNumber(double(field.surface.triangles)))
        .add("closed", JsonValue::makeBoolean(field.surface.closed()));
    if (!field.surface.closed())
        out.add("open", JsonValue::makeString(whyOpen(field.surface)))
            .add("shell", JsonValue::makeNumber(field.shell));
    out.add("resolution", JsonValue::makeNumber(field.resolution))
        .add("samples", asJson(glm::dvec3(field.grid.size)))
        .add("cell", JsonValue::makeNumber(field.grid.cell))
        .add("low", asJson(field.grid.low))
        .add("high", asJson(field.grid.high()))
        .add("bytes", JsonValue::makeNumber(double(field.bytesOnDevice())))
        .add("cached", JsonValue::makeBoolean(field.cached))
        .add("seconds", JsonValue::makeNumber(field.seconds))
        .add("error", std::move(error));
    return out;
}

// Through the middle of the model where the command line does not say.
SlicePlane planeOf(const Options& options, const BakedField& baked) {
    const SampleGrid& grid = baked.field.grid;
    const int axis = options.field.sliceAxis.value_or(2);
    const double middle = (grid.low[axis] + grid.high()[axis]) / 2;
    const double position = options.field.slicePosition.value_or(middle);
    if (position < grid.low[axis] || position > grid.high()[axis])
        throw WrongUse(concat("--slice: ", "xyz"[axis], " = ", position, " is outside of the grid, from ",
                              grid.low[axis], " to ", grid.high()[axis]));
    return {axis, position};
}

}  // namespace

int fieldCommand(const Options& options) {
    std::vector<Warning> warnings;
    const bool scene = lowerExtension(options.files.front()) == ".json";
    std::vector<BakedField> fields = scene ? ofScene(options, warnings) : ofModel(options, warnings);
    tellWarnings(warnings);
    if (!options.only.empty())
        std::erase_if(fields,
                      [&](const BakedField& f) { return f.name.find(options.only) == std::string::npos; });
    if (fields.empty())
        throw WrongUse(concat("--only: no distance field has \"", options.only, "\" in its name"));
    if (!options.capture.empty() && fields.size() > 1)
        throw WrongUse(concat("--capture draws one field, and the scene has ", fields.size(),
                              ": choose one with --only"));
    std::string drawn;
    if (!options.capture.empty()) {
        const SlicePlane plane = planeOf(options, fields.front());
        const SlicePicture picture =
            drawSlice(fields.front().field, fields.front().mesh, plane, options.width, options.height);
        writePng(options.capture, picture.image);
        drawn = concat("  ", printable(options.capture), ": the slice ", "xyz"[plane.axis], " = ",
                       plane.position, " m, a contour every ", picture.contours, " m\n");
    }
    JsonValue report = JsonValue::makeArray();
    for (const BakedField& field : fields) {
        report.items.push_back(asJson(field));
        if (!options.json) std::cout << asText(field);
    }
    std::cout << (options.json ? writeJson(report) : drawn);
    return 0;
}

}  // namespace shoal::app
