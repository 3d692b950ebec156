// "fields": what moves the fluid.

#include <algorithm>
#include <numbers>

#include "core/file.h"
#include "scene/field_file.h"
#include "scene/file_sequence.h"
#include "scene/scene_reader.h"

namespace shoal {

namespace {

UniformField readUniform(JsonReader& r) {
    UniformField field;
    r.need("velocity", field.velocity);
    return field;
}

OscillatingField readOscillating(JsonReader& r) {
    OscillatingField field;
    r.need("velocity", field.velocity);
    r.need("frequency", field.frequency, Range::atLeast(0));
    r.get("phase", field.phase);
    return field;
}

uint32_t getSeed(JsonReader& r) {
    uint64_t seed = 0;
    if (r.get("seed", seed) && seed > 0xFFFFFFFFu)
        throw Error(r.at("seed"), "expected a seed of at most 4294967295 (32 bits)");
    return static_cast<uint32_t>(seed);
}

GustField readGust(JsonReader& r) {
    GustField field;
    getDirection(r, "direction", field.direction);
    r.get("speed", field.speed);
    r.get("strength", field.strength, Range::atLeast(0));
    r.get("length", field.length, aboveZero());
    r.get("width", field.width, aboveZero());
    r.get("frontSpeed", field.frontSpeed);
    field.seed = getSeed(r);
    return field;
}

ShearField readShear(JsonReader& r) {
    ShearField field;
    r.get("origin", field.origin);
    r.get("velocity", field.velocity);
    r.require("gradient");
    const JsonValue* rows = r.raw("gradient");
    std::vector<double> numbers;
    if (rows->kind == JsonValue::Kind::array)
        for (const JsonValue& row : rows->items)
            if (row.kind == JsonValue::Kind::array && row.items.size() == 3)
                for (const JsonValue& entry : row.items)
                    if (entry.kind == JsonValue::Kind::number) numbers.push_back(entry.number);
    if (numbers.size() != 9 || rows->items.size() != 3)
        throw Error(r.at("gradient"), "expected three rows of three numbers");
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            field.gradient[column][row] = numbers[size_t(3 * row + column)];  // glm stores columns
    return field;
}

VortexField readVortex(JsonReader& r) {
    VortexField field;
    r.get("origin", field.origin);
    getDirection(r, "axis", field.axis);
    r.get("speed", field.speed);
    r.get("radius", field.radius, aboveZero());
    r.get("lift", field.lift);
    return field;
}

AbcField readAbc(JsonReader& r) {
    AbcField field;
    r.get("origin", field.origin);
    r.get("a", field.a);
    r.get("b", field.b);
    r.get("c", field.c);
    r.get("wavelength", field.wavelength, aboveZero());
    return field;
}

TaylorGreenField readTaylorGreen(JsonReader& r) {
    TaylorGreenField field;
    r.get("origin", field.origin);
    r.get("speed", field.speed);
    r.get("wavelength", field.wavelength, aboveZero());
    return field;
}

CurlNoiseField readCurlNoise(JsonReader& r) {
    CurlNoiseField field;
    r.get("speed", field.speed, Range::atLeast(0));
    r.get("length", field.length, aboveZero());
    r.get("period", field.period, aboveZero());
    r.get("octaves", field.octaves, Range::between(1, 4));
    field.seed = getSeed(r);
    return field;
}

WavesField readWaves(JsonReader& r) {
    WavesField field;
    r.get("origin", field.origin);
    getOptional(r, "depth", field.depth, aboveZero());
    r.get("gravity", field.gravity, aboveZero());
    r.require("trains");
    for (JsonReader& t : r.objects("trains")) {
        WaveTrain train;
        t.get("direction", train.direction);
        train.direction.y = 0;
        if (!(glm::length(train.direction) > 0))
            throw Error(t.at("direction"),
                        "expected a direction with a part along x or z: waves travel level");
        t.need("amplitude", train.amplitude, Range::atLeast(0));
        t.need("wavelength", train.wavelength, aboveZero());
        t.get("phase", train.phase);
        const double most = train.wavelength / (2 * std::numbers::pi);
        if (train.amplitude >= most)
            throw Error(t.at("amplitude"),
                        concat("expected less than ", most, " m: crests of ", train.wavelength,
                               " m length would curl over, found ", train.amplitude));
        if (field.depth && train.amplitude >= *field.depth)
            throw Error(t.at("amplitude"), concat("expected less than the depth of ", *field.depth,
                                                  " m, found ", train.amplitude));
        t.finish();
        field.trains.push_back(train);
    }
    constexpr size_t most = 32;
    if (field.trains.empty() || field.trains.size() > most)
        throw Error(r.at("trains"), concat("expected 1 to ", most, " trains, found ", field.trains.size()));
    return field;
}

HurricaneField readHurricane(JsonReader& r) {
    HurricaneField field;
    r.get("origin", field.origin);
    r.get("speed", field.speed);
    r.get("radius", field.radius, aboveZero());
    r.get("shape", field.shape, Range::between(0.5, 3));
    r.get("inflow", field.inflow, Range::between(0, 1.2));
    r.get("height", field.height, aboveZero());
    r.get("coriolis", field.coriolis, Range::between(0, 1));
    return field;
}

GridField readGrid(JsonReader& r) {
    const FileSequence sequence = readFileSequence(r);
    const std::string ending = lowerExtension(sequence.files[0]);
    const std::vector<std::string>& endings = fieldFileEndings();
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
        throw Error(r.at("file"), "expected a vector field as .fga, .vf, .vti or .raw, found \"" +
                                      sequence.files[0] + "\"");
    std::string layout;
    if (ending == ".raw") layout = needFile(r, "layout");

    FieldOptions options;
    int axes = 0, outside = 0;
    r.choose("axes", {"yUp", "zUp", "unreal", "unity"}, axes);
    options.axes = static_cast<FieldAxes>(axes);
    r.get("scale", options.scale, aboveZero());
    getOptional(r, "velocityScale", options.velocityScale, Range::any());
    if (Box bounds; getBox(r, "bounds", bounds)) options.bounds = bounds;
    if (r.get("origin", options.origin) && options.bounds)
        throw Error(r.at("origin"), "\"bounds\" says where the field lies: \"origin\" has no effect");
    r.choose("outside", {"clamp", "wrap"}, outside);
    options.wrap = outside == 1;
    if (ending == ".vti") r.get("array", options.array);

    GridField field;
    field.times = sequence.times;
    field.repeats = sequence.repeats;
    for (const std::string& file : sequence.files) {
        addFrame(field, readFieldFile(file, options, layout), options, file);
        if (field.cells() * sequence.files.size() > size_t(maxFieldCells))
            throw Error(r.at("sequence"), concat(sequence.files.size(), " frames of ", field.cells(),
                                                 " cells are more than the ", maxFieldCells,
                                                 " cells (2^24) that a field may have"));
    }
    return field;
}

FieldShape readShape(JsonReader& r) {
    int type = 0;
    r.require("type");
    r.choose("type",
             {"uniform", "oscillating", "gust", "shear", "vortex", "abc", "taylorGreen", "curlNoise", "grid",
              "waves", "hurricane"},
             type);
    switch (type) {
    case 0:
        return readUniform(r);
    case 1:
        return readOscillating(r);
    case 2:
        return readGust(r);
    case 3:
        return readShear(r);
    case 4:
        return readVortex(r);
    case 5:
        return readAbc(r);
    case 6:
        return readTaylorGreen(r);
    case 7:
        return readCurlNoise(r);
    case 8:
        return readGrid(r);
    case 9:
        return readWaves(r);
    default:
        return readHurricane(r);
    }
}

}  // namespace

std::vector<Field> readFields(JsonReader& scene) {
    std::vector<Field> fields;
    std::vector<std::string> names;
    for (JsonReader& r : scene.objects("fields")) {
        Field field;
        r.get("name", field.name);
        refuseRepeated(r, names, field.name);
        field.shape = readShape(r);
        r.get("weight", field.weight);
        if (Box box; getBox(r, "box", box)) field.box = box;
        r.finish();
        names.push_back(field.name);
        fields.push_back(std::move(field));
    }
    return fields;
}

}  // namespace shoal
