// Vector fields as .vti (VTK's ImageData as XML; "VTK File Formats", section "XML File Formats"): one array
// of three components, of points or of cells, as text, as base64 within the file, or appended as base64 or
// raw; little- or big-endian, lengths of 32 or 64 bits, as they are or compressed by zlib.
//
// Points become the centres of cells, so that the field reaches half a cell beyond them; cells stay cells.
#pragma once

#include <string>

#include "scene/field_files/field_file.h"

namespace shoal {

// `array`: its name; empty: the active vectors, or the only array of three components.
// Error, located: no such file, not XML, not one whole ImageData, no such array, several and none chosen,
// another number of components or kind of number, a compression other than zlib's, fewer or more data than
// the extent takes, an extent that is empty or too large, a spacing of 0, a direction that is not along the
// axes.
FileGrid readVti(const std::string& file, const std::string& array = {});
FileGrid parseVti(const std::string& text, const std::string& file, const std::string& array = {});

}  // namespace shoal
