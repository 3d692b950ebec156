#include "window/editor/editor.h"

#include <algorithm>
#include <filesystem>

#include "scene/solver.h"
#include "window/edit_widgets.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

EditorAction drawHead(Editor& editor) {
    EditorAction action = EditorAction::none;
    Document& document = editor.document;
    const std::string name = std::filesystem::path(document.file()).filename().string();
    ImGui::Text("%s%s", name.c_str(), document.unsaved() ? " *" : "");
    tip(document.file());
    const auto button = [&](const char* label, bool can, EditorAction what, const std::string& words) {
        ImGui::BeginDisabled(!can);
        const bool pressed = ImGui::Button(label);
        if (pressed) action = what;
        ImGui::EndDisabled();
        tip(words);
        ImGui::SameLine();
        return pressed;
    };
    button("Save", document.unsaved() && document.problem().empty(), EditorAction::save,
           "Into the molecule's file (Ctrl+S).");
    const std::string back = document.undoLabel(), again = document.redoLabel();
    button("Undo", !back.empty(), EditorAction::undo, "Takes the last change back (Ctrl+Z). " + back);
    button("Redo", !again.empty(), EditorAction::redo, "Does it again (Ctrl+Y). " + again);
    if (button("Help", true, EditorAction::none, "All keys (F1).")) editor.help = !editor.help;
    ImGui::NewLine();
    if (!document.problem().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, red);
        ImGui::TextWrapped("Cannot be saved as it is: %s", document.problem().c_str());
        ImGui::PopStyleColor();
    }
    return action;
}

// Draws the buttons that change the whole shape; a change that fails says why.
void drawReshaping(Editor& editor) {
    const auto button = [&](const char* label, const char* words, const auto& change) {
        const bool pressed = ImGui::Button(label);
        tip(words);
        if (!pressed) return;
        Draft tried = editor.document.draft();
        const std::string why = change(tried);
        editor.message = why;
        if (!why.empty()) return;
        editor.overlay.selection = {};
        editor.document.edit(label, [&](Draft& draft) { draft = tried; });
    };
    button("Mirror", "The side above 0 along the axis of symmetry becomes the image of that below.",
           [&](Draft& draft) { return mirrorSide(draft, editor.mirrorAxis); });
    ImGui::SameLine();
    button("Subdivide", "Each selected triangle, or all, becomes four.",
           [&](Draft& draft) { return subdivide(draft, editor.overlay.selection.triangles); });
    ImGui::SameLine();
    button("Weigh", "Masses by area, at so many kg a square metre.",
           [&](Draft& draft) { return weigh(draft, editor.density); });
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    const double least = 1e-6, most = 1e6;
    ImGui::DragScalar("##density", ImGuiDataType_Double, &editor.density, 0.01f, &least, &most, "%.3g",
                      ImGuiSliderFlags_Logarithmic);
    tip("How heavy a square metre is that Weigh makes, in kg/m².");
}

void drawToolButtons(Editor& editor) {
    heading("Tools");
    struct Entry {
        Tool tool;
        const char *label, *words;
    };
    constexpr Entry entries[] = {
        {Tool::select, "Select", "Click to select, Shift adds; drag what is selected to move it (V)."},
        {Tool::vertex, "Vertex", "Click to add a vertex (A)."},
        {Tool::spring, "Spring", "Drag from vertex to vertex, or click one after the other (S)."},
        {Tool::triangle, "Triangle", "Click three vertices, anticlockwise (T)."}};
    for (const Entry& entry : entries) {
        if (toggle(entry.label, editor.tool == entry.tool))
            editor.tool = entry.tool, editor.overlay.chain.clear();
        tip(entry.words);
        ImGui::SameLine();
    }
    ImGui::NewLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Symmetry");
    tip("What is done on one side is done on the other (M).");
    constexpr const char* axes[] = {"none", "x", "y", "z"};
    for (int i = 0; i < 4; ++i) {
        ImGui::SameLine();
        if (ImGui::RadioButton(axes[i], editor.mirrorAxis == i - 1)) editor.mirrorAxis = i - 1;
    }
    drawReshaping(editor);
    ImGui::Checkbox("Snap to", &editor.snaps);
    tip("Added and moved vertices go to a grid (G).");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(points(90));
    const double least = 1e-6, most = 10;
    ImGui::DragScalar("##grid", ImGuiDataType_Double, &editor.grid, 0.001f, &least, &most, "%.4g m",
                      ImGuiSliderFlags_Logarithmic);
    EditorOverlay& o = editor.overlay;
    ImGui::Checkbox("springs", &o.springs);
    ImGui::SameLine();
    ImGui::Checkbox("vertices", &o.vertices);
    ImGui::SameLine();
    ImGui::Checkbox("normals", &o.normals);
    tip("Which way triangles face (N).");
    ImGui::Checkbox("numbers", &o.numbers);
    ImGui::SameLine();
    ImGui::Checkbox("tension", &o.tension);
    tip("Springs by their strain: blue squeezed, green slack, red stretched.");
    if (!o.tension) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    double percent = o.strainShown * 100;
    const double lowest = 0.1, highest = 100;
    if (ImGui::SliderScalar("##strain", ImGuiDataType_Double, &percent, &lowest, &highest, "red at %.3g %%",
                            ImGuiSliderFlags_Logarithmic))
        o.strainShown = percent / 100;
}

}  // namespace

PanelArea panelArea() {
    return {points(292), points(308), points(92)};
}

void beginPanel(const char* title, const ImVec2& place, const ImVec2& size, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos(place);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(title, nullptr,
                 flags | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
}

EditorAction drawTools(Editor& editor) {
    const float height = ImGui::GetIO().DisplaySize.y - panelArea().bottom;
    beginPanel("Molecule", {0, 0}, {panelArea().left, height});
    EditorAction action = drawHead(editor);
    drawToolButtons(editor);
    drawSelection(editor);
    ImGui::End();
    return action;
}

// ---- Playing

namespace {

EditorAction drawButtons(EditorStage& stage) {
    EditorAction action = EditorAction::none;
    if (ImGui::Button("Rewind")) action = EditorAction::rewind;
    tip("Back to the rest shape (Home).");
    ImGui::SameLine();
    if (ImGui::Button("Back")) action = EditorAction::back;
    tip("One frame back (,).");
    ImGui::SameLine();
    if (ImGui::Button(stage.playing ? "Pause" : "Play ")) action = EditorAction::play;
    tip("Lets it move, or stand still (Space).");
    ImGui::SameLine();
    if (ImGui::Button("Step")) action = EditorAction::step;
    tip("One frame on (.).");
    return action;
}

void drawSurroundings(StageSettings& s) {
    constexpr const char* words[] = {"still", "in wind", "dropped"};
    int around = int(s.around);
    ImGui::SetNextItemWidth(points(90));
    if (ImGui::Combo("##around", &around, words, 3)) s.around = StageSettings::Around(around);
    const auto slider = [](const char* label, double& value, double most, const char* format) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(points(130));
        const double least = 0;
        ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most, format);
    };
    if (s.around == StageSettings::Around::wind) {
        slider("##wind", s.wind, 30, "wind %.1f m/s");
        slider("##drag", s.drag, 40, "drag %.1f /s");
    }
    if (s.around != StageSettings::Around::still) slider("##gravity", s.gravity, 30, "gravity %.2f");
    ImGui::SameLine();
    ImGui::Checkbox("pins hold", &s.pinsHold);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(points(110));
    ImGui::SliderInt("##substeps", &s.substeps, 1, 200, s.substeps == 1 ? "%d substep" : "%d substeps",
                     ImGuiSliderFlags_Logarithmic);
}

void drawSolver(StageSettings& s, const EditorStage& stage) {
    ImGui::SetNextItemWidth(points(140));
    const std::string current = s.solver ? name(*s.solver) : concat("auto: ", name(stage.solver()));
    if (ImGui::BeginCombo("##solver", current.c_str())) {
        if (ImGui::Selectable("auto", !s.solver)) s.solver.reset();
        for (const Solver& solver : solvers()) {
            // Its matrix does not follow springs that are changed while it runs.
            if (solver.kind == SolverKind::bdf2Corotated) continue;
            if (ImGui::Selectable(solver.name, s.solver == solver.kind)) s.solver = solver.kind;
        }
        ImGui::EndCombo();
    }
    tip(stage.solverWhy());
}

}  // namespace

EditorAction drawTransport(Editor& editor, EditorStage& stage, Troubles& troubles) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const PanelArea panels = panelArea();
    beginPanel("Play", {0, screen.y - panels.bottom}, {screen.x, panels.bottom},
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar);
    EditorAction action = EditorAction::none;
    if (stage.ready()) {
        action = drawButtons(stage);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-1);
        int frame = stage.frame();
        ImGui::BeginDisabled(stage.frames() < 2);
        const std::string format = concat("frame %d, ", plain(stage.time()), " s");
        if (ImGui::SliderInt("##frame", &frame, 0, std::max(1, stage.frames() - 1), format.c_str(),
                             ImGuiSliderFlags_AlwaysClamp)) {
            stage.playing = false;
            stage.seek(frame);
        }
        ImGui::EndDisabled();
        drawSurroundings(editor.stage);
        ImGui::SameLine();
        drawSolver(editor.stage, stage);
    }
    if (!editor.message.empty()) ImGui::TextColored(calm, "%s", editor.message.c_str());
    ImGui::End();
    if (showNotices({}, troubles.text(), panels.left + points(12), panels.right + points(12)))
        troubles.clear();
    return action;
}

void drawHelp(Editor& editor) {
    if (!editor.help) return;
    const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::Begin("Keys", &editor.help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    constexpr const char* keys[][2] = {
        {"V A S T", "select, add vertex, spring, triangle"},
        {"Shift + click", "add to what is selected"},
        {"Ctrl + drag", "select all in a box"},
        {"drag", "move what is selected; on nothing: turn the view"},
        {"X Y Z held", "move along one axis only"},
        {"right drag, wheel", "pan, zoom"},
        {"P", "pin or unpin"},
        {"F", "turn triangles round"},
        {"Delete", "remove what is selected"},
        {"Ctrl + A, Escape", "select all, nothing"},
        {"Ctrl + Z, Ctrl + Y", "undo, redo"},
        {"Ctrl + S", "save"},
        {"M, G, N", "symmetry in x, snap to grid, normals"},
        {"Space . , Home", "play, step, back, rewind"},
        {"drag while playing", "pull a vertex"},
        {"1 2 3, C", "view from the front, the side, above; as at first"},
    };
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& [key, words] : keys) {
            ImGui::TableNextColumn();
            ImGui::TextColored(warm, "%s", key);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(words);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

namespace {

// Shows a popup with one line and buttons; returns the button pressed, or -1.
int ask(const char* id, const std::string& question, std::initializer_list<const char*> answers) {
    if (!ImGui::IsPopupOpen(id)) ImGui::OpenPopup(id);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    if (!ImGui::BeginPopupModal(id, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar))
        return -1;
    ImGui::TextUnformatted(question.c_str());
    int pressed = -1, index = 0;
    for (const char* answer : answers) {
        if (index > 0) ImGui::SameLine();
        if (ImGui::Button(answer)) pressed = index;
        ++index;
    }
    if (pressed >= 0) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return pressed;
}

}  // namespace

bool drawQuestions(Editor& editor, Troubles& troubles) {
    const std::string name = std::filesystem::path(editor.document.file()).filename().string();
    try {
        if (editor.document.recovered()) {
            const int answer = ask(
                "Recover", concat("An editor of ", name, " ended without saving. Its work is still there."),
                {"Take it", "Drop it"});
            if (answer == 0) editor.document.takeRecovered(), editor.message = "recovered; not saved yet";
            if (answer == 1) editor.document.dropRecovered();
            return false;
        }
        if (!editor.asksToClose) return false;
        const int answer = ask("Close", concat("What you changed is not saved in ", name, "."),
                               {"Save and close", "Close without saving", "Stay"});
        if (answer < 0) return false;
        editor.asksToClose = false;
        if (answer == 0) editor.document.save();
        if (answer == 1) editor.document.closeInOrder();
        return answer != 2;
    } catch (const Error& error) {
        troubles.begin("saving", concat("Not saved: ", error.what()));
        return false;
    }
}

}  // namespace shoal::window
