#include "app/material_editor.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/edit_widgets.h"

namespace shoal::app {

namespace {

bool pickColor(const char* label, const char* tip, const glm::dvec3& shown,
               std::optional<glm::dvec3>& color) {
    std::array<float, 3> value{float(shown.x), float(shown.y), float(shown.z)};
    beginRow({label, tip});
    if (!ImGui::ColorEdit3(concat("##", label).c_str(), value.data(), ImGuiColorEditFlags_Float))
        return false;
    glm::dvec3 out(0);
    for (int i = 0; i < 3; ++i)
        out[i] = std::clamp(std::round(double(value[size_t(i)]) * 1000) / 1000, 0.0, 1.0);
    color = out;
    return true;
}

}  // namespace

bool drawMaterial(Group& group, GroupChoice& choice) {
    Material& material = group.molecule.material;
    const glm::dvec3 first = group.color.value_or(material.color);
    const glm::dvec3 second =
        group.secondColor.value_or(group.color.value_or(material.secondColor.value_or(material.color)));
    bool changed = false;
    if (!group.colorBy) {
        changed |=
            pickColor("color", "Linear light; instances lie between this and the next.", first, group.color);
        changed |= pickColor("second color", "Linear light.", second, group.secondColor);
    }
    const auto share = [&](const Row& row, double& value, std::optional<double>& chosen) {
        if (!slide(row, {0, 1}, value)) return;
        chosen = value;
        changed = true;
    };
    share({"roughness", "Not saved here: the molecule's file has its own."}, material.roughness,
          choice.roughness);
    if (!group.molecule.triangles.empty())
        share({"translucency", "Light from behind. Not saved here: the molecule's file has its own."},
              material.translucency, choice.translucency);
    if (material.blend != Blend::none)
        share({"opacity", "Not saved here: the molecule's file has its own."}, material.opacity,
              choice.opacity);
    return changed;
}

}  // namespace shoal::app
