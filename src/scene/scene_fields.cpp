// "fields": what moves the fluid.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/file.h"
#include "scene/field_file.h"
#include "scene/file_sequence.h"
#include "scene/scene_reader.h"

namespace shoal {

template <typename V>
static void members(V&& v, Either<UniformField> auto& field) {
    v.number("velocity", field.velocity);
}

template <typename V>
static void members(V&& v, Either<OscillatingField> auto& field) {
    v.number("velocity", field.velocity);
    v.number("frequency", field.frequency, Range::atLeast(0));
    v.number("phase", field.phase);
}

template <typename V>
static void members(V&& v, Either<GustField> auto& field) {
    v.direction("direction", field.direction);
    v.number("speed", field.speed);
    v.number("strength", field.strength, Range::atLeast(0));
    v.number("length", field.length, aboveZero());
    v.number("width", field.width, aboveZero());
    v.number("frontSpeed", field.frontSpeed);
}

template <typename V>
static void members(V&& v, Either<ShearField> auto& field) {
    v.number("origin", field.origin);
    v.number("velocity", field.velocity);
}

template <typename V>
static void members(V&& v, Either<VortexField> auto& field) {
    v.number("origin", field.origin);
    v.direction("axis", field.axis);
    v.number("speed", field.speed);
    v.number("radius", field.radius, aboveZero());
    v.number("lift", field.lift);
}

template <typename V>
static void members(V&& v, Either<AbcField> auto& field) {
    v.number("origin", field.origin);
    v.number("a", field.a);
    v.number("b", field.b);
    v.number("c", field.c);
    v.number("wavelength", field.wavelength, aboveZero());
}

template <typename V>
static void members(V&& v, Either<TaylorGreenField> auto& field) {
    v.number("origin", field.origin);
    v.number("speed", field.speed);
    v.number("wavelength", field.wavelength, aboveZero());
}

template <typename V>
static void members(V&& v, Either<CurlNoiseField> auto& field) {
    v.number("speed", field.speed, Range::atLeast(0));
    v.number("length", field.length, aboveZero());
    v.number("period", field.period, aboveZero());
    v.number("octaves", field.octaves, Range::between(1, 4));
}

template <typename V>
static void members(V&& v, Either<WaveTrain> auto& train) {
    v.number("direction", train.direction);
    v.number("amplitude", train.amplitude, Range::atLeast(0));
    v.number("wavelength", train.wavelength, aboveZero());
    v.number("phase", train.phase);
}

template <typename V>
static void members(V&& v, Either<WavesField> auto& field) {
    v.number("origin", field.origin);
    v.number("depth", field.depth, aboveZero());
    v.number("gravity", field.gravity, aboveZero());
}

template <typename V>
static void members(V&& v, Either<HurricaneField> auto& field) {
    v.number("origin", field.origin);
    v.number("speed", field.speed);
    v.number("radius", field.radius, aboveZero());
    v.number("shape", field.shape, Range::between(0.5, 3));
    v.number("inflow", field.inflow, Range::between(0, 1.2));
    v.number("height", field.height, aboveZero());
    v.number("coriolis", field.coriolis, Range::between(0, 1));
}

template <typename V>
static void members(V&& v, Either<Field> auto& field) {
    v.number("weight", field.weight);
    v.box("box", field.box);
}

namespace {

uint32_t getSeed(JsonReader& r) {
    uint64_t seed = 0;
    if (r.get("seed", seed) && seed > 0xFFFFFFFFu)
        throw Error(r.at("seed"), "expected a seed of at most 4294967295 (32 bits)");
    return static_cast<uint32_t>(seed);
}

template <typename Noise>
Noise readSeeded(JsonReader& r) {
    Noise field = readMembers<Noise>(r);
    field.seed = getSeed(r);
    return field;
}

ShearField readShear(JsonReader& r) {
    ShearField field = readMembers<ShearField>(r, {"gradient"});
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

void checkTrain(const WaveTrain& train, const WavesField& field, const Where& where) {
    if (train.direction.x == 0 && train.direction.z == 0)
        throw Error(where.at("direction"),
                    "expected a direction with a part along x or z: waves travel level");
    const double most = train.wavelength / (2 * std::numbers::pi);
    if (train.amplitude >= most)
        throw Error(where.at("amplitude"),
                    concat("expected less than ", most, " m: crests of ", train.wavelength,
                           " m length would curl over, found ", train.amplitude));
    if (field.depth && train.amplitude >= *field.depth)
        throw Error(where.at("amplitude"),
                    concat("expected less than the depth of ", *field.depth, " m, found ", train.amplitude));
}

void checkTrainCount(size_t count, const Where& where) {
    constexpr size_t most = 32;
    if (count == 0 || count > most)
        throw Error(where.at("trains"), concat("expected 1 to ", most, " trains, found ", count));
}

WavesField readWaves(JsonReader& r) {
    WavesField field = readMembers<WavesField>(r, {"trains"});
    for (JsonReader& t : r.objects("trains")) {
        WaveTrain train = readMembers<WaveTrain>(t, {"amplitude", "wavelength"});
        train.direction.y = 0;
        checkTrain(train, field, t);
        t.finish();
        field.trains.push_back(train);
    }
    checkTrainCount(field.trains.size(), r);
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
        return readMembers<UniformField>(r, {"velocity"});
    case 1:
        return readMembers<OscillatingField>(r, {"velocity", "frequency"});
    case 2:
        return readSeeded<GustField>(r);
    case 3:
        return readShear(r);
    case 4:
        return readMembers<VortexField>(r);
    case 5:
        return readMembers<AbcField>(r);
    case 6:
        return readMembers<TaylorGreenField>(r);
    case 7:
        return readSeeded<CurlNoiseField>(r);
    case 8:
        return readGrid(r);
    case 9:
        return readWaves(r);
    default:
        return readMembers<HurricaneField>(r);
    }
}

// What a shape has besides its numbers.
template <typename Shape>
void checkShape(const Shape& shape, const Where& where) {
    members(CheckScene(where), shape);
    if constexpr (std::is_same_v<Shape, ShearField>)
        for (int column = 0; column < 3; ++column)
            CheckScene(where).number("gradient", shape.gradient[column]);
    if constexpr (std::is_same_v<Shape, WavesField>) {
        checkTrainCount(shape.trains.size(), where);
        for (size_t i = 0; i < shape.trains.size(); ++i) {
            const Where train = where.in("trains", i);
            members(CheckScene(train), shape.trains[i]);
            checkTrain(shape.trains[i], shape, train);
        }
    }
}

void checkGrid(const GridField& grid, const Where& where) {
    countCells(grid.resolution, where.at("resolution"));
    const size_t frames = std::max<size_t>(1, grid.times.size());
    if (grid.values.size() != grid.cells() * frames)
        throw Error(where.at("values"),
                    concat("expected ", grid.cells() * frames, " values, one a cell",
                           frames > 1 ? " and frame" : "", ", found ", grid.values.size()));
    checkBox({grid.low, grid.high}, false, where.at("high"));
    for (const glm::vec3& value : grid.values)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(value[c]) <= largestNumber))
                throw Error(where.at("values"), "expected finite numbers within single precision");
    if (grid.times.size() == 1) throw Error(where.at("times"), "expected at least two times, found 1");
    for (size_t i = 1; i < grid.times.size(); ++i)
        checkTimes(grid.times[i - 1], grid.times[i], where.at("times"));
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
        members(ReadScene(r), field);
        r.finish();
        names.push_back(field.name);
        fields.push_back(std::move(field));
    }
    return fields;
}

void checkFields(const std::vector<Field>& fields) {
    const Where whole;
    std::vector<std::string> names;
    for (size_t i = 0; i < fields.size(); ++i) {
        const Where where = whole.in("fields", i);
        refuseRepeated(where, names, fields[i].name);
        names.push_back(fields[i].name);
        members(CheckScene(where), fields[i]);
        std::visit(
            [&](const auto& shape) {
                if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, GridField>)
                    checkGrid(shape, where);
                else
                    checkShape(shape, where);
            },
            fields[i].shape);
    }
}

}  // namespace shoal
