#include "window/new_elements.h"

#include <algorithm>
#include <filesystem>

#include "core/json_build.h"
#include "window/scene_document.h"

namespace shoal::window {

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

JsonValue smallestGroup(const JsonValue& groups, const std::string& molecule) {
    const JsonValue box = object(key("low", glm::dvec3(-1, 0.5, -1)), key("high", glm::dvec3(1, 2.5, 1)));
    return object(key("name", freeName(groups, std::filesystem::path(molecule).stem().string())),
                  key("molecule", molecule), key("place", object(key("on", "volume"), key("box", box))),
                  key("count", 100));
}

JsonValue newEmitter(const JsonValue& emitters) {
    const JsonValue* from = emitters.items.empty() ? nullptr : emitters.items.back().find("from");
    if (from && from->text != "death") {
        JsonValue like = emitters.items.back();
        leaveOut(like, "name");
        return like;
    }
    return object(key("from", "point"), key("position", glm::dvec3(0, 1, 0)),
                  key("rate", 20), key("speed", glm::dvec2(1, 2)));
}

}  // namespace shoal::window
