// Rows for what a file may say of a struct, by its description: the key in words, its sentence as a tip, and
// a slider within its limits. Keys that mean nothing beside the others are not drawn.
#pragma once

#include <functional>
#include <map>
#include <string>

#include <imgui.h>

#include "core/description.h"

namespace shoal::window {

class KeyRows {
  public:
    // Draws a key in its own way; true: the user changed it.
    using Own = std::function<bool()>;
    using Owns = std::map<std::string, Own>;  // by the name of the key; an empty function leaves it out

    // Whether the user changed the object in this frame. What would break a rule between its keys is taken
    // back, and said.
    template <typename S>
    bool draw(S& object, const Owns& owns = {}) {
        const Description& keys = describe(&object);
        const S before = object;
        if (!drawKeys(keys, &object, owns)) return false;
        const std::string broken = ruleBroken([&] { keys.check(object, Where(), largestNumber); });
        if (broken.empty()) return true;
        object = before;
        ImGui::SetTooltip("%s", broken.c_str());
        return false;
    }

  private:
    bool drawKeys(const Description& keys, void* object, const Owns& owns);
    bool drawKey(const Key& key, void* object);
    bool drawPresence(const Key& key, void* object);
    bool drawValue(const Key& key, const std::string& label, void* value, const Slider& slider);
    bool drawList(const Key& key, void* list);
    static std::string ruleBroken(const std::function<void()>& check);

    // By the row's place in the window, since a slider that follows its number would run away.
    std::map<ImGuiID, Slider> sliders_;
    std::map<ImGuiID, glm::dvec2> angles_;  // rad
};

std::string inWords(const std::string& key);  // "separationRadius" as "separation radius"

}  // namespace shoal::window
