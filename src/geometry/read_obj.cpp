// Reads OBJ through tinyobjloader, which obj_text.h holds to what the text says.
#include <algorithm>
#include <array>
#include <istream>
#include <unordered_map>

#include "core/file.h"
#include "core/srgb.h"
#include "geometry/model_reader.h"
#include "geometry/obj_materials.h"
#include "geometry/obj_text.h"
#include "geometry/polygon.h"
#include "geometry/tiny_obj.h"

namespace shoal {

namespace {

struct Corner {
    int vertex, uv, normal, smoothing;  // numbers from 0 on, -1: none; the group that is smoothed, 0: none
    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    size_t operator()(const Corner& c) const {
        uint64_t mixed = uint64_t(uint32_t(c.vertex)) << 32 ^ uint32_t(c.uv);
        mixed = mixed * 0x9E3779B97F4A7C15u ^ (uint64_t(uint32_t(c.normal)) << 32 ^ uint32_t(c.smoothing));
        mixed *= 0xC2B2AE3D27D4EB4Fu;
        return size_t(mixed ^ (mixed >> 29));
    }
};

// The faces of an object that have one material, in the order of the file.
struct Piece {
    size_t object;
    std::string material;
    std::vector<Corner> corners;
    std::vector<int> sizes;  // corners of each face
};

// Gathers what comes out of tinyobjloader.
class ObjReader {
  public:
    explicit ObjReader(const ModelFile& model)
        : model_(model), materials_(model, mesh_), text_(bytesOf(model), model.name) {}

    Mesh read() {
        std::istream stream(&text_);
        stream.exceptions(std::ios::badbit);  // passes on what the text's checks throw
        tinyobj::LoadObjWithCallback(stream, callbacks(), this);
        for (const std::string& names : text_.libraries())
            materials_.readLibraries(names);
        for (size_t object = 0; object < objects_.size(); ++object)
            append(object);
        if (mesh_.triangles.empty()) keepPoints();
        if (!anyColors_) mesh_.colors.clear();
        if (uvs_.empty()) mesh_.uvs.clear();
        tellLeftOut();
        return std::move(mesh_);
    }

  private:
    static std::string bytesOf(const ModelFile& model) {
        std::string bytes = readFile(model.name);
        model.opened(bytes.size());
        return bytes;
    }
    Error fail(const std::string& message) const {
        return Error(Location{model_.name}, "line ", text_.line(), ": ", message);
    }
    static ObjReader& self(void* data) {
        ObjReader& reader = *static_cast<ObjReader*>(data);
        reader.text_.taken();
        return reader;
    }

    tinyobj::callback_t callbacks() const {
        tinyobj::callback_t out;
        out.vertex_cb = [](void* data, double x, double y, double z, double) {
            self(data).addVertex({x, y, z});
        };
        out.normal_cb = [](void* data, double x, double y, double z) {
            self(data).normals_.emplace_back(x, y, z);
        };
        out.texcoord_cb = [](void* data, double u, double v, double) { self(data).uvs_.emplace_back(u, v); };
        out.index_cb = [](void* data, tinyobj::index_t* corners, int count) {
            self(data).addFace(corners, count);
        };
        out.usemtl_cb = [](void* data, const char* name, int) { self(data).material_ = trimmed(name); };
        out.group_cb = [](void* data, const char** names, int count) {
            std::string all;
            for (int i = 0; i < count; ++i)
                all += (i > 0 ? " " : "") + std::string(names[i]);
            self(data).object_ = all;
        };
        out.object_cb = [](void* data, const char* name) { self(data).object_ = name; };
        return out;
    }

    void addVertex(const glm::dvec3& position) {
        if (!isFinite(position)) throw fail("a vertex is not finite, expected three finite numbers");
        if (!isWithinReach(position))
            throw fail(concat("a vertex lies beyond ", farthest, ", the farthest that is read"));
        if (positions_.size() >= mostElements)
            throw fail("has more than 2^28 vertices, the most that is read");
        positions_.push_back(position);
        glm::dvec3 color = text_.color().value_or(glm::dvec3(1));
        anyColors_ = anyColors_ || text_.color();
        color = linearOfSrgb(color);
        colors_.push_back(isFinite(color) ? color : glm::dvec3(1));
    }

    // Counts from 1 on, from the end where it is negative; 0: there is none.
    int resolved(int index, size_t count, const char* what) const {
        if (index == 0) return -1;
        const int64_t element = index > 0 ? int64_t(index) - 1 : int64_t(count) + index;
        if (element < 0 || element >= int64_t(count))
            throw fail(concat("a face has ", what, " ", index, ", of ", count, " before it"));
        return int(element);
    }

    void addFace(const tinyobj::index_t* corners, int count) {
        if (count < 3) {
            ++thinFaces_;
            return;
        }
        Piece& piece = pieceNow();
        for (int i = 0; i < count; ++i)
            piece.corners.push_back({resolved(corners[i].vertex_index, positions_.size(), "vertex"),
                                     resolved(corners[i].texcoord_index, uvs_.size(), "texture coordinates"),
                                     resolved(corners[i].normal_index, normals_.size(), "normal"),
                                     text_.smoothing()});
        piece.sizes.push_back(count);
        triangles_ += size_t(count) - 2;
        if (triangles_ > mostElements) throw fail("has more than 2^28 triangles, the most that is read");
    }

    // That of the last object and material.
    Piece& pieceNow() {
        if (piece_ < pieces_.size() && objects_[pieces_[piece_].object] == object_ &&
            pieces_[piece_].material == material_)
            return pieces_[piece_];
        const auto [object, isNew] = objectNumbers_.try_emplace(object_, objects_.size());
        if (isNew) objects_.push_back(object_), piecesOf_.emplace_back();
        const auto [number, fresh] = pieceNumbers_.try_emplace({object->second, material_}, pieces_.size());
        if (fresh) {
            piecesOf_[object->second].push_back(pieces_.size());
            pieces_.push_back({object->second, material_, {}, {}});
        }
        piece_ = number->second;
        return pieces_[piece_];
    }

    void append(size_t object) {
        Mesh::Object whole{objects_[object], int(mesh_.triangles.size()), 0};
        for (const size_t number : piecesOf_[object]) {
            const Piece piece = std::exchange(pieces_[number], {});
            Mesh::Part part{whole.name, piece.material, int(mesh_.triangles.size()), 0,
                            materials_.numberOf(piece.material)};
            append(piece, materials_.placementOf(part.look));
            part.triangleCount = int(mesh_.triangles.size()) - part.firstTriangle;
            mesh_.parts.push_back(part);
        }
        whole.triangleCount = int(mesh_.triangles.size()) - whole.firstTriangle;
        mesh_.objects.push_back(whole);
    }

    void append(const Piece& piece, const ObjMaterials::Placement& placement) {
        std::unordered_map<Corner, int, CornerHash> known;
        std::vector<glm::dvec3> polygon;
        std::vector<int> numbers;
        const Corner* corner = piece.corners.data();
        for (const int size : piece.sizes) {
            polygon.clear(), numbers.clear();
            for (int i = 0; i < size; ++i, ++corner) {
                polygon.push_back(positions_[size_t(corner->vertex)]);
                numbers.push_back(numberOf(*corner, placement, known));
            }
            for (const glm::ivec3& t : cutPolygon(polygon))
                mesh_.triangles.emplace_back(numbers[size_t(t.x)], numbers[size_t(t.y)],
                                             numbers[size_t(t.z)]);
        }
    }

    // Without a normal and a group that is smoothed, each face has its own corners: it is flat.
    int numberOf(const Corner& corner, const ObjMaterials::Placement& placement,
                 std::unordered_map<Corner, int, CornerHash>& known) {
        const int next = int(mesh_.positions.size());
        Corner key = corner;
        if (corner.normal >= 0) key.smoothing = 0;
        if (corner.normal >= 0 || corner.smoothing > 0) {
            const auto [number, fresh] = known.try_emplace(key, next);
            if (!fresh) return number->second;
        }
        mesh_.positions.push_back(positions_[size_t(corner.vertex)]);
        mesh_.colors.push_back(colors_[size_t(corner.vertex)]);
        glm::dvec3 normal(0);
        if (corner.normal >= 0) normal = normals_[size_t(corner.normal)];
        const double length = glm::length(normal);
        mesh_.normals.push_back(isFinite(normal) && length > 0 ? normal / length : glm::dvec3(0));
        glm::dvec2 uv(0);
        if (corner.uv >= 0) uv = uvs_[size_t(corner.uv)] * placement.scale + placement.shift;
        mesh_.uvs.push_back(isFinite(glm::dvec3(uv, 0)) ? uv : glm::dvec2(0));
        return next;
    }

    // A cloud of points.
    void keepPoints() {
        mesh_.positions = std::move(positions_);
        mesh_.colors = std::move(colors_);
        mesh_.normals.assign(mesh_.positions.size(), glm::dvec3(0));
        mesh_.uvs.clear();
        uvs_.clear();
    }

    void tellLeftOut() {
        if (text_.lost() > 0)
            mesh_.losses.push_back(concat(many(int64_t(text_.lost()), "line is", "lines are"),
                                          " not read as the file has them, the first of them line ",
                                          text_.firstLost()));
        if (thinFaces_ > 0)
            mesh_.notes.push_back(
                concat(many(int64_t(thinFaces_), "face of fewer than three corners is left out",
                            "faces of fewer than three corners are left out")));
        for (const auto& [word, count] : text_.others()) {
            static constexpr std::array shapes = {"surf", "fo", "bzp", "bsp", "call", "csh", "cdp"};
            const bool shape = std::find(shapes.begin(), shapes.end(), word) != shapes.end();
            if (mesh_.triangles.empty() && (word == "p" || word == "l")) continue;
            (shape ? mesh_.losses : mesh_.notes)
                .push_back(concat(many(int64_t(count), "line begins", "lines begin"), " with \"", word,
                                  "\", which is not read: only triangles and polygons are read"));
        }
    }

    const ModelFile& model_;
    Mesh mesh_;
    ObjMaterials materials_;
    ObjText text_;
    std::vector<glm::dvec3> positions_, colors_, normals_;  // as the file has them
    std::vector<glm::dvec2> uvs_;
    bool anyColors_ = false;
    size_t thinFaces_ = 0, triangles_ = 0;
    std::string object_, material_;  // of the faces to come
    std::vector<std::string> objects_;
    std::map<std::string, size_t> objectNumbers_;
    std::vector<Piece> pieces_;
    std::vector<std::vector<size_t>> piecesOf_;                      // of each object
    std::map<std::pair<size_t, std::string>, size_t> pieceNumbers_;  // by object and material
    size_t piece_ = 0;                                               // in pieces_, of the last face
};

}  // namespace

Mesh readObj(const ModelFile& model) {
    return ObjReader(model).read();
}

}  // namespace shoal
