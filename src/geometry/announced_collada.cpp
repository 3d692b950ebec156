#include <algorithm>
#include <cstdlib>
#include <map>
#include <pugixml.hpp>
#include <string_view>

#include "geometry/announced.h"

namespace shoal {

namespace {

// Returns the sum of what `value` makes of each number of a text.
template <typename Value>
size_t sumOf(const char* text, const Value& value) {
    size_t sum = 0;
    for (char* end = nullptr;; text = end) {
        const unsigned long number = std::strtoul(text, &end, 10);
        if (end == text) return sum;
        sum += value(size_t(number));
    }
}

size_t trianglesOfPolygon(size_t corners) {
    return corners > 2 ? corners - 2 : 0;
}

// Counts the triangles of a document's scene: of each geometry as often as nodes place it (COLLADA 1.4.1).
class ColladaCount {
  public:
    explicit ColladaCount(const pugi::xml_node& document) {
        learn(document);
        const pugi::xml_node scene =
            byId(document.child("scene").child("instance_visual_scene").attribute("url"));
        count_ = known_ && scene ? ofNode(scene, 0) : 0;
        known_ = known_ && scene;
    }

    std::optional<size_t> count() const { return known_ ? std::optional(count_) : std::nullopt; }

  private:
    void learn(const pugi::xml_node& node) {
        for (pugi::xml_node below = node.first_child(); below; below = below.next_sibling()) {
            if (const char* id = below.attribute("id").value(); *id) byId_.emplace(id, below);
            const std::string_view name = below.name();
            if (name.starts_with("library_") || name == "visual_scene" || name == "node") learn(below);
        }
    }

    pugi::xml_node byId(const pugi::xml_attribute& url) const {
        const auto found = byId_.find(*url.value() == '#' ? url.value() + 1 : "");
        return found == byId_.end() ? pugi::xml_node() : found->second;
    }

    size_t ofNode(const pugi::xml_node& node, int depth) {
        constexpr int deepest = 64;
        known_ = known_ && depth < deepest && ++visited_ < 1'000'000;
        size_t sum = 0;
        for (pugi::xml_node below = node.first_child(); below && known_; below = below.next_sibling()) {
            const std::string_view name = below.name();
            if (name == "node") sum += ofNode(below, depth + 1);
            if (name == "instance_node") sum += ofNode(target(below), depth + 1);
            if (name == "instance_geometry") sum += ofGeometry(target(below));
            if (name == "instance_controller") {
                const pugi::xml_node controller = target(below), skin = controller.child("skin");
                sum += ofGeometry(byId((skin ? skin : controller.child("morph")).attribute("source")));
            }
        }
        return sum;
    }

    // Returns what is placed; nothing where another document has it, whose triangles are not known.
    pugi::xml_node target(const pugi::xml_node& instance) {
        const pugi::xml_node out = byId(instance.attribute("url"));
        known_ = known_ && out;
        return out;
    }

    size_t ofGeometry(const pugi::xml_node& geometry) {
        const auto [counted, fresh] = counts_.try_emplace(geometry.hash_value(), 0);
        if (!fresh) return counted->second;
        const pugi::xml_node mesh = geometry.child("mesh");
        known_ = known_ && mesh;
        size_t sum = 0;
        for (pugi::xml_node below = mesh.first_child(); below; below = below.next_sibling())
            sum += ofPrimitive(below);
        return counted->second = sum;
    }

    size_t ofPrimitive(const pugi::xml_node& node) {
        const std::string_view name = node.name();
        if (name == "triangles" && node.child("p")) return node.attribute("count").as_uint();
        if (name == "polylist") return sumOf(node.child_value("vcount"), trianglesOfPolygon);
        if (name != "polygons" && name != "trifans" && name != "tristrips") return 0;
        known_ = known_ && !node.child("ph");  // with holes
        size_t indices = 1, sum = 0;           // of a corner
        for (const pugi::xml_node input : node.children("input"))
            indices = std::max(indices, size_t(input.attribute("offset").as_uint()) + 1);
        for (const pugi::xml_node p : node.children("p"))
            sum += trianglesOfPolygon(sumOf(p.child_value(), [](size_t) { return size_t(1); }) / indices);
        return sum;
    }

    std::map<std::string_view, pugi::xml_node> byId_;
    std::map<size_t, size_t> counts_;  // of triangles, by geometry
    bool known_ = true;
    size_t count_ = 0;
    int visited_ = 0;
};

}  // namespace

std::optional<size_t> trianglesOfCollada(const std::string& text) {
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size())) return std::nullopt;
    const pugi::xml_node root = document.child("COLLADA");
    return root ? ColladaCount(root).count() : std::nullopt;
}

}  // namespace shoal
