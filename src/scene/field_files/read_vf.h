// Vector fields as .vf (Unity's Visual Effect Graph; the format is described at
// github.com/peeweek/VectorFieldFile): "VF_V", the resolution as three 16-bit numbers, then x, y, z of each
// cell as 32-bit floats, x fastest, then y, then z; all little-endian. The file does not say where the field
// lies.
#pragma once

#include <string>

#include "scene/field_files/field_file.h"

namespace shoal {

// Error: no such file, not this format, "VF_F" (numbers that are not vectors), a resolution of 0 or too
// large, more or fewer bytes than that takes.
FileGrid readVf(const std::string& file);
FileGrid parseVf(const std::string& bytes, const std::string& file);

}  // namespace shoal
