// Grids of velocities from files of other programs: what all formats share.
//
//   a file  ->  FileGrid (its own axes and units)  ->  addFrame: GridField (the scene's)
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/field.h"

namespace shoal {

// A field holds at most this many cells, those of all frames together.
inline constexpr long long maxFieldCells = 1ll << 24;

// The axes that the file was written in, and how they become the scene's (right-handed, +Y up).
enum class FieldAxes {
    yUp,     // as they are
    zUp,     // right-handed, +Z up: (x, y, z) -> (x, z, -y)
    unreal,  // left-handed, +Z up: (x, y, z) -> (x, z, y)
    unity,   // left-handed, +Y up: (x, y, z) -> (x, y, -z)
};

struct FieldOptions {
    FieldAxes axes = FieldAxes::yUp;
    double scale = 1;                          // m per unit of the file, for bounds and velocities
    std::optional<double> velocityScale = {};  // m/s per unit of the file, instead of `scale`
    glm::dvec3 origin{0};                      // m, added to the bounds in the scene's axes
    std::optional<Box> bounds = {};            // m, in the scene's axes, instead of the file's
    bool wrap = false;
    std::string array = {};  // .vti: the name of the data array; empty: the one that there is
};

// Holds the contents of a file, in its own axes and units.
struct FileGrid {
    glm::ivec3 resolution{0};
    glm::dvec3 low{0}, high{0};     // outer faces of the outer cells; both 0 where the file has none
    std::vector<glm::vec3> values;  // x fastest, then y, then z; not checked yet
};

// The number of cells. Error at `where`: a resolution below 1, or more cells than a field may have.
size_t countCells(const glm::dvec3& resolution, const Location& where);

// Turns the grid into the scene's axes and units and appends it to the field; the first decides resolution
// and bounds. Error, located in the file: no bounds where `options` has none, bounds or velocities beyond
// single precision, a value that is not a number, another resolution or place than the first frame's.
void addFrame(GridField& field, FileGrid&& grid, const FieldOptions& options, const std::string& file);

// Numbers as bytes.
enum class NumberType { float16, float32, float64 };
inline size_t bytesOf(NumberType type) {
    return type == NumberType::float16 ? 2 : type == NumberType::float32 ? 4 : 8;
}
// `out[i]` from the i-th number; as many as `out` has, which the bytes must hold.
void takeNumbers(std::span<const std::byte> bytes, NumberType type, bool bigEndian, std::span<float> out);

// As floats, three a cell.
inline std::span<float> asFloats(std::vector<glm::vec3>& values) {
    return {values.empty() ? nullptr : &values[0].x, 3 * values.size()};
}

// Any of the formats by the name's ending (.fga, .vf, .vti, .raw); `layout`: of .raw, the file that describes
// it. Error, located: no such file, an ending that is none of these, and what each format refuses.
FileGrid readFieldFile(const std::string& file, const FieldOptions& options, const std::string& layout = {});
const std::vector<std::string>& fieldFileEndings();

}  // namespace shoal
