// The bytes of an array in VTK's XML files: base64 or raw, with a header of lengths, in compressed blocks or
// as they are.
//
//   as they are   [bytes] data
//   compressed    [blocks, bytes of a block, bytes of the last (0: whole), compressed bytes of each] blocks
//
// The numbers of the header have 32 or 64 bits. In base64 header and data are streams of their own, each
// padded; some writers make one of both.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/error.h"

namespace shoal {

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
