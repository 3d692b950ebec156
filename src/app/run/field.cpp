// `shoal field`: bakes the distance fields of a scene, or of a model, and reports them.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "app/line/commands.h"
#include "app/molecule/canvas.h"
#include "core/cache_folder.h"
#include "core/file.h"
#include "core/json_build.h"
#include "core/printable.h"
#include "geometry/mesh.h"
#include "run/progress.h"
#include "scene/json/scene_file.h"
#include "scene/known_colliders.h"

namespace shoal::app {

namespace {

// ---- A slice through a distance field as a picture

struct SlicePlane {
    int axis = 2;         // across: 0 x, 1 y, 2 z
    double position = 0;  // m
};

struct SlicePicture {
    Image image;
    double contours = 0;  // m, between two lines
};

constexpr int legendHeight = 44, border = 12;

// 1, 2 or 5 times a power of ten.
double niceStep(double about) {
    const double power = std::pow(10, std::floor(std::log10(about))), lead = about / power;
    return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

// Draws at most width x height pixels: outside in ochre, inside in blue, deeper with the distance; a contour
// every `contours` m, the zero line black, and in white where the plane cuts the model itself. Below, a scale
// in m. y goes up, else z down.
class SliceCanvas {
  public:
    SliceCanvas(const DistanceField& field, const SlicePlane& plane, int width, int height)
        : field_(field), plane_(plane), across_(plane.axis == 0 ? 2 : 0), up_(plane.axis == 1 ? 2 : 1) {
        const glm::dvec3 extent = field.grid.high() - field.grid.low;
        const double wide = std::max(1, width - 2 * border),
                     high = std::max(1, height - legendHeight - border);
        pixel_ = std::max(extent[across_] / wide, extent[up_] / high);
        columns_ = std::max(1, int(extent[across_] / pixel_));
        rows_ = std::max(1, int(extent[up_] / pixel_));
        picture_.image = {std::max(columns_ + 2 * border, 320), rows_ + border + legendHeight, 4, {}};
        picture_.image.pixels.assign(size_t(picture_.image.width) * size_t(picture_.image.height) * 4, 250);
        for (size_t alpha = 3; alpha < picture_.image.pixels.size(); alpha += 4)
            picture_.image.pixels[alpha] = 255;
        left_ = (picture_.image.width - columns_) / 2;
        findRange();
    }

    SlicePicture draw(const Mesh& mesh) {
        for (int y = 0; y < rows_; ++y)
            for (int x = 0; x < columns_; ++x)
                set(left_ + x, border + y, shade(x, y));
        Canvas lines(picture_.image, {left_, border}, {columns_, rows_});
        for (const glm::ivec3& t : mesh.triangles)
            drawCut(lines, mesh, t);
        drawLegend();
        return std::move(picture_);
    }

  private:
    glm::dvec3 place(double x, double y) const {
        glm::dvec3 out;
        out[plane_.axis] = plane_.position;
        out[across_] = field_.grid.low[across_] + (x + 0.5) * pixel_;
        out[up_] = plane_.axis == 1 ? field_.grid.low[2] + (y + 0.5) * pixel_
                                    : field_.grid.high()[up_] - (y + 0.5) * pixel_;
        return out;
    }
    glm::dvec2 pixelOf(const glm::dvec3& p) const {
        const double down = plane_.axis == 1 ? p.z - field_.grid.low.z : field_.grid.high()[up_] - p[up_];
        return {(p[across_] - field_.grid.low[across_]) / pixel_ - 0.5, down / pixel_ - 0.5};
    }

    // Finds the range of distances on the slice, which sets the colours and the contours.
    void findRange() {
        double low = 0, high = 0;
        for (int y = 0; y < rows_; y += 4)
            for (int x = 0; x < columns_; x += 4) {
                const double d = valueAt(field_, place(x, y)).distance;
                low = std::min(low, d), high = std::max(high, d);
            }
        low_ = low, high_ = std::max(high, 1e-30);
        picture_.contours = niceStep((high_ - low_) / 14);
    }

    glm::dvec3 ground(double d) const {
        const glm::dvec3 bright = d < 0 ? glm::dvec3(0.86, 0.92, 0.97) : glm::dvec3(0.99, 0.96, 0.90);
        const glm::dvec3 deep = d < 0 ? glm::dvec3(0.10, 0.27, 0.53) : glm::dvec3(0.76, 0.44, 0.16);
        const double range = d < 0 ? low_ : high_;
        return glm::mix(bright, deep, std::pow(std::clamp(d / range, 0.0, 1.0), 0.8));
    }

    // Share of a pixel that a line of this width covers, from its middle's distance to it in pixels.
    static double cover(double distance, double width) {
        return std::clamp(width / 2 + 0.5 - std::abs(distance), 0.0, 1.0);
    }

    // The colour of a distance, with the contours; `perPixel`: m.
    glm::dvec3 colorOf(double distance, double perPixel) const {
        const double step = picture_.contours, nearest = std::round(distance / step);
        const double line = cover((distance - nearest * step) / perPixel, 1);
        const bool fifth = std::fmod(std::abs(nearest), 5) == 0;
        const glm::dvec3 color = ground(distance) * (1 - line * (fifth ? 0.42 : 0.2));
        return glm::mix(color, glm::dvec3(0.05), cover(distance / perPixel, 2.6));
    }

    glm::dvec3 shade(int x, int y) const {
        const FieldValue value = valueAt(field_, place(x, y));
        glm::dvec3 in = value.gradient;
        in[plane_.axis] = 0;
        return colorOf(value.distance, std::max(glm::length(in), 0.2) * pixel_);
    }

    // Where the plane cuts a triangle.
    void drawCut(Canvas& lines, const Mesh& mesh, const glm::ivec3& t) {
        glm::dvec2 ends[3];
        int count = 0;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 &a = mesh.positions[size_t(t[i])], &b = mesh.positions[size_t(t[(i + 1) % 3])];
            const double da = a[plane_.axis] - plane_.position, db = b[plane_.axis] - plane_.position;
            if ((da < 0) == (db < 0)) continue;
            ends[count++] = pixelOf(glm::mix(a, b, da / (da - db)));
        }
        if (count == 2) lines.line(glm::vec2(ends[0]) + 0.5f, glm::vec2(ends[1]) + 0.5f, 0.7f, glm::vec4(1));
    }

    // The colours from the least to the largest distance seen, with every fifth contour's number.
    void drawLegend() {
        const int wide = std::min(columns_, picture_.image.width - 2 * border) - 40;
        const int from = (picture_.image.width - wide) / 2, top = border + rows_ + 8;
        const double step = picture_.contours, scale = (high_ - low_) / wide;
        for (int x = 0; x < wide; ++x) {
            const glm::dvec3 color = colorOf(low_ + (x + 0.5) * scale, scale);
            for (int y = 0; y < 12; ++y)
                set(from + x, top + y, color);
        }
        Canvas numbers(picture_.image, {0, 0}, {picture_.image.width, picture_.image.height});
        for (int n = int(std::ceil(low_ / step)); n * step <= high_; ++n) {
            if (n % 5 != 0) continue;
            std::string text = concat(std::round(n * step * 1e9) / 1e9);
            if (n == 0) text = "0 m";
            const int middle = from + int((n * step - low_) / scale);
            numbers.text({middle - Canvas::widthOf(text, 2) / 2, top + 10}, text,
                         glm::vec4(0.24, 0.24, 0.24, 1), 2);
        }
    }

    void set(int x, int y, const glm::dvec3& color) {
        uint8_t* p = &picture_.image.pixels[(size_t(y) * size_t(picture_.image.width) + size_t(x)) * 4];
        for (int i = 0; i < 3; ++i)
            p[i] = uint8_t(std::lround(255 * std::clamp(color[i], 0.0, 1.0)));
    }

    const DistanceField& field_;
    SlicePlane plane_;
    int across_, up_;   // axes of the picture
    double pixel_ = 1;  // m
    int columns_ = 1, rows_ = 1, left_ = 0;
    double low_ = 0, high_ = 1;  // m, seen
    SlicePicture picture_;
};

// ---- Fields

struct BakedField {
    std::string name;  // of the collider, else of the model
    Mesh mesh;
    FieldRequest request;
    DistanceField field;
};

std::vector<BakedField> fieldsOfScene(const Options& options, std::vector<Warning>& warnings) {
    const Options::Field& asked = options.field;
    if (asked.resolution || asked.error || asked.shell || asked.thickness)
        throw Error(
            "--resolution, --error, --shell and --thickness are of a model file: a scene has its own");
    const Scene scene = readScene(options.files.front(), SceneOptions{.lenient = options.lenient});
    warnings = scene.warnings;
    std::vector<BakedField> out;
    for (const Collider& collider : scene.colliders) {
        const auto* field = kindOf<DistanceFieldCollider>(*collider.shape);
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

std::vector<BakedField> fieldsOfModel(const Options& options, std::vector<Warning>& warnings) {
    const std::string& file = options.files.front();
    BakedField out;
    out.name = std::filesystem::path(file).stem().string();
    out.request.resolution = options.field.resolution;
    out.request.error = options.field.error;
    out.request.shell = options.field.shell;
    out.request.thickness = options.field.thickness.value_or(Collider{}.thickness);
    out.mesh = loadMesh(file, options.lenient);
    for (const std::string& note : out.mesh.notes)
        warnings.push_back({{file, 0, 0, {}}, note});
    try {
        out.field = distanceFieldOf(out.mesh, out.request, {cacheFolder(), {}}, warnings);
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

JsonValue asJson(const BakedField& baked) {
    const DistanceField& field = baked.field;
    JsonValue out = object(key("name", baked.name), key("triangles", field.surface.triangles),
                           key("closed", field.surface.closed()));
    if (!field.surface.closed()) append(out, key("open", whyOpen(field.surface)), key("shell", field.shell));
    const JsonValue error = object(key("probes", field.error.probes), key("most", field.error.most),
                                   key("rms", field.error.rms), key("where", field.error.where));
    return append(out, key("resolution", field.resolution), key("samples", field.grid.size),
                  key("cell", field.grid.cell), key("low", field.grid.low), key("high", field.grid.high()),
                  key("bytes", field.bytesOnDevice()), key("cached", field.cached),
                  key("seconds", field.seconds), key("error", error));
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
    std::vector<BakedField> fields =
        scene ? fieldsOfScene(options, warnings) : fieldsOfModel(options, warnings);
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
            SliceCanvas(fields.front().field, plane, options.width, options.height).draw(fields.front().mesh);
        writePng(options.capture, picture.image);
        drawn = concat("  ", printable(options.capture), ": the slice ", "xyz"[plane.axis], " = ",
                       plane.position, " m, a contour every ", picture.contours, " m\n");
    }
    std::string text;
    for (const BakedField& field : fields)
        text += asText(field);
    std::cout << (options.json ? writeJson(arrayOf(fields, asJson)) : text + drawn);
    return 0;
}

}  // namespace shoal::app
