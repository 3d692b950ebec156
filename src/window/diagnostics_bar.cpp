#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "window/edit_widgets.h"
#include "window/panel.h"

namespace shoal::window {

// From green through yellow to red, by the share of the bar.
static ImVec4 colorOf(float share) {
    return {std::min(1.0f, 2 * share) * 0.75f, std::min(1.0f, 2 - 2 * share) * 0.6f, 0.15f, 1};
}

void drawDiagnostics(const measure::Diagnostics& diagnostics) {
    using measure::Diagnostic;
    constexpr double least = -6, most = 0;  // decades of the error that the bar shows
    if (!diagnostics.reading()) return;
    const measure::Reading& reading = *diagnostics.reading();
    const std::string words = shortText(reading);
    if (const std::optional<double>& error = reading[Diagnostic::error]) {
        const double decade = std::log10(std::max(*error, 1e-300));
        const auto share = float(std::clamp((decade - least) / (most - least), 0.0, 1.0));
        ImGui::PushStyleColor(ImGuiCol_PlotHistogram, colorOf(share));
        ImGui::ProgressBar(share, ImVec2(-1, 0), words.c_str());
        ImGui::PopStyleColor();
    } else {
        ImGui::TextDisabled("%s", words.empty() ? "nothing to tell yet" : words.c_str());
    }
    tip(joined(text(reading), "\n"));
}

}  // namespace shoal::window
