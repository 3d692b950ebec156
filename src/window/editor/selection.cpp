#include "window/editor/panels.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "author/edit.h"
#include "window/edit_widgets.h"
#include "window/editor/panels.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

// As in molecule_file.cpp, less what no one means.
constexpr Limit place{-1e4, 1e4}, massLimit{1e-9, 1e6}, stiffnessLimit{0, 1e9}, dampingLimit{0, 1e6},
    lengthLimit{1e-6, 1e4}, amplitudeLimit{0, 0.9}, frequencyLimit{0, 100}, phaseLimit{-6.2831853, 6.2831853};

// Makes all changes while a widget is held one step of undo.
void hold(Editor& editor) {
    if (ImGui::IsItemActivated() || editor.gesture == 0) editor.gesture = editor.document.newGesture();
}

bool number(Editor& editor, const Row& row, const Limit& limit, double& value) {
    beginRow(row);
    const float speed = float(std::max(std::abs(value) * 0.01, 1e-9));
    double shown = value * row.scale;
    const double least = limit.least * row.scale, most = limit.most * row.scale;
    const bool changed =
        ImGui::DragScalar((std::string("##") + row.label).c_str(), ImGuiDataType_Double, &shown,
                          speed * float(row.scale), &least, &most, row.format, ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) ImGui::SetTooltip("%s", row.tip);
    hold(editor);
    if (changed) value = std::clamp(shown / row.scale, limit.least, limit.most);
    return changed;
}

using VertexChange = std::function<void(Vertex&)>;
using SpringChange = std::function<void(Spring&)>;

void editVertices(Editor& editor, const char* label, const std::set<int>& which, const VertexChange& change) {
    editor.document.edit(
        label,
        [&](Draft& draft) {
            for (const int v : which)
                change(draft.molecule.vertices[size_t(v)]);
        },
        editor.gesture);
}

void editSprings(Editor& editor, const char* label, const std::set<int>& which, const SpringChange& change) {
    editor.document.edit(
        label,
        [&](Draft& draft) {
            for (const int s : which)
                change(draft.molecule.springs[size_t(s)]);
        },
        editor.gesture);
}

// The middle of what is selected, to be typed in.
void drawPosition(Editor& editor, const std::set<int>& vertices) {
    const Molecule& m = editor.document.molecule();
    glm::dvec3 middle(0);
    for (const int v : vertices)
        middle += m.vertices[size_t(v)].position / double(vertices.size());
    glm::dvec3 wanted = middle;
    const char* label = vertices.size() == 1 ? "position" : "middle";
    const bool changed =
        drag({label, "m; Ctrl and a click to type", "%.5g"}, place, &wanted.x, 3, 0.002 * m.size());
    hold(editor);
    if (!changed) return;
    const Draft before = editor.document.draft();
    editor.document.edit(
        "move",
        [&](Draft& draft) { moveVertices(draft, before, vertices, wanted - middle, editor.mirrorAxis); },
        editor.gesture);
}

void drawVertices(Editor& editor) {
    const std::set<int> selected = editor.overlay.selection.vertices;
    if (selected.empty()) return;
    const std::set<int> all =
        withMirror(editor.document.molecule(), editor.overlay.selection, editor.mirrorAxis).vertices;
    const size_t first = size_t(*selected.begin());
    if (selected.size() == 1)
        ImGui::Text("Vertex %d", int(first));
    else
        ImGui::Text("%d vertices", int(selected.size()));
    ImGui::PushID("vertices");
    drawPosition(editor, selected);
    double mass = editor.document.molecule().vertices[first].mass;
    if (number(editor, {"mass", "of each that is selected", "%.5g kg"}, massLimit, mass))
        editVertices(editor, "mass", all, [mass](Vertex& v) { v.mass = mass; });
    bool pinned = editor.document.molecule().vertices[first].pinned;
    if (tick({"pinned", "P: held where the molecule is placed"}, pinned)) {
        editor.gesture = 0;
        editVertices(editor, "pin", all, [pinned](Vertex& v) { v.pinned = pinned; });
    }
    glm::dvec2 uv = editor.document.molecule().vertices[first].uv;
    if (selected.size() == 1) {
        const bool changed =
            drag({"uv", "texture coordinates, 0 0 at the lower left", "%.5g"}, {-100, 100}, &uv.x, 2, 0.005);
        hold(editor);
        if (changed) editVertices(editor, "uv", selected, [uv](Vertex& v) { v.uv = uv; });
    }
    ImGui::PopID();
}

// The length of a muscle over one beat, as a share of its rest length.
void drawCurve(const Actuation& muscle) {
    std::array<float, 64> curve{};
    for (size_t i = 0; i < curve.size(); ++i)
        curve[i] = float(
            1 + muscle.amplitude *
                    std::sin(2 * std::numbers::pi * double(i) / double(curve.size() - 1) + muscle.phase));
    ImGui::PlotLines("##curve", curve.data(), int(curve.size()), 0, "length over one beat", 0.0f, 2.0f,
                     ImVec2(-1, points(56)));
}

void drawMuscle(Editor& editor, const std::set<int>& all, const Spring& first) {
    bool actuated = first.actuation.has_value();
    if (tick({"muscle", "its rest length swings: how fish swim"}, actuated)) {
        editor.gesture = 0;
        editSprings(editor, "muscle", all, [actuated](Spring& s) {
            if (actuated && !s.actuation) s.actuation = Actuation{0.1, 1, 0};
            if (!actuated) s.actuation.reset();
        });
    }
    if (!first.actuation) return;
    Actuation muscle = *first.actuation;
    const auto change = [&](const char* label, double Actuation::*which, double value) {
        editSprings(editor, label, all, [which, value](Spring& s) {
            if (s.actuation) (*s.actuation).*which = value;
        });
    };
    ImGui::Indent(points(8));
    if (number(editor, {"amplitude", "share of the rest length", "%.3g"}, amplitudeLimit, muscle.amplitude))
        change("amplitude", &Actuation::amplitude, muscle.amplitude);
    if (number(editor, {"frequency", "beats a second", "%.3g Hz"}, frequencyLimit, muscle.frequency))
        change("frequency", &Actuation::frequency, muscle.frequency);
    if (number(editor, {"phase", "where in the beat it begins", "%.3g rad"}, phaseLimit, muscle.phase))
        change("phase", &Actuation::phase, muscle.phase);
    drawCurve(muscle);
    ImGui::Unindent(points(8));
}

void drawSprings(Editor& editor) {
    const ElementSet chosen{{}, selectedSprings(editor.document.molecule(), editor.overlay.selection), {}};
    if (chosen.springs.empty()) return;
    const std::set<int> all = withMirror(editor.document.molecule(), chosen, editor.mirrorAxis).springs;
    ImGui::Spacing();
    const size_t index = size_t(*chosen.springs.begin());
    const Spring first = editor.document.molecule().springs[index];
    if (chosen.springs.size() == 1)
        ImGui::Text("Spring %d, %d to %d", int(index), first.a, first.b);
    else
        ImGui::Text("%d springs", int(chosen.springs.size()));
    ImGui::PushID("springs");
    double stiffness = first.stiffness, damping = first.damping;
    if (number(editor, {"stiffness", "force a metre", "%.5g N/m"}, stiffnessLimit, stiffness))
        editSprings(editor, "stiffness", all, [stiffness](Spring& s) { s.stiffness = stiffness; });
    if (number(editor, {"damping", "force by the speed at which it stretches", "%.5g N s/m"}, dampingLimit,
               damping))
        editSprings(editor, "damping", all, [damping](Spring& s) { s.damping = damping; });
    double length = editor.document.molecule().restLength(first);
    bool drawn = !first.restLength;
    if (tick({"rests as drawn", "else at a length of its own: then the molecule starts under tension"},
             drawn)) {
        editor.gesture = 0;
        editSprings(editor, "rest length", all, [&](Spring& s) {
            if (drawn)
                s.restLength.reset();
            else if (!s.restLength)
                s.restLength = length;
        });
    }
    if (!drawn && number(editor, {"rest length", "m", "%.5g m"}, lengthLimit, length))
        editSprings(editor, "rest length", all, [length](Spring& s) { s.restLength = length; });
    drawMuscle(editor, all, first);
    ImGui::PopID();
}

void drawTriangles(Editor& editor) {
    const std::set<int>& selected = editor.overlay.selection.triangles;
    if (selected.empty()) return;
    ImGui::Spacing();
    ImGui::Text(selected.size() == 1 ? "Triangle %d" : "%d triangles",
                selected.size() == 1 ? *selected.begin() : int(selected.size()));
    const std::set<int> all =
        withMirror(editor.document.molecule(), editor.overlay.selection, editor.mirrorAxis).triangles;
    if (ImGui::Button("Turn round"))
        editor.document.edit("turn triangles", [&](Draft& draft) { flipTriangles(draft, all); });
}

void drawMaterial(Editor& editor) {
    if (!ImGui::CollapsingHeader("Material")) return;
    const Material& material = editor.document.molecule().material;
    std::array<float, 3> color{float(material.color.r), float(material.color.g), float(material.color.b)};
    beginRow({"color", "linear; the texture is multiplied by it"});
    const bool changed = ImGui::ColorEdit3("##color", color.data(), ImGuiColorEditFlags_Float);
    hold(editor);
    if (changed)
        editor.document.edit(
            "color",
            [&](Draft& draft) {
                for (int i = 0; i < 3; ++i)
                    draft.molecule.material.color[i] = std::clamp(double(color[size_t(i)]), 0.0, 1.0);
            },
            editor.gesture);
    double roughness = material.roughness, translucency = material.translucency;
    if (slide({"roughness", "0 shines, 1 is dull"}, {0, 1}, roughness)) {
        hold(editor);
        editor.document.edit(
            "roughness", [&](Draft& d) { d.molecule.material.roughness = roughness; }, editor.gesture);
    }
    if (slide({"translucency", "light that shines through from behind"}, {0, 1}, translucency)) {
        hold(editor);
        editor.document.edit(
            "translucency", [&](Draft& d) { d.molecule.material.translucency = translucency; },
            editor.gesture);
    }
    ImGui::TextDisabled("%s", material.texture.empty() ? "no texture" : material.texture.c_str());
}

}  // namespace

void drawSelection(Editor& editor) {
    heading("Selected");
    if (editor.overlay.selection.empty()) ImGui::TextDisabled("nothing; click on the molecule");
    drawVertices(editor);
    drawSprings(editor);
    drawTriangles(editor);
    ImGui::Spacing();
    drawMaterial(editor);
}

}  // namespace shoal::window
