#include "scene/field_files/field_file.h"

#include "core/describe.h"
#include "core/file.h"
#include "core/where.h"

namespace shoal {

const Description& describe(const RawLayout*) {
    using R = RawLayout;
    static const auto rule = [](const R& layout, const Where& where) {
        countCells(glm::dvec3(layout.resolution), where.locate("resolution"));
    };
    static const Description description =
        Describe<R>("layout", "How the numbers of a .raw vector field lie.")
            .format("shoal-field-1")
            .key("resolution", &R::resolution,
                 {"", "The number of cells along x, y and z, at most 2^24 in all."})
            .needed()
            .box(
                "bounds", &R::bounds,
                {"",
                 "The outer faces of the outer cells, in the file's axes and units; required where the scene "
                 "gives none."})
            .word("encoding", &R::encoding, {"float16", "float32", "float64"},
                  {"", "The type of the numbers."})
            .word("byteOrder", &R::bigEndian, {"little", "big"}, {"", "The order of the bytes of a number."})
            .word("components", &R::planar, {"interleaved", "planar"},
                  {"", "Whether x, y and z of a cell stand together, or all x before all y before all z."})
            .word("order", &R::zFastest, {"xFastest", "zFastest"}, {"", "Which way neighbouring cells lie."})
            .key("skip", &R::skip, {"bytes", "What stands before the first number.", Range::atLeast(0)})
            .rule(rule, R"({"properties": {"resolution": {"items": {"minimum": 1}}}})");
    return description;
}

RawLayout parseRawLayout(const std::string& text, const std::string& file) {
    RawLayout layout;
    describe(&layout).readFile(parseJson(text, file), file, layout);
    return layout;
}

FileGrid parseRaw(const std::string& bytes, const RawLayout& layout, const std::string& file) {
    const Location where{file};
    const Box bounds = layout.bounds.value_or(Box{glm::dvec3(0), glm::dvec3(0)});
    FileGrid grid{layout.resolution, bounds.low, bounds.high, {}};
    const glm::ivec3 size = layout.resolution;
    const size_t cells = countCells(glm::dvec3(size), where);
    const size_t expected = size_t(layout.skip) + 3 * cells * bytesOf(layout.encoding);
    if (bytes.size() != expected)
        throw Error(where, "the layout of ", size.x, " x ", size.y, " x ", size.z, " cells takes ", expected,
                    " bytes, found ", bytes.size());
    grid.values.resize(cells);
    const auto numbers = std::as_bytes(std::span(bytes).subspan(size_t(layout.skip)));
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

FileGrid parseVf(const std::string& bytes, const std::string& file) {
    const Location where{file};
    constexpr size_t headerBytes = 4 + 3 * 2;
    if (bytes.rfind("VF_F", 0) == 0)
        throw Error(where, "holds single numbers (VF_F), expected vectors (VF_V)");
    if (bytes.rfind("VF_V", 0) != 0) throw Error(where, "expected a file that begins with \"VF_V\"");
    if (bytes.size() < headerBytes)
        throw Error(where, "expected a header of ", headerBytes, " bytes, found ", bytes.size());
    RawLayout layout;
    for (int i = 0; i < 3; ++i) {
        const auto byte = [&](int k) { return int(uint8_t(bytes[size_t(4 + 2 * i + k)])); };
        layout.resolution[i] = byte(0) | byte(1) << 8;
    }
    const glm::ivec3 size = layout.resolution;
    const size_t expected = headerBytes + 12 * countCells(glm::dvec3(size), where);
    if (bytes.size() != expected)
        throw Error(where, size.x, " x ", size.y, " x ", size.z, " cells take ", expected, " bytes, found ",
                    bytes.size());
    layout.skip = headerBytes;
    return parseRaw(bytes, layout, file);
}

}  // namespace shoal
