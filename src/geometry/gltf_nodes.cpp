#include "geometry/gltf_nodes.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "core/error.h"

namespace shoal {

namespace {

glm::dmat4 placed(const glm::dvec3& translation, glm::dvec4 turn, const glm::dvec3& scale) {
    turn = glm::normalize(turn);
    return glm::translate(glm::dmat4(1), translation) *
           glm::mat4_cast(glm::dquat(turn.w, turn.x, turn.y, turn.z)) * glm::scale(glm::dmat4(1), scale);
}

glm::dmat4 localOf(JsonReader& from) {
    std::vector<double> matrix;
    if (from.get("matrix", matrix)) {
        if (matrix.size() != 16)
            throw Error(from.locate("matrix"), "expected 16 numbers, found ", matrix.size());
        return glm::make_mat4(matrix.data());
    }
    glm::dvec3 translation(0), scale(1);
    glm::dvec4 turn(0, 0, 0, 1);
    from.get("translation", translation);
    from.get("scale", scale);
    from.get("rotation", turn);
    if (!(glm::length(turn) > 0)) throw Error(from.locate("rotation"), "expected a quaternion of length 1");
    return placed(translation, turn, scale);
}

bool isHidden(JsonReader& from) {
    std::optional<JsonReader> shown = gltfExtension(from, "KHR_node_visibility");
    bool visible = true;
    if (shown) shown->get("visible", visible);
    return !visible;
}

void placeNodes(GltfFile& file, std::vector<GltfNode>& nodes) {
    std::vector<char> done(nodes.size(), 0);
    std::vector<int> chain;  // of what has no place yet, upwards
    for (size_t i = 0; i < nodes.size(); ++i) {
        chain.clear();
        for (int ancestor = int(i); ancestor >= 0 && !done[size_t(ancestor)];
             ancestor = nodes[size_t(ancestor)].parent) {
            if (chain.size() > nodes.size())
                throw Error(file.item("nodes", int(i)).here(), "the node lies within itself");
            chain.push_back(ancestor);
        }
        for (auto link = chain.rbegin(); link != chain.rend(); ++link) {
            GltfNode& node = nodes[size_t(*link)];
            node.global = node.local;
            if (node.parent >= 0) {
                const GltfNode& parent = nodes[size_t(node.parent)];
                node.global = parent.global * node.local;
                node.hidden = node.hidden || parent.hidden;
            }
            done[size_t(*link)] = 1;
        }
    }
}

}  // namespace

std::vector<GltfNode> readGltfNodes(GltfFile& file) {
    std::vector<GltfNode> nodes(file.count("nodes"));
    for (size_t i = 0; i < nodes.size(); ++i) {
        JsonReader from = file.item("nodes", int(i));
        GltfNode& node = nodes[i];
        from.get("name", node.name);
        node.local = localOf(from);
        node.mesh = file.index(from, "mesh", "meshes");
        node.skin = file.index(from, "skin", "skins");
        node.hidden = isHidden(from);
        from.get("children", node.children, Range::between(0, double(nodes.size()) - 1));
        for (const int child : node.children) {
            if (nodes[size_t(child)].parent >= 0)
                throw Error(from.locate("children"), "node ", child, " is a child of two nodes, or twice");
            nodes[size_t(child)].parent = int(i);
        }
    }
    placeNodes(file, nodes);
    return nodes;
}

std::vector<int> gltfRoots(GltfFile& file, const std::vector<GltfNode>& nodes,
                           std::vector<std::string>& notes) {
    std::vector<int> out;
    JsonReader root = file.root();
    const size_t scenes = file.count("scenes");
    if (scenes > 0) {
        const int shown = std::max(file.index(root, "scene", "scenes"), 0);
        file.item("scenes", shown).get("nodes", out, Range::between(0, double(nodes.size()) - 1));
        if (scenes > 1)
            notes.push_back(concat("of its ", scenes, " scenes only that of number ", shown, " is read"));
        return out;
    }
    for (size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].parent < 0) out.push_back(int(i));
    return out;
}

std::vector<glm::dmat4> gltfPlaces(GltfFile& file, JsonReader& from, const GltfNode& node) {
    std::optional<JsonReader> instances = gltfExtension(from, "EXT_mesh_gpu_instancing");
    if (!instances) return {node.global};
    instances->require("attributes");
    JsonReader attributes = *instances->object("attributes");
    const GltfArray* arrays[3] = {};
    const char* const keys[] = {"TRANSLATION", "ROTATION", "SCALE"};
    size_t count = 0;
    for (int i = 0; i < 3; ++i) {
        const int accessor = file.index(attributes, keys[i], "accessors");
        if (accessor < 0) continue;
        arrays[i] = &file.array(accessor, {i == 1 ? size_t{4} : size_t{3}});
        if (count > 0 && arrays[i]->count != count)
            throw Error(attributes.locate(keys[i]), "has ", arrays[i]->count, " elements, the others ",
                        count);
        count = arrays[i]->count;
    }
    std::vector<glm::dmat4> out;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec4 turn = arrays[1] ? arrays[1]->vector(i) : glm::dvec4(0, 0, 0, 1);
        if (!(glm::length(turn) > 0))
            throw Error(attributes.locate(keys[1]), "expected quaternions of length 1");
        out.push_back(node.global * placed(arrays[0] ? glm::dvec3(arrays[0]->vector(i)) : glm::dvec3(0), turn,
                                           arrays[2] ? glm::dvec3(arrays[2]->vector(i)) : glm::dvec3(1)));
    }
    return out;
}

}  // namespace shoal
