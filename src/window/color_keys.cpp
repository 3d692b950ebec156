#include "window/color_keys.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/description.h"
#include "core/json_build.h"
#include "scene/particle.h"
#include "window/edit_widgets.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

ImU32 shown(const glm::dvec4& color, const glm::dvec3& behind) {
    std::array<float, 3> out{};
    for (int i = 0; i < 3; ++i) {
        const double light = color[i] * color.w + behind[i] * (1 - color.w);
        out[size_t(i)] = float(std::pow(std::clamp(light, 0.0, 1.0), 1 / 2.2));
    }
    return ImGui::GetColorU32(ImVec4(out[0], out[1], out[2], 1));
}

glm::dvec4 colorAt(const std::vector<ColorKey>& keys, double age) {
    const auto value = [](const ColorKey& key) { return glm::dvec4(key.color, key.opacity); };
    if (age <= keys.front().age) return value(keys.front());
    for (size_t i = 0; i + 1 < keys.size(); ++i)
        if (age < keys[i + 1].age)
            return glm::mix(value(keys[i]), value(keys[i + 1]),
                            (age - keys[i].age) / (keys[i + 1].age - keys[i].age));
    return value(keys.back());
}

// None where they cannot be read as they are.
std::vector<ColorKey> keysOf(const JsonValue& colors) {
    std::vector<ColorKey> out(colors.items.size());
    try {
        for (size_t i = 0; i < out.size(); ++i) {
            JsonReader reader(colors.items[i], "");
            describe(&out[i]).read(reader, out[i]);
        }
    } catch (const Error&) {
        out.clear();
    }
    return out;
}

}  // namespace

void drawColorBar(const JsonValue& colors) {
    constexpr int steps = 48;
    const std::vector<ColorKey> keys = keysOf(colors);
    if (keys.empty()) return;
    const float width = ImGui::GetContentRegionAvail().x, height = points(18), mark = points(4);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < steps; ++i) {
        const float x0 = corner.x + width * float(i) / steps, x1 = corner.x + width * float(i + 1) / steps;
        const glm::dvec4 a = colorAt(keys, double(i) / steps), b = colorAt(keys, double(i + 1) / steps);
        for (int half = 0; half < 2; ++half) {
            const glm::dvec3 behind(half == 0 ? 0.02 : 0.5);
            const float y0 = corner.y + 0.5f * height * float(half), y1 = y0 + 0.5f * height;
            list.AddRectFilledMultiColor(ImVec2(x0, y0), ImVec2(x1, y1), shown(a, behind), shown(b, behind),
                                         shown(b, behind), shown(a, behind));
        }
    }
    for (const ColorKey& key : keys) {
        const float x = corner.x + width * float(key.age), y = corner.y + height;
        list.AddTriangleFilled(ImVec2(x - mark, y + 1.5f * mark), ImVec2(x, y - 0.5f * mark),
                               ImVec2(x + mark, y + 1.5f * mark), ImGui::GetColorU32(ImGuiCol_Text));
    }
    ImGui::InvisibleButton("bar", ImVec2(width, height + 1.5f * mark));
    tip("Colour and opacity from birth to death, over black and over grey.");
}

void addColorKey(JsonValue& colors) {
    const std::vector<ColorKey> before = keysOf(colors);
    std::vector<ColorKey> keys = before;
    if (keys.empty()) keys.resize(1);
    shoal::addColorKey(keys);
    size_t added = 0;
    while (added < before.size() && keys[added].age == before[added].age)
        ++added;
    if (keys.size() == before.size()) return;
    colors.items.insert(colors.items.begin() + std::ptrdiff_t(added),
                        object(key("age", keys[added].age), key("color", keys[added].color),
                               key("opacity", keys[added].opacity)));
}

void keepAge(JsonValue& colors, size_t index) {
    const std::vector<ColorKey> keys = keysOf(colors);
    if (keys.empty() || !colors.items[index].find("age")) return;
    setMember(colors.items[index], "age", toJson(ageBetween(keys, index, keys[index].age)));
}

}  // namespace shoal::window
