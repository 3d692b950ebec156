#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "window/edit_widgets.h"
#include "window/interface.h"
#include "window/panel.h"

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

// A life from birth to death as a bar, over dark and light, with a mark at each keyframe.
void drawBar(const std::vector<ColorKey>& keys) {
    constexpr int steps = 48;
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

bool drawImage(ParticleImage& image, KeyRows& rows) {
    const std::string file = std::filesystem::path(image.file).filename().string();
    beginRow(rowOf(*describe(static_cast<const ParticleType*>(nullptr)).find("image")));
    ImGui::TextUnformatted(concat(file, ", tiles ", image.firstTile, " to ", image.lastTile).c_str());
    // with other tiles the pixels would be read anew
    return rows.draw(image, {{"columns", {}}, {"rows", {}}});
}

// Keyframes as rows below a bar that shows them.
bool drawColors(std::vector<ColorKey>& keys, KeyRows& rows) {
    bool changed = false;
    drawBar(keys);
    for (size_t k = 0; k < keys.size(); ++k) {
        ImGui::PushID(int(k));
        const auto age = [&] {
            double share = keys[k].age;
            const Key& key = *describe(&keys[k]).find("age");
            const Row row{key.name.c_str(), key.says.sentence.c_str(), "%.0f %%", false, 100};
            if (keys.size() == 1 || !slide(row, limitOf(key), share)) return false;
            keys[k].age = ageBetween(keys, k, share);
            return true;
        };
        changed |= rows.draw(keys[k], {{"age", age}});
        if (keys.size() > 1 && ImGui::SmallButton("Remove this keyframe")) {
            keys.erase(keys.begin() + std::ptrdiff_t(k--));
            changed = true;
        }
        ImGui::PopID();
    }
    if (keys.size() < mostColorKeys && ImGui::SmallButton("Add a keyframe")) {
        addColorKey(keys);
        changed = true;
    }
    return changed;
}

}  // namespace

bool drawParticles(ParticleType& type, bool ages, KeyRows& rows) {
    KeyRows::Owns owns = {{"colors", [&] { return drawColors(type.colors, rows); }},
                          {"image", [&] { return type.image && drawImage(*type.image, rows); }}};
    if (!ages) owns["growth"] = {};
    return rows.draw(type, owns);
}

}  // namespace shoal::window
