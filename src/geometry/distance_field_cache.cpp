#include "geometry/distance_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "core/cache_folder.h"
#include "core/file.h"

namespace shoal {

namespace fs = std::filesystem;

namespace {

// Any change of what is baked, or of this head, is another version.
constexpr uint32_t bakingVersion = 2;
constexpr char magic[8] = {'s', 'h', 'o', 'a', 'l', 'f', 'l', 'd'};
constexpr const char* extension = ".shoal-field";

struct Head {
    char magic[8];
    uint32_t version;
    int32_t resolution;
    int32_t size[3], unused;
    double low[3], cell, outside, shell;
    double thinArea, thinnest, thinWhere[3];
    double probes, most, rms, where[3];
    double seconds;
    uint64_t checksum;  // of the key, the head with 0 here, and the distances
};
static_assert(sizeof(Head) == 184);

void put(double (&to)[3], const glm::dvec3& from) {
    for (int i = 0; i < 3; ++i)
        to[i] = from[i];
}
glm::dvec3 vector(const double (&from)[3]) {
    return {from[0], from[1], from[2]};
}

template <typename T>
std::string_view bytesOf(const std::vector<T>& values) {
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

glm::dvec3 middleOf(const Mesh& mesh) {
    return 0.5 * (mesh.low + mesh.high);
}

// Places about the middle, to a step far below a float's: the same wherever the mesh stands. The step is a
// power of 2, because no decimal lies half way between two such steps, where a rounding would take it to
// either.
std::vector<glm::dvec3> shapeOf(const Mesh& mesh) {
    const glm::dvec3 middle = middleOf(mesh), extent = mesh.high - mesh.low;
    const double size = std::max({extent.x, extent.y, extent.z});
    if (!(size > 0)) return mesh.positions;
    constexpr int digits = 26;  // binary, of the size
    const double step = std::ldexp(1.0, std::ilogb(size * (1 - 1e-9)) - digits);
    std::vector<glm::dvec3> out;
    out.reserve(mesh.positions.size());
    for (const glm::dvec3& place : mesh.positions)
        out.push_back(step * glm::round((place - middle) / step) + 0.0);  // never -0
    return out;
}

std::string keyOf(const Mesh& mesh, const FieldRequest& request) {
    std::string all = concat("field ", bakingVersion, " ", mesh.positions.size(), " ");
    all += bytesOf(shapeOf(mesh));
    all += bytesOf(mesh.triangles);
    const double asked[] = {double(request.resolution.value_or(0)), request.error.value_or(0),
                            request.shell.value_or(0), request.thickness};
    all.append(reinterpret_cast<const char*>(asked), sizeof asked);
    return contentKey(all);
}

uint64_t checksum(const std::string& key, Head head, std::string_view distances) {
    head.checksum = 0;
    const std::string_view front(reinterpret_cast<const char*>(&head), sizeof head);
    return fnv(distances, fnv(front, fnv(key)));
}

Head headOf(const DistanceField& field) {
    Head head{};
    std::memcpy(head.magic, magic, sizeof magic);
    head.version = bakingVersion;
    head.resolution = field.resolution;
    for (int i = 0; i < 3; ++i)
        head.size[i] = field.grid.size[i];
    put(head.low, field.grid.low);
    head.cell = field.grid.cell;
    head.outside = field.outside;
    head.shell = field.shell;
    head.thinArea = field.thinArea;
    head.thinnest = field.thinnest;
    put(head.thinWhere, field.thinWhere);
    head.probes = double(field.error.probes);
    head.most = field.error.most;
    head.rms = field.error.rms;
    put(head.where, field.error.where);
    head.seconds = field.seconds;
    return head;
}

// False: no file of ours, or not what we wrote.
bool parse(std::string_view bytes, const std::string& key, DistanceField& field) {
    Head head;
    if (bytes.size() < sizeof head) return false;
    std::memcpy(&head, bytes.data(), sizeof head);
    const std::string_view distances = bytes.substr(sizeof head);
    if (std::memcmp(head.magic, magic, sizeof magic) != 0 || head.version != bakingVersion ||
        head.checksum != checksum(key, head, distances))
        return false;
    field.grid = {{head.size[0], head.size[1], head.size[2]}, vector(head.low), head.cell};
    if (distances.size() != field.grid.count() * sizeof(float)) return false;
    field.distances.resize(field.grid.count());
    std::memcpy(field.distances.data(), distances.data(), distances.size());
    field.resolution = head.resolution;
    field.outside = head.outside;
    field.shell = head.shell;
    field.thinArea = head.thinArea;
    field.thinnest = head.thinnest;
    field.thinWhere = vector(head.thinWhere);
    field.error = {size_t(head.probes), head.most, head.rms, vector(head.where)};
    field.seconds = head.seconds;
    field.cached = true;
    return true;
}

bool readCached(const fs::path& path, const std::string& key, DistanceField& field,
                std::vector<Warning>& warnings) {
    std::error_code code;
    if (!fs::exists(path, code)) return false;
    std::string why = "the cached field is damaged";
    try {
        if (parse(readFile(path), key, field)) {
            touchFile(path);
            return true;
        }
    } catch (const Error& error) {
        why = "the cached field " + error.message();
    }
    warnings.push_back({{path.string()}, why + "; baked anew"});
    return false;
}

void keep(const fs::path& path, const std::string& key, const DistanceField& field,
          std::vector<Warning>& warnings) {
    Head head = headOf(field);
    head.checksum = checksum(key, head, bytesOf(field.distances));
    try {
        FileWriter file(path);
        file.write(&head, sizeof head);
        file.write(field.distances.data(), field.distances.size() * sizeof(float));
        file.finish();
        keepNewest(path.parent_path(), extension, keptFields);
    } catch (const Error& error) {
        warnings.push_back({error.location(), error.message() + "; fields are baked at every start"});
    }
}

}  // namespace

static void move(DistanceField& field, const glm::dvec3& offset) {
    for (glm::dvec3* place : {&field.grid.low, &field.thinWhere, &field.error.where})
        *place += offset;
}

// About the middle of its mesh.
static DistanceField aboutMiddle(const Mesh& mesh, const FieldRequest& request, const FieldBaking& baking,
                                 std::vector<Warning>& warnings) {
    const std::string key = baking.cache.empty() ? "" : keyOf(mesh, request);
    const fs::path path = fs::path(baking.cache) / (key + extension);
    DistanceField field;
    if (!key.empty() && readCached(path, key, field, warnings)) return field;
    field = bakeDistanceField(mesh, request, baking.progress);
    move(field, -middleOf(mesh));
    if (!key.empty()) keep(path, key, field, warnings);
    return field;
}

DistanceField distanceFieldOf(const Mesh& mesh, const FieldRequest& request, const FieldBaking& baking,
                              std::vector<Warning>& warnings) {
    if (mesh.triangles.empty()) throw Error(noTriangles);
    DistanceField field = aboutMiddle(mesh, request, baking, warnings);
    move(field, middleOf(mesh));
    field.surface = examineSurface(mesh);
    return field;
}

}  // namespace shoal
