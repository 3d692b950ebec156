#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "window/edit_widgets.h"
#include "window/editor/editor.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

void drawFinding(Editor& editor, const Finding& finding, size_t index) {
    ImGui::PushID(int(index));
    ImGui::TextColored(warm, "!");
    ImGui::SameLine();
    ImGui::TextWrapped("%s", finding.warning.message.c_str());
    if (ImGui::IsItemHovered()) {
        editor.overlay.marked.insert(finding.vertices.begin(), finding.vertices.end());
        editor.overlay.markedSprings.insert(finding.springs.begin(), finding.springs.end());
        editor.overlay.markedTriangles.insert(finding.triangles.begin(), finding.triangles.end());
    }
    if (finding.mend && ImGui::SmallButton(finding.remedy.c_str())) {
        const auto mend = finding.mend;  // the findings are made anew by the edit
        editor.document.edit(finding.remedy, mend);
    }
    ImGui::PopID();
}

int substepsFor(double stable) {
    return int(std::min(1e6, std::ceil(1.0 / 60 / stable)));
}

// Whether the springs are too stiff for the step, and what would do.
void drawStep(Editor& editor) {
    const Analysis& a = editor.analysis;
    if (a.springs == 0) return;
    const double step = 1.0 / 60 / editor.stage.substeps;
    const bool refused = editor.stage.solver && !solver(*editor.stage.solver).implicit;
    if (step <= a.stableStepLeapfrog) return;
    const int needed = substepsFor(a.stableStepLeapfrog);
    ImGui::TextColored(refused ? red : warm, "!");
    ImGui::SameLine();
    ImGui::TextWrapped("Too stiff for leapfrog in %s: it takes %d%s",
                       many(editor.stage.substeps, "substep", "substeps").c_str(), needed,
                       refused ? "." : "; an implicit solver was chosen, which damps.");
    const std::string more = concat("Use ", many(needed, "substep", "substeps"));
    if (needed <= 200 && ImGui::SmallButton(more.c_str())) editor.stage.substeps = needed;
    if (refused && ImGui::SmallButton("Use bdf2-xpbd")) editor.stage.solver = SolverKind::bdf2Xpbd;
    const double factor = std::pow(0.95 * a.stableStepLeapfrog / step, 2);
    const std::string softer = concat("Make springs ", plain(1 / factor), " times softer");
    if (ImGui::SmallButton(softer.c_str()))
        editor.document.edit("soften springs", [factor](Draft& draft) {
            for (Spring& spring : draft.molecule.springs) {
                spring.stiffness *= factor;
                spring.damping *= std::sqrt(factor);
            }
        });
}

void drawModes(Editor& editor) {
    heading("Motions");
    if (editor.modes.empty()) {
        ImGui::TextDisabled("none to show");
        return;
    }
    ImGui::TextDisabled("the slowest; play one to see it");
    for (size_t i = 0; i < editor.modes.size(); ++i) {
        const Mode& mode = editor.modes[i];
        ImGui::PushID(int(i));
        const bool on = editor.wobbling == i;
        if (toggle(on ? "stop" : "play", on)) editor.wobbling = on ? std::nullopt : std::optional(i);
        ImGui::SameLine();
        if (mode.frequency == 0)
            ImGui::TextColored(warm, "soft: nothing resists it");
        else
            ImGui::Text("%s Hz", plain(mode.frequency / (2 * std::numbers::pi)).c_str());
        ImGui::PopID();
    }
}

void drawFacts(const Editor& editor) {
    heading("Numbers");
    const Analysis& a = editor.analysis;
    ImGui::TextUnformatted(concat(many(a.vertices, "vertex", "vertices"), ", ",
                                  many(a.springs, "spring", "springs"), ", ",
                                  many(a.triangles, "triangle", "triangles"))
                               .c_str());
    ImGui::Text("mass %s kg, size %s m", plain(a.totalMass).c_str(),
                plain(editor.document.molecule().size()).c_str());
    if (a.springs == 0) return;
    ImGui::Text("rest energy %s J", plain(a.restEnergy).c_str());
    ImGui::Text("%s to %s Hz, %d soft", plain(hertz(a.lowestFrequency)).c_str(),
                plain(hertz(a.highestFrequency)).c_str(), a.zeroModes);
    ImGui::Text("stable step: leapfrog %s s", plain(a.stableStepLeapfrog).c_str());
}

// Offers to measure the molecule's cost, and shows how much of it a frame of 1/60 s holds.
EditorAction drawCost(Editor& editor) {
    heading("Cost");
    EditorAction action = EditorAction::none;
    if (ImGui::Button("Measure here")) action = EditorAction::measure;
    tip("Steps a few thousand of it on this machine, without drawing.");
    if (!editor.cost) return action;
    const MoleculeCost& cost = *editor.cost;
    ImGui::SameLine();
    ImGui::TextDisabled(editor.costVersion == editor.version ? "%d at once" : "before the last change",
                        cost.measuredAt);
    constexpr double budget = 1.0 / 60;
    const Analysis& a = editor.analysis;
    for (const int count : {1000, 100000}) {
        const double time = cost.secondsPerMolecule * count, room = budget / time;
        ImGui::TextColored(room < 1 ? warm : calm, "%s: %s ms a frame", count == 1000 ? "1,000" : "100,000",
                           plain(time * 1e3).c_str());
        const int vertices = std::max(1, int(a.vertices * room)), springs = int(a.springs * room);
        const std::string words =
            room < 1 ? concat("60 Hz would hold ", int64_t(budget / cost.secondsPerMolecule),
                              " of them, or as many with about ", many(vertices, "vertex", "vertices"),
                              " and ", many(springs, "spring", "springs"))
                     : concat("60 Hz would hold about ", many(vertices, "vertex", "vertices"), " and ",
                              many(springs, "spring", "springs"), " each");
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
        ImGui::TextWrapped("%s", words.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::TextDisabled("%s", cost.machine.c_str());
    return action;
}

}  // namespace

EditorAction drawAdvice(Editor& editor) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const PanelArea panels = panelArea();
    beginPanel("Advice", {screen.x - panels.right, 0}, {panels.right, screen.y - panels.bottom});
    editor.overlay.marked.clear();
    editor.overlay.markedSprings.clear();
    editor.overlay.markedTriangles.clear();
    const size_t count = editor.findings.size();
    if (!editor.document.problem().empty())
        ImGui::TextColored(red, "see the left panel");
    else if (count == 0)
        ImGui::TextColored(calm, "nothing to mend");
    for (size_t i = 0; i < count && i < editor.findings.size(); ++i)
        drawFinding(editor, editor.findings[i], i);
    drawStep(editor);
    drawFacts(editor);
    drawModes(editor);
    const EditorAction action = drawCost(editor);
    ImGui::End();
    return action;
}

}  // namespace shoal::window
