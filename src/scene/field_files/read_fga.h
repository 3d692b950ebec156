// Vector fields as .fga text (Unreal, PopcornFX): comma-separated numbers, namely the resolution x, y, z,
// the bounds' low x, y, z and high x, y, z, then one velocity x, y, z per cell, x fastest, then y, then z.
#pragma once

#include <string>

#include "scene/field_files/field_file.h"

namespace shoal {

// Errors name line and column: no such file, something that is not a finite number, a resolution that is
// not a positive whole number or too large, low bounds that are not below the high ones, a wrong count.
FileGrid readFga(const std::string& file);
FileGrid parseFga(const std::string& text, const std::string& file);

}  // namespace shoal
