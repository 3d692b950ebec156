// Scene files: strict JSON, format "shoal-scene-1", described by
// models/scene.schema.json. Keys are named like the members of the structs in scene.h; anything left out
// keeps the struct's default. File names inside are relative to the scene file's folder.
#pragma once

#include <string>

#include "scene/scene.h"

namespace shoal {

// Reads a scene with its molecules, models and fields. Every mistake is one Error with file, line, column
// and JSON path; a mistake inside a file that the scene names is reported at that file.
Scene readScene(const std::string& file);
Scene parseScene(const std::string& text, const std::string& file);

// A group holds at most this many molecules: single precision counts them one by one no further.
inline constexpr int maxGroupCount = 1 << 24;

}  // namespace shoal
