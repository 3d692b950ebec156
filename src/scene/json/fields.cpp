// "fields": what moves the fluid.

#include <algorithm>
#include <cmath>

#include "core/description.h"
#include "core/file.h"
#include "scene/field_files/field_file.h"
#include "scene/field_files/file_sequence.h"
#include "scene/json/reader.h"

namespace shoal {

namespace {

// All keys of a grid.
void readGrid(JsonReader& r, GridField& field, void*) {
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

    field.times = sequence.times;
    field.repeats = sequence.repeats;
    for (const std::string& file : sequence.files) {
        addFrame(field, readFieldFile(file, options, layout), options, file);
        if (field.cells() * sequence.files.size() > size_t(maxFieldCells))
            throw Error(r.at("sequence"), concat(sequence.files.size(), " frames of ", field.cells(),
                                                 " cells are more than the ", maxFieldCells,
                                                 " cells (2^24) that a field may have"));
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

const Description& describe(const GridField*) {
    static const Description it =
        Describe<GridField>("grid",
                            "Velocities from a file or from numbered files, trilinear between cell centres.")
            .byHand("file", R"({"type": "string", "minLength": 1})",
                    {"the name of a .fga, .vf, .vti or .raw file",
                     "What holds the velocities; with \"sequence\" # stand for the number."},
                    readGrid)
            .needed()
            .told("sequence", R"({
                    "type": "object", "additionalProperties": false,
                    "oneOf": [{"required": ["frameRate"]}, {"required": ["times"]}],
                    "properties": {
                      "comment": {"$ref": "#/$defs/comment"},
                      "first": {"description": "The first number; without it the lowest in the folder.",
                                "type": "integer", "minimum": 0},
                      "last": {"description": "The last number; without it the highest in the folder.",
                               "type": "integer", "minimum": 0},
                      "step": {"description": "The step between the numbers.", "type": "integer", "minimum": 1,
                               "default": 1},
                      "frameRate": {"description": "Files a second.", "type": "number", "minimum": 1e-9},
                      "start": {"description": "The time of the first file, with frameRate. [s]", "type": "number",
                                "default": 0},
                      "times": {"description": "The times of the files, rising. [s]", "type": "array",
                                "items": {"type": "number"}, "minItems": 2},
                      "repeats": {"description": "Whether the first file follows the last; else the ends hold.",
                                  "type": "boolean", "default": false}}})",
                  {"object", "Numbered files as frames in time."})
            .told("layout", R"({"type": "string", "minLength": 1})",
                  {"the name of a JSON file",
                   "How the numbers of a .raw file lie; required there, and only there."})
            .told("array", R"({"type": "string"})", {"string", "The data array of a .vti file."})
            .told("bounds", R"({"$ref": "#/$defs/box"})",
                  {"box, m", "Where the grid lies in the scene's axes; required of .vf, which does not say."})
            .told("axes", R"({"enum": ["yUp", "zUp", "unreal", "unity"], "default": "yUp"})",
                  {"`\"yUp\"`, `\"zUp\"`, `\"unreal\"`, `\"unity\"`",
                   "The axes in which the file was written."})
            .told("scale", R"({"type": "number", "minimum": 1e-9, "default": 1})",
                  {"number above 0", "Metres a unit of the file, for bounds and velocities."})
            .told("velocityScale", R"({"type": "number"})",
                  {"number", "Metres a second a unit of the file's velocities; as `scale` without it."})
            .told("origin", R"({"$ref": "#/$defs/vector", "default": [0, 0, 0]})",
                  {"[x, y, z], m", "What is added to the file's bounds."})
            .told("outside", R"({"enum": ["clamp", "wrap"], "default": "clamp"})",
                  {"`\"clamp\"`, `\"wrap\"`",
                   "What is beyond the bounds: the border's value, or the grid again."})
            .rule(checkGrid);
    return it;
}

}  // namespace shoal
