// "fields": what moves the fluid.

#include "core/file.h"
#include "scene/read_fga.h"
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

GridField readGrid(JsonReader& r) {
    const std::string file = needFile(r, "file");
    if (lowerExtension(file) != ".fga")
        throw Error(r.at("file"), "expected a vector field as .fga, found \"" + file + "\"");

    FgaOptions options;
    int axes = 0;
    r.choose("axes", {"yUp", "zUp", "unreal"}, axes);
    options.axes = static_cast<FieldAxes>(axes);
    r.get("scale", options.scale, aboveZero());
    getOptional(r, "velocityScale", options.velocityScale, Range::any());
    r.get("origin", options.origin);
    int outside = 0;
    r.choose("outside", {"clamp", "wrap"}, outside);
    options.wrap = outside == 1;
    return readFga(file, options);
}

FieldShape readShape(JsonReader& r) {
    int type = 0;
    r.require("type");
    r.choose("type",
             {"uniform", "oscillating", "gust", "shear", "vortex", "abc", "taylorGreen", "curlNoise", "grid"},
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
    default:
        return readGrid(r);
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
