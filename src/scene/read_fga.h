// Vector fields as .fga text (Unreal, PopcornFX): comma-separated numbers, namely the resolution x, y, z,
// the bounds' low x, y, z and high x, y, z, then one velocity x, y, z per cell, x fastest, then y, then z.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace shoal {

// The axes that the file was written in, and how they become the scene's (right-handed, +Y up).
enum class FieldAxes {
    yUp,     // as they are
    zUp,     // right-handed, +Z up: (x, y, z) -> (x, z, -y)
    unreal,  // left-handed, +Z up: (x, y, z) -> (x, z, y)
};

struct FgaOptions {
    FieldAxes axes = FieldAxes::yUp;
    double scale = 1;                          // m per unit of the file, for bounds and velocities
    std::optional<double> velocityScale = {};  // m/s per unit of the file, instead of `scale`
    glm::dvec3 origin{0};                      // m, added to the bounds in the scene's axes
    bool wrap = false;
};

// A grid holds at most this many cells.
inline constexpr long long maxFieldCells = 1ll << 24;

// Errors name line and column: no such file, something that is not a finite number, a resolution that is
// not a positive whole number or too large, low bounds that are not below the high ones, a wrong count.
GridField readFga(const std::string& file, const FgaOptions& options = {});
GridField parseFga(const std::string& text, const std::string& file, const FgaOptions& options = {});

}  // namespace shoal
