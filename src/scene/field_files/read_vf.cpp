#include "scene/field_files/field_file.h"

namespace shoal {

FileGrid parseVf(const std::string& bytes, const std::string& file) {
    const Location where{file};
    constexpr size_t headerBytes = 4 + 3 * 2;
    if (bytes.rfind("VF_F", 0) == 0)
        throw Error(where, "holds single numbers (VF_F), expected vectors (VF_V)");
    if (bytes.rfind("VF_V", 0) != 0) throw Error(where, "expected a file that begins with \"VF_V\"");
    if (bytes.size() < headerBytes)
        throw Error(where, concat("expected a header of ", headerBytes, " bytes, found ", bytes.size()));
    FileGrid grid;
    for (int i = 0; i < 3; ++i) {
        const auto byte = [&](int k) { return int(uint8_t(bytes[size_t(4 + 2 * i + k)])); };
        grid.resolution[i] = byte(0) | byte(1) << 8;
    }
    const size_t cells = countCells(glm::dvec3(grid.resolution), where);
    const size_t expected = headerBytes + 12 * cells;
    if (bytes.size() != expected)
        throw Error(where, concat(grid.resolution.x, " x ", grid.resolution.y, " x ", grid.resolution.z,
                                  " cells take ", expected, " bytes, found ", bytes.size()));
    grid.values.resize(cells);
    takeNumbers(std::as_bytes(std::span(bytes).subspan(headerBytes)), NumberType::float32, false,
                asFloats(grid.values));
    return grid;
}

}  // namespace shoal
