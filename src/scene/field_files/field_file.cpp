#include "scene/field_files/field_file.h"

#include <cmath>

#include "core/file.h"

namespace shoal {

namespace {

// Which of the file's axes each scene axis takes, and whether z runs the other way.
struct AxisMap {
    glm::ivec3 source{0, 1, 2};
    bool flipZ = false;

    template <typename V>
    V operator()(const V& v) const {
        V out(v[source.x], v[source.y], v[source.z]);
        if (flipZ) out.z = -out.z;
        return out;
    }
};

AxisMap axisMap(FieldAxes axes) {
    switch (axes) {
    case FieldAxes::yUp:
        return {};
    case FieldAxes::zUp:
        return {{0, 2, 1}, true};
    case FieldAxes::unreal:
        return {{0, 2, 1}, false};
    default:
        return {{0, 1, 2}, true};
    }
}

Box boundsOf(const FileGrid& grid, const AxisMap& map, const GridSource& source, const std::string& file) {
    if (source.bounds) return *source.bounds;
    if (grid.low == grid.high)
        throw Error(Location{file},
                    "this format does not say where the field lies: the scene needs \"bounds\"");
    const glm::dvec3 a = map(grid.low * source.scale) + source.origin;
    const glm::dvec3 b = map(grid.high * source.scale) + source.origin;
    const Box box{glm::min(a, b), glm::max(a, b)};
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(box.low[i]) < largestInFiles && std::abs(box.high[i]) < largestInFiles) ||
            !(box.low[i] < box.high[i]))
            throw Error(Location{file}, concat("bounds of ", box.low[i], " to ", box.high[i], " m along ",
                                               axisNames[i], " after scaling are beyond single precision"));
    return box;
}

// Error: another resolution or place than the frames before.
void checkSame(const GridField& field, const glm::ivec3& resolution, const Box& box,
               const std::string& file) {
    const auto triple = [](const auto& v) { return concat(v.x, " x ", v.y, " x ", v.z); };
    if (resolution != field.resolution)
        throw Error(Location{file}, concat("has ", triple(resolution), " cells, ", field.file,
                                           " of the same sequence has ", triple(field.resolution)));
    const glm::dvec3 slack = 1e-6 * (field.high - field.low);  // what was written as text
    for (int i = 0; i < 3; ++i)
        if (std::abs(box.low[i] - field.low[i]) > slack[i] ||
            std::abs(box.high[i] - field.high[i]) > slack[i])
            throw Error(Location{file}, concat("reaches from ", box.low[i], " to ", box.high[i], " m along ",
                                               axisNames[i], ", ", field.file, " of the same sequence from ",
                                               field.low[i], " to ", field.high[i]));
}

[[noreturn]] void refuseValue(const glm::vec3& value, const glm::ivec3& cell, const std::string& file) {
    const bool finite = std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
    throw Error(
        Location{file},
        concat("cell (", cell.x, ", ", cell.y, ", ", cell.z, ") holds (", value.x, ", ", value.y, ", ",
               value.z, "), ", finite ? "after scaling beyond single precision" : "expected finite numbers"));
}

}  // namespace

size_t countCells(const glm::dvec3& resolution, const Location& where) {
    double cells = 1;
    for (int i = 0; i < 3; ++i) {
        if (!(resolution[i] >= 1) || resolution[i] != std::floor(resolution[i]))
            throw Error(where, concat("expected the resolution along ", axisNames[i],
                                      " as a whole number of at least 1, found ", resolution[i]));
        cells *= resolution[i];
    }
    if (cells > double(maxFieldCells))
        throw Error(where, concat("the resolution makes more than ", maxFieldCells,
                                  " cells (2^24), the most that a field may have"));
    return size_t(cells);
}

void addFrame(GridField& field, FileGrid&& grid, const std::string& file) {
    const GridSource& source = field.source;
    const AxisMap map = axisMap(source.axes);
    const glm::ivec3 size(grid.resolution[map.source.x], grid.resolution[map.source.y],
                          grid.resolution[map.source.z]);
    const Box box = boundsOf(grid, map, source, file);
    const bool first = field.values.empty();
    if (first) {
        field.file = file;
        field.resolution = size;
        field.low = box.low;
        field.high = box.high;
    } else {
        checkSame(field, size, box, file);
    }
    const double scale = source.velocityScale.value_or(source.scale);
    const size_t before = field.values.size();
    field.values.resize(before + grid.values.size());
    glm::vec3* out = field.values.data() + before;
    const glm::vec3* in = grid.values.data();
    glm::ivec3 c;
    for (c.z = 0; c.z < grid.resolution.z; ++c.z)
        for (c.y = 0; c.y < grid.resolution.y; ++c.y)
            for (c.x = 0; c.x < grid.resolution.x; ++c.x, ++in) {
                const glm::dvec3 scaled = glm::dvec3(*in) * scale;
                if (!(std::abs(scaled.x) < largestInFiles && std::abs(scaled.y) < largestInFiles &&
                      std::abs(scaled.z) < largestInFiles))
                    refuseValue(*in, c, file);
                glm::ivec3 cell(c[map.source.x], c[map.source.y], c[map.source.z]);
                if (map.flipZ) cell.z = size.z - 1 - cell.z;
                out[size_t(cell.x) + size_t(size.x) * (size_t(cell.y) + size_t(size.y) * size_t(cell.z))] =
                    glm::vec3(map(scaled));
            }
}

const std::vector<std::string>& fieldFileEndings() {
    static const std::vector<std::string> endings = {".fga", ".vf", ".vti", ".raw"};
    return endings;
}

FileGrid readFieldFile(const std::string& file, const GridSource& source, const std::string& layout) {
    const std::string ending = lowerExtension(file);
    if (ending == ".raw") {
        const RawLayout lie = parseRawLayout(readFile(layout), layout);
        return parseRaw(readFile(file), lie, file);
    }
    const std::string bytes = readFile(file);
    if (ending == ".vf") return parseVf(bytes, file);
    return ending == ".vti" ? parseVti(bytes, file, source.array) : parseFga(bytes, file);
}

}  // namespace shoal
