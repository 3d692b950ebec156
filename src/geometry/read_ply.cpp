// Reads PLY: vertices with normals, colours and texture coordinates, faces or strips of triangles, and what
// MeshLab adds, texture coordinates of corners and several images. Lengths are taken as metres.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <span>

#include "core/file.h"
#include "core/srgb.h"
#include "geometry/model_images.h"
#include "geometry/model_reader.h"
#include "geometry/ply_file.h"
#include "geometry/polygons.h"

namespace shoal {

namespace {

// Tells by its name what a property of a vertex or face is.
enum class Means {
    x,
    y,
    z,
    normalX,
    normalY,
    normalZ,
    red,
    green,
    blue,
    alpha,
    u,
    v,
    corners,
    cornerUvs,
    image
};
constexpr size_t meanings = size_t(Means::image) + 1;

struct Name {
    std::string_view name;
    Means means;
};
constexpr Name vertexNames[] = {
    {"x", Means::x},
    {"y", Means::y},
    {"z", Means::z},
    {"nx", Means::normalX},
    {"ny", Means::normalY},
    {"nz", Means::normalZ},
    {"red", Means::red},
    {"green", Means::green},
    {"blue", Means::blue},
    {"r", Means::red},
    {"g", Means::green},
    {"b", Means::blue},
    {"diffuse_red", Means::red},
    {"diffuse_green", Means::green},
    {"diffuse_blue", Means::blue},
    {"alpha", Means::alpha},
    {"s", Means::u},
    {"t", Means::v},
    {"u", Means::u},
    {"v", Means::v},
    {"tx", Means::u},
    {"ty", Means::v},
    {"texture_u", Means::u},
    {"texture_v", Means::v},
};
constexpr Name faceNames[] = {
    {"vertex_indices", Means::corners},
    {"vertex_index", Means::corners},
    {"texcoord", Means::cornerUvs},
    {"texnumber", Means::image},
    {"red", Means::red},
    {"green", Means::green},
    {"blue", Means::blue},
    {"alpha", Means::alpha},
};

// Where in the rows of an element each meaning is.
class Columns {
  public:
    // Adds to `unknown` the names of what means nothing.
    Columns(const PlyElement& element, std::span<const Name> names, std::vector<std::string>& unknown) {
        std::fill_n(at_, meanings, -1);
        for (size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const auto known = std::find_if(names.begin(), names.end(), [&](const Name& name) {
                return name.name == property.name &&
                       property.countType.has_value() ==
                           (name.means == Means::corners || name.means == Means::cornerUvs);
            });
            if (known == names.end() || has(known->means)) {
                unknown.push_back(concat("\"", property.name, "\""));
                continue;
            }
            at_[size_t(known->means)] = int(i);
            full_[size_t(known->means)] = fullShare(property.type);
        }
    }

    bool has(Means means) const { return at_[size_t(means)] >= 0; }
    // The row's number; `fallback` where there is no such column.
    double number(const PlyRow& row, Means means, double fallback = 0) const {
        return has(means) ? row.numbers[size_t(at_[size_t(means)])] : fallback;
    }
    double share(const PlyRow& row, Means means) const {
        return has(means) ? number(row, means) / full_[size_t(means)] : 1;
    }
    // In PLY colours are sRGB.
    glm::dvec3 color(const PlyRow& row) const {
        const glm::dvec3 out =
            linearOfSrgb({share(row, Means::red), share(row, Means::green), share(row, Means::blue)});
        return isFinite(out) ? out : glm::dvec3(1);
    }
    const std::vector<double>& list(const PlyRow& row, Means means) const {
        static const std::vector<double> none;
        return has(means) ? row.lists[size_t(at_[size_t(means)])] : none;
    }

  private:
    int at_[meanings];
    double full_[meanings] = {};
};

class PlyReader {
  public:
    explicit PlyReader(const ModelFile& model)
        : model_(model), file_(readFile(model.name), model.name), images_(model, mesh_.images) {}

    Mesh read() {
        for (const PlyElement& element : file_.elements())
            if (element.name == "vertex") vertexCount_ = element.count;
        if (vertexCount_ > mostElements)
            throw Error(Location{model_.name}, "has more than 2^28 vertices, the most that is read");
        for (const PlyElement& element : file_.elements()) {
            file_.begin(element);
            if (element.name == "vertex")
                readVertices(element);
            else if (element.name == "face")
                readFaces(element);
            else if (element.name == "tristrips")
                readStrips(element);
            else
                skip(element);
        }
        if (const size_t left = file_.left(); left > 0)
            note(concat("it goes on for ", many(int64_t(left), "byte", "bytes"),
                        " behind what its header announces, which are not read"));
        tellLeftOut();
        if (hasColors_) polygons_.cornerColors.clear();
        partImages_ = polygons_.addTo(mesh_, model_.name);
        if (!mesh_.triangles.empty()) mesh_.objects.push_back({"", 0, int(mesh_.triangles.size())});
        addMaterials();
        return std::move(mesh_);
    }

  private:
    void note(std::string what) { mesh_.notes.push_back(std::move(what)); }

    template <typename Read>
    void eachRow(const PlyElement& element, const Read& read) {
        PlyRow row;
        for (size_t i = 0; i < element.count && !element.properties.empty(); ++i) {
            file_.next(row);
            read(row);
        }
    }

    void skip(const PlyElement& element) {
        eachRow(element, [](const PlyRow&) {});
        if (element.count > 0) note(concat("its element \"", element.name, "\" is not read"));
    }

    Columns columnsOf(const PlyElement& element, std::span<const Name> names) {
        std::vector<std::string> unknown;
        Columns out(element, names, unknown);
        if (!unknown.empty() && element.count > 0)
            note(concat("of element \"", element.name, "\" ", joined(unknown, ", "),
                        unknown.size() == 1 ? " is" : " are", " not read"));
        return out;
    }

    void readVertices(const PlyElement& element) {
        const Columns columns = columnsOf(element, vertexNames);
        for (const Means axis : {Means::x, Means::y, Means::z})
            if (!columns.has(axis) && element.count > 0)
                throw Error(Location{model_.name}, "cannot be read: element \"vertex\" has no property \"",
                            vertexNames[size_t(axis)].name, "\"");
        hasColors_ = columns.has(Means::red) && columns.has(Means::green) && columns.has(Means::blue);
        hasUvs_ = columns.has(Means::u) && columns.has(Means::v);
        const bool normals =
            columns.has(Means::normalX) && columns.has(Means::normalY) && columns.has(Means::normalZ);
        eachRow(element, [&](const PlyRow& row) {
            const glm::dvec3 p(columns.number(row, Means::x), columns.number(row, Means::y),
                               columns.number(row, Means::z));
            if (!isFinite(p)) throw file_.fail("it is not finite, expected three finite numbers");
            if (!isWithinReach(p))
                throw file_.fail(concat("it lies beyond ", farthest, ", the farthest that is read"));
            mesh_.positions.push_back(p);
            glm::dvec3 normal(0);
            if (normals)
                normal = {columns.number(row, Means::normalX), columns.number(row, Means::normalY),
                          columns.number(row, Means::normalZ)};
            mesh_.normals.push_back(unit(normal));
            if (hasColors_) mesh_.colors.push_back(columns.color(row));
            if (hasUvs_)
                mesh_.uvs.push_back(finiteUv({columns.number(row, Means::u), columns.number(row, Means::v)}));
            transparent_ = transparent_ || columns.share(row, Means::alpha) < 1;
        });
    }

    int vertexOf(double index) const {
        if (!(index >= 0 && index < double(vertexCount_)) || index != std::floor(index))
            throw file_.fail(
                concat("it has a corner at vertex ", formatted("%.15g", index), " of ", vertexCount_));
        return int(index);
    }

    void readFaces(const PlyElement& element) {
        const Columns columns = columnsOf(element, faceNames);
        const bool colored = columns.has(Means::red) && columns.has(Means::green) && columns.has(Means::blue);
        eachRow(element, [&](const PlyRow& row) {
            const std::vector<double>&corners = columns.list(row, Means::corners),
                  &uvs = columns.list(row, Means::cornerUvs);
            for (const double index : corners)
                vertexOf(index);
            if (corners.size() < 3) {
                ++polygons_.flat;
                return;
            }
            const bool whole = uvs.size() == 2 * corners.size();
            if (!whole && !uvs.empty()) ++wrongUvs_;
            if (whole) polygons_.cornerUvs.resize(polygons_.corners.size(), glm::dvec2(0));
            for (size_t i = 0; i < corners.size(); ++i) {
                polygons_.corners.push_back(int(corners[i]));
                if (whole) polygons_.cornerUvs.push_back(finiteUv({uvs[2 * i], uvs[2 * i + 1]}));
            }
            const double image = columns.number(row, Means::image);
            polygons_.close(corners.size(), image >= 0 && image < 1e6 ? int(image) : -1, model_.name);
            polygons_.cornerColors.resize(colored ? polygons_.corners.size() : 0, columns.color(row));
            transparent_ = transparent_ || columns.share(row, Means::alpha) < 1;
            hasFaceColors_ = hasFaceColors_ || colored;
        });
    }

    // Strips of triangles that share sides, each ended by -1; every other triangle turns the other way.
    void readStrips(const PlyElement& element) {
        const Columns columns = columnsOf(element, faceNames);
        eachRow(element, [&](const PlyRow& row) {
            const std::vector<double>& strip = columns.list(row, Means::corners);
            size_t first = 0;
            for (size_t i = 0; i < strip.size(); ++i) {
                if (strip[i] < 0) {
                    first = i + 1;
                    continue;
                }
                const int last = vertexOf(strip[i]);
                if (i < first + 2) continue;
                const bool odd = (i - first) % 2 == 1;
                polygons_.corners.insert(polygons_.corners.end(), {int(strip[odd ? i - 1 : i - 2]),
                                                                   int(strip[odd ? i - 2 : i - 1]), last});
                polygons_.close(3, 0, model_.name);
            }
        });
    }

    void tellLeftOut() {
        polygons_.tellFlat(mesh_);
        if (wrongUvs_ > 0)
            note(concat("the texture coordinates of ", many(wrongUvs_, "face", "faces"),
                        " are not two for each corner and are left out"));
        if (transparent_) note("its colours' opacity (\"alpha\") is not drawn");
        if (hasFaceColors_ && hasColors_)
            note("its faces' colours are not read beside those of its vertices");
    }

    // "comment TextureFile skin.png", by number.
    void addMaterials() {
        std::vector<std::string> names;
        for (const std::string& comment : file_.comments()) {
            constexpr std::string_view word = "TextureFile";
            if (!comment.starts_with(word)) continue;
            const size_t from = comment.find_first_not_of(" \t", word.size());
            if (from != std::string::npos && from > word.size()) names.push_back(comment.substr(from));
        }
        std::map<int, int> looks;  // by the image's number
        for (size_t i = 0; i < mesh_.parts.size(); ++i) {
            const int image = partImages_[i];
            if (image < 0 || size_t(image) >= names.size()) {
                if (!names.empty())
                    note(concat("faces name image ", image, " of ", names.size(), ", which is left out"));
                continue;
            }
            const std::string& name = names[size_t(image)];
            SurfaceMaterial look;
            look.colorImage = images_.fromFile(name, [&](const std::string& why) {
                note(concat("its colour image \"", name, "\" is left out: ", why));
            });
            if (look.colorImage >= 0 && anyTransparent(mesh_.images[size_t(look.colorImage)]))
                look.alpha = SurfaceMaterial::Alpha::cut;
            mesh_.parts[i].material = name;
            mesh_.parts[i].look = int(mesh_.materials.size());
            mesh_.materials.push_back(look);
        }
    }

    const ModelFile& model_;
    PlyFile file_;
    Mesh mesh_;
    ModelImages images_;
    size_t vertexCount_ = 0;
    bool hasColors_ = false, hasFaceColors_ = false, hasUvs_ = false, transparent_ = false;
    int64_t wrongUvs_ = 0;
    Polygons polygons_;
    std::vector<int> partImages_;  // by part
};

}  // namespace

Mesh readPly(const ModelFile& model) {
    std::error_code code;
    const uint64_t bytes = std::filesystem::file_size(model.name, code);
    if (!code) model.opened(bytes);
    return PlyReader(model).read();
}

}  // namespace shoal
