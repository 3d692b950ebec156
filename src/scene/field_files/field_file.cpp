#include "scene/field_files/field_file.h"

#include <algorithm>
#include <cmath>

#include "core/describe.h"
#include "core/file.h"
#include "scene/field_kinds.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

// Finds the axis of the file that each axis of the scene takes, and whether z runs the other way.
struct AxisMap {
    glm::ivec3 source{0, 1, 2};
    bool flipZ = false;

    template <typename V>
    V operator()(const V& v) const {
        V out(v[source.x], v[source.y], v[source.z]);
        if (flipZ) out.z = -out.z;
        return out;
    }
};

AxisMap axisMap(FieldAxes axes) {
    switch (axes) {
    case FieldAxes::yUp:
        return {};
    case FieldAxes::zUp:
        return {{0, 2, 1}, true};
    case FieldAxes::unreal:
        return {{0, 2, 1}, false};
    default:
        return {{0, 1, 2}, true};
    }
}

Box boundsOf(const FileGrid& grid, const AxisMap& map, const GridSource& source, const std::string& file) {
    if (source.bounds) return *source.bounds;
    if (grid.low == grid.high)
        throw Error(Location{file},
                    "this format does not say where the field lies: the scene needs \"bounds\"");
    const glm::dvec3 a = map(grid.low * source.scale) + source.origin;
    const glm::dvec3 b = map(grid.high * source.scale) + source.origin;
    const Box box{glm::min(a, b), glm::max(a, b)};
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(box.low[i]) < largestInFiles && std::abs(box.high[i]) < largestInFiles) ||
            !(box.low[i] < box.high[i]))
            throw Error(Location{file}, "bounds of ", box.low[i], " to ", box.high[i], " m along ",
                        axisNames[i], " after scaling are beyond single precision");
    return box;
}

// Error: another resolution or place than the frames before.
void checkSame(const GridField& field, const glm::ivec3& resolution, const Box& box,
               const std::string& file) {
    const auto triple = [](const auto& v) { return concat(v.x, " x ", v.y, " x ", v.z); };
    if (resolution != field.resolution)
        throw Error(Location{file}, "has ", triple(resolution), " cells, ", field.file,
                    " of the same sequence has ", triple(field.resolution));
    const glm::dvec3 slack = 1e-6 * (field.high - field.low);  // what was written as text
    for (int i = 0; i < 3; ++i)
        if (std::abs(box.low[i] - field.low[i]) > slack[i] ||
            std::abs(box.high[i] - field.high[i]) > slack[i])
            throw Error(Location{file}, "reaches from ", box.low[i], " to ", box.high[i], " m along ",
                        axisNames[i], ", ", field.file, " of the same sequence from ", field.low[i], " to ",
                        field.high[i]);
}

[[noreturn]] void refuseValue(const glm::vec3& value, const glm::ivec3& cell, const std::string& file) {
    const bool finite = std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
    throw Error(Location{file}, "cell (", cell.x, ", ", cell.y, ", ", cell.z, ") holds (", value.x, ", ",
                value.y, ", ", value.z, "), ",
                finite ? "after scaling beyond single precision" : "expected finite numbers");
}

}  // namespace

size_t countCells(const glm::dvec3& resolution, const Location& where) {
    double cells = 1;
    for (int i = 0; i < 3; ++i) {
        if (!(resolution[i] >= 1) || resolution[i] != std::floor(resolution[i]))
            throw Error(where, "expected the resolution along ", axisNames[i],
                        " as a whole number of at least 1, found ", resolution[i]);
        cells *= resolution[i];
    }
    if (cells > double(maxFieldCells))
        throw Error(where, "the resolution makes more than ", maxFieldCells,
                    " cells (2^24), the most that a field may have");
    return size_t(cells);
}

void addFrame(GridField& field, FileGrid&& grid, const std::string& file) {
    const GridSource& source = field.source;
    const AxisMap map = axisMap(source.axes);
    const glm::ivec3 size(grid.resolution[map.source.x], grid.resolution[map.source.y],
                          grid.resolution[map.source.z]);
    const Box box = boundsOf(grid, map, source, file);
    const bool first = field.values.empty();
    if (first) {
        field.file = file;
        field.resolution = size;
        field.low = box.low;
        field.high = box.high;
    } else {
        checkSame(field, size, box, file);
    }
    const double scale = source.velocityScale.value_or(source.scale);
    const size_t before = field.values.size();
    field.values.resize(before + grid.values.size());
    glm::vec3* out = field.values.data() + before;
    const glm::vec3* in = grid.values.data();
    glm::ivec3 c;
    for (c.z = 0; c.z < grid.resolution.z; ++c.z)
        for (c.y = 0; c.y < grid.resolution.y; ++c.y)
            for (c.x = 0; c.x < grid.resolution.x; ++c.x, ++in) {
                const glm::dvec3 scaled = glm::dvec3(*in) * scale;
                if (!(std::abs(scaled.x) < largestInFiles && std::abs(scaled.y) < largestInFiles &&
                      std::abs(scaled.z) < largestInFiles))
                    refuseValue(*in, c, file);
                glm::ivec3 cell(c[map.source.x], c[map.source.y], c[map.source.z]);
                if (map.flipZ) cell.z = size.z - 1 - cell.z;
                out[size_t(cell.x) + size_t(size.x) * (size_t(cell.y) + size_t(size.y) * size_t(cell.z))] =
                    glm::vec3(map(scaled));
            }
}

FileGrid readFieldFile(const std::string& file, const GridSource& source, const std::string& layout) {
    const std::string ending = lowerExtension(file);
    if (ending == ".raw") {
        const RawLayout lie = parseRawLayout(readFile(layout), layout);
        return parseRaw(readFile(file), lie, file);
    }
    const std::string bytes = readFile(file);
    if (ending == ".vf") return parseVf(bytes, file);
    return ending == ".vti" ? parseVti(bytes, file, source.array) : parseFga(bytes, file);
}

// ---- The field "grid" of a scene file

namespace {

void readTimes(JsonReader& r, FileSequence& sequence, void*) {
    r.get("times", sequence.times);
}

// Reads the files.
void load(GridField& field, const Where& where) {
    const GridSource& source = field.source;
    const TimedFiles found = filesOf(source, where);
    const std::string ending = lowerExtension(found.files[0]);
    if (ending != ".fga" && ending != ".vf" && ending != ".vti" && ending != ".raw")
        throw Error(where.locate("file"),
                    "expected a vector field as .fga, .vf, .vti or .raw, found \"" + found.files[0] + "\"");
    std::string layout;
    if (ending == ".raw") {
        where.require("layout");
        layout = needFile(where, "layout", source.layout);
    }
    if (where.given("origin") && source.bounds)
        throw Error(where.locate("origin"), "\"bounds\" says where the field lies: \"origin\" has no effect");
    field.times = found.times;
    field.repeats = source.sequence && source.sequence->repeats;
    for (const std::string& file : found.files) {
        addFrame(field, readFieldFile(file, source, layout), file);
        if (field.cells() * found.files.size() > size_t(maxFieldCells))
            throw Error(where.locate("sequence"), found.files.size(), " frames of ", field.cells(),
                        " cells are more than the ", maxFieldCells, " cells (2^24) that a field may have");
    }
}

void checkGrid(const GridField& grid, const Where& where) {
    countCells(grid.resolution, where.locate("resolution"));
    const size_t frames = std::max<size_t>(1, grid.times.size());
    if (grid.values.size() != grid.cells() * frames)
        throw Error(where.locate("values"), "expected ", grid.cells() * frames, " values, one a cell",
                    frames > 1 ? " and frame" : "", ", found ", grid.values.size());
    checkBox({grid.low, grid.high}, false, where.locate("high"));
    for (const glm::vec3& value : grid.values)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(value[c]) <= largestNumber))
                throw Error(where.locate("values"), "expected finite numbers within single precision");
    if (grid.times.size() == 1) throw Error(where.locate("times"), "expected at least two times, found 1");
    for (size_t i = 1; i < grid.times.size(); ++i)
        checkTimes(grid.times[i - 1], grid.times[i], where.locate("times"));
}

}  // namespace

const Description& describe(const FileSequence*) {
    using F = FileSequence;
    static const auto rule = [](const F& sequence, const Where& where) {
        if (sequence.frameRate && where.given("times"))
            throw Error(where.locate("frameRate"), "expected either \"frameRate\" or \"times\", found both");
    };
    static const Description description =
        Describe<F>("sequence", "Numbered files as frames in time.")
            .key("first", &F::first, {"", "The first number.", Range::atLeast(0)})
            .usually("the lowest in the folder")
            .key("last", &F::last, {"", "The last number.", Range::atLeast(0)})
            .usually("the highest in the folder")
            .key("step", &F::step, {"", "The step between the numbers.", Range::atLeast(1)})
            .key("frameRate", &F::frameRate, {"Hz", "Files a second; required without `times`.", aboveZero()})
            .key("start", &F::start, {"s", "The time of the first file."})
            .only("frameRate", {})
            .byHand("times", {.value = Form::Value::number, .lists = {{.least = 2}}},
                    {"list of numbers, s", "The times of the files, rising, instead of `frameRate`."},
                    readTimes)
            .key("repeats", &F::repeats, {"", "Whether the first file follows the last; else the ends hold."})
            .rule(rule, R"({"oneOf": [{"required": ["frameRate"]}, {"required": ["times"]}]})");
    return description;
}

static const Description& describe(const GridSource*) {
    using F = GridSource;
    static const Description description =
        Describe<F>("source", "Files that a grid is read from.")
            .key("file", &F::file,
                 {"the name of a .fga, .vf, .vti or .raw file",
                  "What holds the velocities; with `sequence` # stand for the number."})
            .needed()
            .notEmpty()
            .key("sequence", &F::sequence, {"", "Numbered files as frames in time."})
            .key("layout", &F::layout,
                 {"the name of a JSON file",
                  "How the numbers of a .raw file lie; required there, and only there."})
            .key("array", &F::array, {"", "The data array of a .vti file."})
            .box("bounds", &F::bounds,
                 {"m", "Where the grid lies in the scene's axes; required of .vf, which does not say."})
            .word("axes", &F::axes, {"yUp", "zUp", "unreal", "unity"},
                  {"", "The axes in which the file was written."})
            .key("scale", &F::scale,
                 {"m", "Metres a unit of the file, for bounds and velocities.", aboveZero()})
            .key("velocityScale", &F::velocityScale,
                 {"m/s", "Metres a second a unit of the file's velocities."})
            .usually("as `scale`")
            .key("origin", &F::origin, {"m", "What is added to the file's bounds."});
    return description;
}

const Description& describe(const GridField*) {
    static const Description description =
        Describe<GridField>("grid",
                            "Velocities from a file or from numbered files, trilinear between cell centres.")
            .keysOf(&GridField::source)
            .word("outside", &GridField::wrap, {"clamp", "wrap"},
                  {"", "What is beyond the bounds: the border's value, or the grid again."})
            .derive(load)
            .rule(checkGrid);
    return description;
}

}  // namespace shoal
