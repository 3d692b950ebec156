#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "window/edit_widgets.h"
#include "window/interface.h"
#include "window/panel.h"

namespace shoal::window {

namespace {

constexpr size_t shownFrames = 180;

ImU32 colorOf(size_t pass) {
    constexpr double golden = 0.61803398875;  // turns of the hue: neighbours differ, and none comes again
    float r = 0, g = 0, b = 0;
    ImGui::ColorConvertHSVtoRGB(float(std::fmod(0.27 + golden * double(pass), 1.0)), 0.55f, 0.85f, r, g, b);
    return ImGui::GetColorU32(ImVec4(r, g, b, 1));
}

double valueAt(const gpu::PassTime& stage, size_t fromEnd) {
    return fromEnd < stage.values.size() ? stage.values[stage.values.size() - 1 - fromEnd] : 0;
}

void drawPlot(const std::vector<gpu::PassTime>& all) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = points(64);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(corner, ImVec2(corner.x + width, corner.y + height),
                       ImGui::GetColorU32(ImGuiCol_FrameBg));
    std::vector<double> totals(shownFrames, 0);
    for (const gpu::PassTime& stage : all)
        for (size_t i = 0; i < shownFrames; ++i)
            totals[i] += valueAt(stage, i);
    // a frame that stalled does not flatten all others
    std::vector<double> sorted = totals;
    sorted.erase(std::remove(sorted.begin(), sorted.end(), 0.0), sorted.end());  // there were no such frames
    std::sort(sorted.begin(), sorted.end());
    const double top = std::max(sorted.empty() ? 0 : 1.25 * sorted[(sorted.size() - 1) * 95 / 100], 1e-5);
    const float step = width / float(shownFrames);
    for (size_t i = 0; i < shownFrames; ++i) {
        const float right = corner.x + width - step * float(i);
        double below = 0;
        for (size_t s = 0; s < all.size(); ++s) {
            const double value = std::min(valueAt(all[s], i), top - below);
            if (!(value > 0)) continue;
            const auto y = [&](double v) { return corner.y + height * float(1 - v / top); };
            list.AddRectFilled(ImVec2(right - step, y(below + value)), ImVec2(right, y(below)), colorOf(s));
            below += value;
        }
    }
    const std::string scale =
        concat(top < 0.0995 ? std::round(1e5 * top) / 100 : std::round(1e3 * top), " ms");
    list.AddText(ImVec2(corner.x + points(4), corner.y + points(2)), ImGui::GetColorU32(ImGuiCol_Text),
                 scale.c_str());
    ImGui::InvisibleButton("times", ImVec2(width, height));
    tip(concat("Time of the passes in the last ", shownFrames, " frames, the newest at the right."));
}

}  // namespace

void drawTimes(const gpu::PassTimers& simulation, const gpu::PassTimers& drawing) {
    const std::vector<gpu::PassTime> all = gpu::stagesOf(simulation, &drawing);
    drawPlot(all);
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("stage");
    ImGui::TableSetupColumn("calls");
    ImGui::TableSetupColumn("ms a frame");
    ImGui::TableHeadersRow();
    for (size_t s = 0; s < all.size(); ++s) {
        const gpu::PassTime& pass = all[s];
        ImGui::TableNextColumn();
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float side = ImGui::GetFontSize() * 0.6f, down = ImGui::GetFontSize() * 0.25f;
        ImGui::GetWindowDrawList()->AddRectFilled(
            ImVec2(corner.x, corner.y + down), ImVec2(corner.x + side, corner.y + down + side), colorOf(s));
        ImGui::Dummy(ImVec2(side, 0));
        ImGui::SameLine();
        ImGui::TextUnformatted(pass.name.c_str());
        ImGui::TableNextColumn();
        ImGui::Text("%d", pass.calls);
        ImGui::TableNextColumn();
        ImGui::Text("%.3f", pass.median * 1e3);
    }
    ImGui::EndTable();
}

}  // namespace shoal::window
