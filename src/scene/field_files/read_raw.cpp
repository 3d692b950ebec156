#include "scene/field_files/read_raw.h"

#include "core/error.h"
#include "core/file.h"
#include "core/json.h"
#include "scene/json/reader.h"

namespace shoal {

RawLayout parseRawLayout(const std::string& text, const std::string& file) {
    const JsonValue root = parseJson(text, file);
    JsonReader r(root, file);
    int format = 0, encoding = 1, order = 0, components = 0, byteOrder = 0;
    r.require("format");
    r.choose("format", {"shoal-field-1"}, format);
    RawLayout layout;
    std::vector<int> resolution;
    r.need("resolution", resolution);
    if (resolution.size() != 3)
        throw Error(r.at("resolution"), concat("expected three numbers, found ", resolution.size()));
    layout.resolution = {resolution[0], resolution[1], resolution[2]};
    countCells(glm::dvec3(layout.resolution), r.at("resolution"));
    if (Box box; getBox(r, "bounds", box)) {
        layout.low = box.low;
        layout.high = box.high;
    }
    r.choose("encoding", {"float16", "float32", "float64"}, encoding);
    r.choose("byteOrder", {"little", "big"}, byteOrder);
    r.choose("components", {"interleaved", "planar"}, components);
    r.choose("order", {"xFastest", "zFastest"}, order);
    int skip = 0;
    r.get("skip", skip, Range::atLeast(0));
    r.finish();
    layout.encoding = static_cast<NumberType>(encoding);
    layout.bigEndian = byteOrder == 1;
    layout.planar = components == 1;
    layout.zFastest = order == 1;
    layout.skip = size_t(skip);
    return layout;
}

RawLayout readRawLayout(const std::string& file) {
    return parseRawLayout(readFile(file), file);
}

FileGrid parseRaw(const std::string& bytes, const RawLayout& layout, const std::string& file) {
    const Location where{file, 0, 0, {}};
    FileGrid grid{layout.resolution, layout.low, layout.high, {}};
    const glm::ivec3 size = layout.resolution;
    const size_t cells = countCells(glm::dvec3(size), where);
    const size_t expected = layout.skip + 3 * cells * bytesOf(layout.encoding);
    if (bytes.size() != expected)
        throw Error(where, concat("the layout of ", size.x, " x ", size.y, " x ", size.z, " cells takes ",
                                  expected, " bytes, found ", bytes.size()));
    grid.values.resize(cells);
    const auto numbers = std::as_bytes(std::span(bytes).subspan(layout.skip));
    if (!layout.planar && !layout.zFastest) {
        takeNumbers(numbers, layout.encoding, layout.bigEndian, asFloats(grid.values));
        return grid;
    }
    std::vector<float> plain(3 * cells);
    takeNumbers(numbers, layout.encoding, layout.bigEndian, plain);
    for (size_t i = 0; i < cells; ++i) {
        size_t cell = i;
        if (layout.zFastest) {
            const size_t z = i % size_t(size.z), y = i / size_t(size.z) % size_t(size.y),
                         x = i / (size_t(size.z) * size_t(size.y));
            cell = x + size_t(size.x) * (y + size_t(size.y) * z);
        }
        for (size_t k = 0; k < 3; ++k)
            grid.values[cell][int(k)] = layout.planar ? plain[k * cells + i] : plain[3 * i + k];
    }
    return grid;
}

FileGrid readRaw(const std::string& file, const RawLayout& layout) {
    return parseRaw(readFile(file), layout, file);
}

}  // namespace shoal
