// Numbers in files: as text, as bytes, and as the bytes of VTK's arrays (vtk_data.cpp).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"

namespace shoal {

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
enum class NumberType { float16, float32, float64 };
inline size_t bytesOf(NumberType type) {
    return type == NumberType::float16 ? 2 : type == NumberType::float32 ? 4 : 8;
}
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

}  // namespace shoal
