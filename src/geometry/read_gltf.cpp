// Reads glTF 2: nodes, skins in their pose, morph targets with their default weights, instances.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "geometry/gltf_file.h"
#include "geometry/gltf_materials.h"
#include "geometry/gltf_nodes.h"

namespace shoal {

namespace {

struct Skin {
    std::vector<glm::dmat4> joints;  // from the mesh to the scene
    std::vector<int> bones;          // their numbers in Mesh::boneNames
};

// An attribute of the vertices with what morph targets add to it.
struct Attribute {
    const GltfArray* base = nullptr;
    std::vector<std::pair<double, const GltfArray*>> targets;

    glm::dvec4 value(size_t vertex) const {
        glm::dvec4 out = base->vector(vertex);
        for (const auto& [weight, moves] : targets)
            out += weight * moves->vector(vertex, glm::dvec4(0));
        return out;
    }
};

struct Influences {
    const GltfArray *joints = nullptr, *weights = nullptr;
};

// The parts of a primitive that are read.
struct Corners {
    Attribute position, normal, color, uv;
    std::vector<Influences> influences;
    std::vector<glm::ivec3> triangles;
    size_t points = 0;  // the first so many vertices are points
    const Skin* skin = nullptr;
    glm::dmat3 uvTransform = GltfCoordinates{}.transform;
    std::string mesh;  // its name
};

// The extensions that are read, here, by gltf_file.cpp and by gltf_materials.cpp.
constexpr const char* readExtensions[] = {
    "KHR_mesh_quantization",           "KHR_texture_transform",   "KHR_node_visibility",
    "KHR_materials_emissive_strength", "KHR_materials_ior",       "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_transmission",      "EXT_mesh_gpu_instancing", "EXT_meshopt_compression"};

constexpr int triangleList = 4, triangleStrip = 5, triangleFan = 6;  // modes; before: points and lines

class GltfReader {
  public:
    GltfReader(const ModelFile& model) : file_(model), model_(model) {}

    Mesh read() {
        checkExtensions();
        coordinates_ = readGltfMaterials(file_, model_, mesh_);
        nodes_ = readGltfNodes(file_);
        readSkins();
        const std::vector<int> roots = gltfRoots(file_, nodes_, mesh_.notes);
        visit(roots);
        if (mesh_.triangles.empty()) {  // a cloud of points
            isCloud_ = true;
            visit(roots);
        }
        if (!anyColors_) mesh_.colors.clear();
        if (!anyUvs_) mesh_.uvs.clear();
        if (mesh_.boneNames.empty()) mesh_.bones.clear();
        tellLeftOut();
        return std::move(mesh_);
    }

  private:
    void checkExtensions() {
        JsonReader root = file_.root();
        std::vector<std::string> used, required;
        root.get("extensionsUsed", used);
        root.get("extensionsRequired", required);
        const auto isRead = [](const std::string& name) {
            return std::find(std::begin(readExtensions), std::end(readExtensions), name) !=
                   std::end(readExtensions);
        };
        for (const std::string& name : required) {
            if (name == "KHR_draco_mesh_compression")
                throw Error(root.locate("extensionsRequired"), "its meshes are compressed by Draco (", name,
                            "), which is not read: save it without, or with EXT_meshopt_compression");
            if (!isRead(name))
                mesh_.losses.push_back(concat("it requires the extension ", name, ", which is not read"));
        }
        for (const std::string& name : used)
            if (!isRead(name) && std::find(required.begin(), required.end(), name) == required.end())
                mesh_.notes.push_back(concat("its extension ", name, " is not read"));
    }

    // ---- Nodes and skins

    void visit(const std::vector<int>& roots) {
        std::vector<int> next(roots.rbegin(), roots.rend());
        std::vector<char> seen(nodes_.size(), 0);  // a scene may name a node and its child
        while (!next.empty()) {
            const int number = next.back();
            next.pop_back();
            const GltfNode& node = nodes_[size_t(number)];
            if (std::exchange(seen[size_t(number)], 1)) continue;
            if (node.mesh >= 0 && !node.hidden) appendMesh(number);
            next.insert(next.end(), node.children.rbegin(), node.children.rend());
        }
    }

    void readSkins() {
        skins_.resize(file_.count("skins"));
        for (size_t s = 0; s < skins_.size(); ++s) {
            JsonReader from = file_.item("skins", int(s));
            std::vector<int> joints;
            from.require("joints");
            from.get("joints", joints, Range::between(0, double(nodes_.size()) - 1));
            const int accessor = file_.index(from, "inverseBindMatrices", "accessors");
            const GltfArray* inverse = accessor >= 0 ? &file_.array(accessor, {16}) : nullptr;
            if (inverse && inverse->count < joints.size())
                throw Error(from.locate("inverseBindMatrices"), "has ", inverse->count, " matrices for ",
                            joints.size(), " joints");
            for (size_t j = 0; j < joints.size(); ++j) {
                const GltfNode& node = nodes_[size_t(joints[j])];
                skins_[s].joints.push_back(node.global * (inverse ? inverse->matrix(j) : glm::dmat4(1)));
                skins_[s].bones.push_back(boneOf(node.name.empty() ? concat("node ", joints[j]) : node.name));
            }
        }
    }

    int boneOf(const std::string& name) {
        const auto known = std::find(mesh_.boneNames.begin(), mesh_.boneNames.end(), name);
        const int number = int(known - mesh_.boneNames.begin());
        if (known == mesh_.boneNames.end()) mesh_.boneNames.push_back(name);
        return number;
    }

    // The weighted mean of the joints' transforms, and the heaviest bone.
    glm::dmat4 poseOf(const Corners& corners, size_t vertex, int& bone) const {
        glm::dmat4 out(0);
        double sum = 0, heaviest = 0;
        for (const Influences& some : corners.influences)
            for (int i = 0; i < 4; ++i) {
                const double weight = some.weights->vector(vertex)[i], joint = some.joints->vector(vertex)[i];
                if (!(weight > 0)) continue;
                if (!(joint >= 0 && joint < double(corners.skin->joints.size())))
                    throw Error(Location{model_.name}, "vertex ", vertex, " of mesh \"", corners.mesh,
                                "\" is moved by joint ", joint, " of ", corners.skin->joints.size());
                out += weight * corners.skin->joints[size_t(joint)];
                sum += weight;
                if (weight > heaviest) bone = corners.skin->bones[size_t(joint)];
                heaviest = std::max(heaviest, weight);
            }
        return sum > 0 ? out / sum : glm::dmat4(1);
    }

    // ---- Meshes

    void appendMesh(int number) {
        const GltfNode& node = nodes_[size_t(number)];
        JsonReader source = file_.item("nodes", number), mesh = file_.item("meshes", node.mesh);
        std::string name;
        mesh.get("name", name);
        std::vector<double> weights;
        if (!source.get("weights", weights)) mesh.get("weights", weights);
        const Skin* skin = node.skin >= 0 ? &skins_[size_t(node.skin)] : nullptr;
        // What a skin moves stands where its joints are, wherever its node is (appendVertex).
        const std::vector<glm::dmat4> places =
            skin ? std::vector{node.global} : gltfPlaces(file_, source, node);
        Mesh::Object object{node.name.empty() ? name : node.name, int(mesh_.triangles.size()), 0};
        for (JsonReader& primitive : mesh.objects("primitives")) {
            Corners corners = cornersOf(primitive, weights, skin);
            corners.mesh = name;
            const int material = file_.index(primitive, "material", "materials");
            Mesh::Part part{name, {}, int(mesh_.triangles.size()), 0, material};
            if (material >= 0) {
                file_.item("materials", material).get("name", part.material);
                corners.uvTransform = coordinates_[size_t(material)].transform;
            }
            for (const glm::dmat4& place : places) {
                append(corners, place);
                for (size_t i = 0; isCloud_ && i < corners.points; ++i)
                    appendVertex(corners, i, place);
            }
            part.triangleCount = int(mesh_.triangles.size()) - part.firstTriangle;
            if (part.triangleCount > 0) mesh_.parts.push_back(std::move(part));
        }
        object.triangleCount = int(mesh_.triangles.size()) - object.firstTriangle;
        if (object.triangleCount > 0) mesh_.objects.push_back(std::move(object));
    }

    Corners cornersOf(JsonReader& primitive, const std::vector<double>& weights, const Skin* skin) {
        Corners out;
        primitive.require("attributes");
        JsonReader attributes = *primitive.object("attributes");
        std::vector<JsonReader> targets = primitive.objects("targets");
        const auto attribute = [&](const std::string& key, std::initializer_list<size_t> components) {
            Attribute found;
            const int accessor = file_.index(attributes, key, "accessors");
            if (accessor < 0) return found;
            const auto arrayOf = [&](int number, const Location& where) {
                const GltfArray& array = file_.array(number, components);
                if (out.position.base && array.count != out.position.base->count)
                    throw Error(where, "has ", array.count, " elements, the positions have ",
                                out.position.base->count);
                return &array;
            };
            found.base = arrayOf(accessor, attributes.locate(key));
            for (size_t t = 0; t < std::min(targets.size(), weights.size()); ++t)
                if (const int moves = file_.index(targets[t], key, "accessors");
                    moves >= 0 && weights[t] != 0)
                    found.targets.emplace_back(weights[t], arrayOf(moves, targets[t].locate(key)));
            return found;
        };
        out.position = attribute("POSITION", {3});
        if (!out.position.base) return out;
        if (gltfExtension(primitive, "KHR_draco_mesh_compression")) refuseWithoutView(attributes);
        out.normal = attribute("NORMAL", {3});
        out.color = attribute("COLOR_0", {3, 4});
        const int material = file_.index(primitive, "material", "materials");
        const int set = material >= 0 ? coordinates_[size_t(material)].set : 0;
        out.uv = attribute(concat("TEXCOORD_", set), {2});
        if (!out.uv.base && set > 0) out.uv = attribute("TEXCOORD_0", {2});
        for (int i = 0; skin && attributes.has(concat("JOINTS_", i)); ++i) {
            attributes.require(concat("WEIGHTS_", i));
            out.influences.push_back(
                {attribute(concat("JOINTS_", i), {4}).base, attribute(concat("WEIGHTS_", i), {4}).base});
        }
        if (!out.influences.empty()) out.skin = skin;
        int mode = triangleList;
        primitive.get("mode", mode, Range::between(0, 6));
        if (mode < triangleList)
            linesOrPoints_ = true;
        else
            out.triangles = trianglesOf(primitive, mode, out.position.base->count);
        if (mode == 0) out.points = out.position.base->count;
        return out;
    }

    // What is compressed by Draco may lie beside it as it is.
    void refuseWithoutView(JsonReader& attributes) {
        const int accessor = file_.index(attributes, "POSITION", "accessors");
        if (!file_.item("accessors", accessor).has("bufferView"))
            throw Error(attributes.here(),
                        "is compressed by Draco (KHR_draco_mesh_compression), which is not read");
    }

    std::vector<glm::ivec3> trianglesOf(JsonReader& primitive, int mode, size_t vertices) {
        const int accessor = file_.index(primitive, "indices", "accessors");
        const GltfArray* indices = accessor >= 0 ? &file_.array(accessor, {1}) : nullptr;
        const size_t count = indices ? indices->count : vertices;
        const auto vertex = [&](size_t i) {
            const double index = indices ? indices->numbers[i] : double(i);
            if (!(index >= 0 && index < double(vertices)))
                throw Error(primitive.locate("indices"), "has a triangle with vertex ", index,
                            " of a mesh of ", vertices);
            return int(index);
        };
        std::vector<glm::ivec3> out;
        for (size_t i = 0; i + 2 < count; i += mode == triangleList ? 3 : 1) {
            if (mode == triangleFan)
                out.emplace_back(vertex(i + 1), vertex(i + 2), vertex(0));
            else if (mode == triangleStrip && i % 2 == 1)
                out.emplace_back(vertex(i + 1), vertex(i), vertex(i + 2));
            else
                out.emplace_back(vertex(i), vertex(i + 1), vertex(i + 2));
        }
        if (mode == triangleList && count % 3 != 0)
            mesh_.notes.push_back(concat("the last ", count % 3, " of ", count, " corners at ",
                                         primitive.path(), " make no triangle"));
        return out;
    }

    // Without normals a surface is flat: no two triangles share a corner.
    void append(const Corners& corners, const glm::dmat4& place) {
        if (mesh_.triangles.size() + corners.triangles.size() > mostElements)
            throw Error(Location{model_.name}, "has more than 2^28 triangles, the most that is read");
        std::vector<int> known(corners.triangles.empty() ? 0 : corners.position.base->count, -1);
        for (const glm::ivec3& triangle : corners.triangles) {
            glm::ivec3 out;
            for (int i = 0; i < 3; ++i) {
                int& vertex = known[size_t(triangle[i])];
                if (vertex < 0 || !corners.normal.base)
                    vertex = appendVertex(corners, size_t(triangle[i]), place);
                out[i] = vertex;
            }
            if (mirrored_[size_t(out.x)]) std::swap(out.y, out.z);  // keeps anticlockwise in front
            mesh_.triangles.push_back(out);
        }
    }

    int appendVertex(const Corners& corners, size_t vertex, const glm::dmat4& place) {
        if (mesh_.positions.size() >= mostElements)
            throw Error(Location{model_.name}, "has more than 2^28 vertices, the most that is read");
        int bone = -1;
        const glm::dmat4 transform = corners.skin ? poseOf(corners, vertex, bone) : place;
        const glm::dvec3 position(transform * glm::dvec4(glm::dvec3(corners.position.value(vertex)), 1));
        const auto refuse = [&](const std::string& why) {
            throw Error(Location{model_.name},
                        concat("vertex ", vertex, " of mesh \"", corners.mesh, "\" ", why));
        };
        if (!isFinite(position)) refuse("is not finite, expected three finite numbers");
        if (!isWithinReach(position)) refuse(concat("lies beyond ", farthest, ", the farthest that is read"));
        mesh_.positions.push_back(position);
        // The inverse transpose up to a factor that normalising removes; defined for flat transforms too.
        const glm::dmat3 m(transform);
        const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
        const bool mirrored = glm::determinant(m) < 0;
        mirrored_.push_back(mirrored);
        glm::dvec3 normal(0);
        if (corners.normal.base)
            normal = cofactor * glm::dvec3(corners.normal.value(vertex)) * (mirrored ? -1.0 : 1.0);
        mesh_.normals.push_back(unit(normal));
        anyColors_ = anyColors_ || corners.color.base;
        const glm::dvec4 color = corners.color.base ? corners.color.value(vertex) : glm::dvec4(1);
        mesh_.colors.push_back(isFinite(color) ? glm::dvec3(color) : glm::dvec3(1));
        seesThrough_ =
            seesThrough_ || (corners.color.base && corners.color.base->components == 4 && color.a < 1);
        anyUvs_ = anyUvs_ || corners.uv.base;
        glm::dvec3 uv(0);
        if (corners.uv.base) uv = corners.uvTransform * glm::dvec3(glm::dvec2(corners.uv.value(vertex)), 1);
        mesh_.uvs.push_back(isFinite(uv) ? glm::dvec2(uv) : glm::dvec2(0));
        mesh_.bones.push_back(bone);
        return int(mesh_.positions.size()) - 1;
    }

    void tellLeftOut() {
        const auto tell = [&](bool any, const std::string& what) {
            if (any) mesh_.notes.push_back(what);
        };
        tell(linesOrPoints_ && !isCloud_, "its points and lines are not drawn");
        tell(seesThrough_, "the alpha of its vertices' colours is not drawn");
        tell(file_.count("animations") > 0, "its animations are not played: it is read in its pose");
        tell(file_.count("cameras") > 0, "its cameras are not read");
    }

    GltfFile file_;
    const ModelFile& model_;
    Mesh mesh_;
    std::vector<GltfCoordinates> coordinates_;  // by material
    std::vector<GltfNode> nodes_;
    std::vector<Skin> skins_;
    bool linesOrPoints_ = false, isCloud_ = false;
    bool anyColors_ = false, anyUvs_ = false, seesThrough_ = false;
    std::vector<char> mirrored_;  // by corner: its transform turns what is right into what is left
};

}  // namespace

Mesh readGltf(const ModelFile& model) {
    try {
        return GltfReader(model).read();
    } catch (const Error& error) {
        // The child process hands on no more of the place than its line, of which files have one.
        const Location& where = error.location();
        if (where.path.empty()) throw;
        throw Error(Location{model.name, where.line}, error.message(), " (at ", where.path, ")");
    }
}

}  // namespace shoal
