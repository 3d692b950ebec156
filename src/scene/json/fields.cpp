// "fields": what moves the fluid.

#include <algorithm>
#include <cmath>

#include "core/describe.h"
#include "core/file.h"
#include "scene/field_files/field_file.h"
#include "scene/field_kinds.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

void readTimes(JsonReader& r, FileSequence& sequence, void*) {
    r.get("times", sequence.times);
}

// Reads the files.
void load(GridField& field, const Where& where) {
    const GridSource& source = field.source;
    const TimedFiles found = filesOf(source, where);
    const std::string ending = lowerExtension(found.files[0]);
    const std::vector<std::string>& endings = fieldFileEndings();
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
        throw Error(where.at("file"),
                    "expected a vector field as .fga, .vf, .vti or .raw, found \"" + found.files[0] + "\"");
    std::string layout;
    if (ending == ".raw") {
        where.require("layout");
        layout = needFile(where, "layout", source.layout);
    }
    if (where.given("origin") && source.bounds)
        throw Error(where.at("origin"), "\"bounds\" says where the field lies: \"origin\" has no effect");
    field.times = found.times;
    field.repeats = source.sequence && source.sequence->repeats;
    for (const std::string& file : found.files) {
        addFrame(field, readFieldFile(file, source, layout), file);
        if (field.cells() * found.files.size() > size_t(maxFieldCells))
            throw Error(where.at("sequence"),
                        concat(found.files.size(), " frames of ", field.cells(), " cells are more than the ",
                               maxFieldCells, " cells (2^24) that a field may have"));
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

const Description& describe(const FileSequence*) {
    using F = FileSequence;
    static const auto rule = [](const F& sequence, const Where& where) {
        if (sequence.frameRate && where.given("times"))
            throw Error(where.at("frameRate"), "expected either \"frameRate\" or \"times\", found both");
    };
    static const Description it =
        Describe<F>("sequence", "Numbered files as frames in time.")
            .key("first", &F::first, {"", "The first number.", Range::atLeast(0)})
            .usually("the lowest in the folder")
            .key("last", &F::last, {"", "The last number.", Range::atLeast(0)})
            .usually("the highest in the folder")
            .key("step", &F::step, {"", "The step between the numbers.", Range::atLeast(1)})
            .key("frameRate", &F::frameRate, {"Hz", "Files a second; required without `times`.", aboveZero()})
            .key("start", &F::start, {"s", "The time of the first file."})
            .only("frameRate", {}, "is with a \"frameRate\"")
            .byHand("times", R"({"type": "array", "items": {"type": "number"}, "minItems": 2})",
                    {"list of numbers, s", "The times of the files, rising, instead of `frameRate`."},
                    readTimes)
            .key("repeats", &F::repeats, {"", "Whether the first file follows the last; else the ends hold."})
            .rule(rule, R"({"oneOf": [{"required": ["frameRate"]}, {"required": ["times"]}]})");
    return it;
}

static const Description& describe(const GridSource*) {
    using F = GridSource;
    static const Description it =
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
    return it;
}

const Description& describe(const GridField*) {
    static const Description it =
        Describe<GridField>("grid",
                            "Velocities from a file or from numbered files, trilinear between cell centres.")
            .keysOf(&GridField::source)
            .word("outside", &GridField::wrap, {"clamp", "wrap"},
                  {"", "What is beyond the bounds: the border's value, or the grid again."})
            .derive(load)
            .rule(checkGrid);
    return it;
}

}  // namespace shoal
