#include "window/new_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/data_paths.h"
#include "core/json_build.h"
#include "molecule/molecule_file.h"
#include "window/orbit_camera.h"

namespace shoal::window {

namespace fs = std::filesystem;

glm::dvec3 toMillimetre(const glm::dvec3& place) {
    return glm::round(place * 1e3) / 1e3;
}

std::string freeName(const JsonValue& list, const std::string& wanted) {
    const auto taken = [&](const std::string& name) {
        return std::any_of(list.items.begin(), list.items.end(), [&](const JsonValue& item) {
            const JsonValue* own = item.find("name");
            return own && own->text == name;
        });
    };
    std::string out = wanted;
    for (int i = 2; taken(out); ++i)
        out = concat(wanted, " ", i);
    return out;
}

std::vector<std::string> moleculesFor(const std::string& sceneFile) {
    const fs::path folder = fs::absolute(sceneFile).parent_path();
    std::vector<std::string> out = shippedMolecules();
    std::error_code code;
    if (fs::equivalent(folder, moleculeFolder(), code)) return out;
    for (const auto& entry : fs::directory_iterator(folder, code)) {
        if (entry.path().extension() != ".json" || !entry.is_regular_file(code)) continue;
        std::array<char, 512> start{};
        std::ifstream(entry.path()).read(start.data(), start.size() - 1);
        if (std::string_view(start.data()).find("\"shoal-molecule-1\"") == std::string_view::npos) continue;
        out.push_back(entry.path().filename().string());
    }
    return out;
}

JsonValue groupOf(const JsonValue& groups, const std::string& molecule, const Scene& scene) {
    JsonValue out = object(key("name", freeName(groups, fs::path(molecule).stem().string())),
                           key("molecule", molecule), key("count", 100));
    Molecule shape;
    try {
        shape = readMolecule(moleculeFile(molecule, scene.file));
    } catch (const Error&) {
        return out;  // whoever reads the group will say why
    }
    glm::dvec3 least = shape.vertices[0].position, most = least;
    for (const Vertex& vertex : shape.vertices)
        least = glm::min(least, vertex.position), most = glm::max(most, vertex.position);
    const bool ball = shape.triangles.empty();
    const double size = glm::length(most - least) + (ball ? shape.material.pointSize : 0);
    // to be seen: a hundred of them lie apart, and none is smaller than a hundredth of how far they are
    const glm::dvec3 target = scene.camera.target;
    const double scale = std::max(1.0, 0.01 * glm::distance(scene.camera.eye, target) / size);
    const double side = std::stod(formatted("%.2g", 10 * scale * size));
    const double ground = groundHeight(scene, target.x, target.z);
    const double bottom =
        std::max(target.y - side / 2, std::isfinite(ground) ? ground + scale * size : target.y - side / 2);
    const glm::dvec3 low = toMillimetre({target.x - side / 2, bottom, target.z - side / 2});
    JsonValue place = object(key("on", "volume"),
                             key("box", object(key("low", low), key("high", toMillimetre(low + side)))));
    if (scale > 1) place.add("scale", toJson(std::stod(formatted("%.2g", scale))));
    if (!ball) place.add("turn", JsonValue::makeString("any"));
    setMember(out, "place", std::move(place));
    if (shape.hasPins()) setMember(out, "held", JsonValue::makeBoolean(false));
    const bool swims = std::any_of(shape.springs.begin(), shape.springs.end(),
                                   [](const Spring& spring) { return spring.actuation.has_value(); });
    // as in the scenes that ship: leaves, fry, snow
    const double along = swims ? 1 : 0.9, across = swims ? 40 : 9;
    setMember(out, "drag",
              ball ? JsonValue::makeNumber(3) : object(key("normal", across), key("tangent", along)));
    return out;
}

JsonValue newEmitter(const JsonValue& emitters) {
    const JsonValue* from = emitters.items.empty() ? nullptr : emitters.items.back().find("from");
    if (from && from->text != "death") {
        JsonValue like = emitters.items.back();
        leaveOut(like, "name");
        return like;
    }
    return object(key("from", "point"), key("position", glm::dvec3(0, 1, 0)), key("rate", 20),
                  key("speed", glm::dvec2(1, 2)));
}

void standInView(JsonValue& collider, const Scene& scene) {
    const std::vector<double> size =
        collider.find("size") ? numbersOf(*collider.find("size")) : std::vector{0.0, 0.0};
    const JsonValue* radius = collider.find("radius");
    const double below = radius ? radius->number : size[1] / 2;
    const glm::dvec3 target = scene.camera.target;
    const double ground = groundHeight(scene, target.x, target.z);
    const glm::dvec3 foot(target.x, (std::isfinite(ground) ? ground : target.y) + below, target.z);
    if (collider.find("center")) setMember(collider, "center", toJson(toMillimetre(foot)));
    if (!collider.find("from")) return;
    setMember(collider, "from", toJson(toMillimetre(foot)));
    setMember(collider, "to", toJson(toMillimetre(foot + glm::dvec3(0, 1, 0))));
}

}  // namespace shoal::window
