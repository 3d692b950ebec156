// Vector fields as raw numbers, with a JSON file that says how they lie ("shoal-field-1", docs/exchange.md).
#pragma once

#include <optional>
#include <string>

#include "core/box.h"
#include "scene/field_files/field_file.h"

namespace shoal {

class Description;

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

// Error, located: no such file, not JSON, a key missing or not known, a resolution below 1 or too large.
RawLayout readRawLayout(const std::string& file);
RawLayout parseRawLayout(const std::string& text, const std::string& file);

// Error: no such file, more or fewer bytes than the layout takes.
FileGrid readRaw(const std::string& file, const RawLayout& layout);
FileGrid parseRaw(const std::string& bytes, const RawLayout& layout, const std::string& file);

}  // namespace shoal
