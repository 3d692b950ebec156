// Grids of velocities from files of other programs: the formats (read_*.cpp), what they share, and numbered
// files (file_sequence.cpp).
//
//   a file  ->  FileGrid (its own axes and units)  ->  addFrame: GridField (the scene's)
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/field_kinds.h"

namespace shoal {

class Description;
class Where;

inline constexpr const char* axisNames[] = {"x", "y", "z"};
inline constexpr double largestInFiles = 1e30;  // squares of larger numbers overflow in single precision

// A field holds at most this many cells, those of all frames together.
inline constexpr long long maxFieldCells = 1ll << 24;

// Holds the contents of a file, in its own axes and units.
struct FileGrid {
    glm::ivec3 resolution{0};
    glm::dvec3 low{0}, high{0};     // outer faces of the outer cells; both 0 where the file has none
    std::vector<glm::vec3> values;  // x fastest, then y, then z; not checked yet
};

// The number of cells. Error at `where`: a resolution below 1, or more cells than a field may have.
size_t countCells(const glm::dvec3& resolution, const Location& where);

// Turns the grid into the scene's axes and units, by the field's source, and appends it to the field; the
// first decides resolution and bounds. Error, located in the file: no bounds where the source has none,
// bounds or velocities beyond single precision, a value that is not a number, another resolution or place
// than the first frame's.
void addFrame(GridField& field, FileGrid&& grid, const std::string& file);

// ---- Numbers in files: as text, as bytes, and as the bytes of VTK's arrays (numbers.cpp)

// Takes numbers off text, separated by white space or commas, and knows where it is.
class NumberScanner {
  public:
    // All of the text; a byte order mark is skipped.
    NumberScanner(const std::string& text, const std::string& file);
    // A part of it, as text whose lines count from its beginning.
    NumberScanner(const std::string& text, size_t begin, size_t end, const std::string& file);

    // False at the end. A number is followed by a comma, white space or the end.
    // Error, located: not a number, not finite, beyond the range of doubles.
    bool next(double& out);

    // Returns the location of the number taken last, or of the end.
    Location here() const { return {*file_, beginLine_, static_cast<int>(begin_ - beginLineStart_) + 1, {}}; }

  private:
    void skipSpace();
    double convert(size_t begin, size_t end) const;
    std::string quoted(size_t begin, size_t end) const;

    const std::string* text_;
    const std::string* file_;
    size_t position_ = 0, lineStart_ = 0, end_ = 0;
    int line_ = 1;
    size_t begin_ = 0, beginLineStart_ = 0;
    int beginLine_ = 1;
};

// Numbers as bytes.
enum class NumberType { float16, float32, float64, int8, uint8, int16, uint16, int32, uint32, int64, uint64 };
size_t bytesOf(NumberType type);
// `out[i]` from the i-th number; as many as `out` has, which the bytes must hold.
void takeNumbers(std::span<const std::byte> bytes, NumberType type, bool bigEndian, std::span<float> out);

// How an array of VTK's XML files is written: base64 or raw, with a header of lengths, in compressed blocks
// or as it is.
//
//   as they are   [bytes] data
//   compressed    [blocks, bytes of a block, bytes of the last (0: whole), compressed bytes of each] blocks
//
// The numbers of the header have 32 or 64 bits. In base64 header and data are streams of their own, each
// padded; some writers make one of both.
struct VtkEncoding {
    bool bigEndian = false;
    bool longHeader = false;  // 64 bits
    bool zlib = false;
    bool base64 = false;
};

// The `expected` bytes of the array that begins at `begin` in the text and lies before `end`.
// Error at `where`: the data end too early, hold another number of bytes, or are not base64 or zlib's.
std::vector<std::byte> vtkBytes(const std::string& text, size_t begin, size_t end,
                                const VtkEncoding& encoding, size_t expected, const Location& where);

// As floats, three a cell.
inline std::span<float> asFloats(std::vector<glm::vec3>& values) {
    return {values.empty() ? nullptr : &values[0].x, 3 * values.size()};
}
// The velocities of so many cells. Error, located: the numbers end before, or one is beyond single precision.
std::vector<glm::vec3> takeVelocities(NumberScanner& numbers, size_t cells);

// ---- The formats

// Vector fields as .fga text (Unreal, PopcornFX): comma-separated numbers, namely the resolution x, y, z,
// the bounds' low x, y, z and high x, y, z, then one velocity x, y, z per cell, x fastest, then y, then z.
//
// Errors name line and column: something that is not a finite number, a resolution that is not a positive
// whole number or too large, low bounds that are not below the high ones, a wrong count.
FileGrid parseFga(const std::string& text, const std::string& file);

// Vector fields as .vf (Unity's Visual Effect Graph; the format is described at
// github.com/peeweek/VectorFieldFile): "VF_V", the resolution as three 16-bit numbers, then x, y, z of each
// cell as 32-bit floats, x fastest, then y, then z; all little-endian. The file does not say where the field
// lies.
//
// Error: not this format, "VF_F" (numbers that are not vectors), a resolution of 0 or too large, more or
// fewer bytes than that takes.
FileGrid parseVf(const std::string& bytes, const std::string& file);

// Vector fields as .vti (VTK's ImageData as XML; "VTK File Formats", section "XML File Formats"): one array
// of three components, of points or of cells, as text, as base64 within the file, or appended as base64 or
// raw; little- or big-endian, lengths of 32 or 64 bits, as they are or compressed by zlib.
//
// Points become the centres of cells, so that the field reaches half a cell beyond them; cells stay cells.
//
// `array`: its name; empty: the active vectors, or the only array of three components.
// Error, located: not XML, not one whole ImageData, no such array, several and none chosen, another number of
// components or kind of number, a compression other than zlib's, fewer or more data than the extent takes, an
// extent that is empty or too large, a spacing of 0, a direction that is not along the axes.
FileGrid parseVti(const std::string& text, const std::string& file, const std::string& array = {});

// Vector fields as raw numbers, with a JSON file that says how they lie ("shoal-field-1", docs/exchange.md).
struct RawLayout {
    glm::ivec3 resolution{0};
    std::optional<Box> bounds;
    NumberType encoding = NumberType::float32;
    bool bigEndian = false;
    bool planar = false;    // all x, then all y, then all z; else x, y, z of each cell
    bool zFastest = false;  // cells: z fastest, then y, then x
    int skip = 0;           // bytes before the first number
};

const Description& describe(const RawLayout*);

// Error, located: not JSON, a key missing or not known, a resolution below 1 or too large.
RawLayout parseRawLayout(const std::string& text, const std::string& file);

// Error: more or fewer bytes than the layout takes.
FileGrid parseRaw(const std::string& bytes, const RawLayout& layout, const std::string& file);

// Any of the formats by the name's ending (.fga, .vf, .vti, .raw); `layout`: of .raw, the file that describes
// it. Error, located: no such file, an ending that is none of these, and what each format refuses.
FileGrid readFieldFile(const std::string& file, const GridSource& source, const std::string& layout = {});

// Numbered files: "wind-####.vti" with first, last and step stands for wind-0000.vti, wind-0001.vti, ...
// The files of a source, with their times (s; none of a single file). Error, located: no such file, a number
// missing in between, a pattern without "sequence" or the other way round, fewer than two files, times that
// do not rise or are not one a file.
struct TimedFiles {
    std::vector<std::string> files;
    std::vector<double> times;
};
TimedFiles filesOf(const GridSource& source, const Where& where);

// The files that are there of a name with # for the number, in its order; none where it is no such name.
std::vector<std::string> numberedFiles(const std::filesystem::path& path);
// Error: a frame that does not come after the one before.
void checkTimes(double before, double time, const Location& where);

}  // namespace shoal
