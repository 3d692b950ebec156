#include <imgui.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>

#include "author/edit.h"
#include "core/description.h"
#include "window/edit_widgets.h"
#include "window/editor/editor.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

// Makes all changes while a widget is held one step of undo.
void hold(Editor& editor) {
    if (ImGui::IsItemActivated() || editor.gesture == 0) editor.gesture = editor.document.newGesture();
}

template <typename S>
const Key& keyOf(const char* name) {
    return *describe(static_cast<const S*>(nullptr)).find(name);
}

bool drawNumber(Editor& editor, const Key& key, double& value) {
    const std::string label = inWords(key.name),
                      format = key.says.unit.empty() ? "%.5g" : "%.5g " + key.says.unit;
    const bool changed = drag({label.c_str(), key.says.sentence.c_str(), format.c_str()}, limitOf(key),
                              &value, 1, std::max(std::abs(value) * 0.01, 1e-9));
    hold(editor);
    return changed;
}

template <typename S>
double& numberOf(const Key& key, S& object) {
    return *static_cast<double*>(key.member.make(key.place(&object)));
}

// Draws the numbers of what is selected by its description. The first of it is shown; `change`, which takes a
// label and a function, makes a change to all of it.
template <typename S, typename Change>
void drawNumbers(Editor& editor, S first, const Change& change) {
    for (const Key& key : describe(&first).keys()) {
        if (key.kind != Key::Kind::number || key.member.optional) continue;
        if (drawNumber(editor, key, numberOf(key, first)))
            change(inWords(key.name), [&](S& element) { numberOf(key, element) = numberOf(key, first); });
    }
}

template <typename S>
void editAll(Editor& editor, const std::string& label, std::vector<S> Molecule::*elements,
             const std::set<int>& which, const std::function<void(S&)>& change) {
    editor.document.edit(
        label,
        [&](Draft& draft) {
            for (const int i : which)
                change((draft.molecule.*elements)[size_t(i)]);
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
    const Key& key = keyOf<Vertex>("position");
    const char* label = vertices.size() == 1 ? key.name.c_str() : "middle";
    const bool changed =
        drag({label, key.says.sentence.c_str(), "%.5g"}, limitOf(key), &wanted.x, 3, 0.002 * m.size());
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
    const auto change = [&](const std::string& label, const std::function<void(Vertex&)>& how) {
        editAll(editor, label, &Molecule::vertices, all, how);
    };
    const Vertex first = editor.document.molecule().vertices[size_t(*selected.begin())];
    if (selected.size() == 1)
        ImGui::Text("Vertex %d", *selected.begin());
    else
        ImGui::Text("%d vertices", int(selected.size()));
    ImGui::PushID("vertices");
    drawPosition(editor, selected);
    drawNumbers(editor, first, change);
    const Key& pins = keyOf<Vertex>("pinned");
    bool pinned = first.pinned;
    if (tick({pins.name.c_str(), concat("P: ", pins.says.sentence).c_str()}, pinned)) {
        editor.gesture = 0;
        change("pin", [pinned](Vertex& v) { v.pinned = pinned; });
    }
    if (selected.size() == 1) {
        const Key& key = keyOf<Vertex>("uv");
        glm::dvec2 uv = first.uv;
        const bool changed =
            drag({key.name.c_str(), key.says.sentence.c_str(), "%.5g"}, limitOf(key), &uv.x, 2, 0.005);
        hold(editor);
        if (changed)
            editAll<Vertex>(editor, key.name, &Molecule::vertices, selected, [uv](Vertex& v) { v.uv = uv; });
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

void drawMuscle(Editor& editor, const Spring& first,
                const std::function<void(const std::string&, const std::function<void(Spring&)>&)>& change) {
    bool actuated = first.actuation.has_value();
    if (tick({"muscle", keyOf<Spring>("actuation").says.sentence.c_str()}, actuated)) {
        editor.gesture = 0;
        change("muscle", [actuated](Spring& s) {
            if (actuated && !s.actuation) s.actuation = Actuation{0.1, 1, 0};
            if (!actuated) s.actuation.reset();
        });
    }
    if (!first.actuation) return;
    ImGui::Indent(points(8));
    drawNumbers(editor, *first.actuation,
                [&](const std::string& label, const std::function<void(Actuation&)>& how) {
                    change(label, [&](Spring& s) {
                        if (s.actuation) how(*s.actuation);
                    });
                });
    drawCurve(*first.actuation);
    ImGui::Unindent(points(8));
}

void drawSprings(Editor& editor) {
    const ElementSet chosen{{}, selectedSprings(editor.document.molecule(), editor.overlay.selection), {}};
    if (chosen.springs.empty()) return;
    const std::set<int> all = withMirror(editor.document.molecule(), chosen, editor.mirrorAxis).springs;
    const auto change = [&](const std::string& label, const std::function<void(Spring&)>& how) {
        editAll(editor, label, &Molecule::springs, all, how);
    };
    ImGui::Spacing();
    const int index = *chosen.springs.begin();
    const Spring first = editor.document.molecule().springs[size_t(index)];
    if (chosen.springs.size() == 1)
        ImGui::Text("Spring %d, %d to %d", index, first.a, first.b);
    else
        ImGui::Text("%d springs", int(chosen.springs.size()));
    ImGui::PushID("springs");
    drawNumbers(editor, first, change);
    const Key& rest = keyOf<Spring>("restLength");
    const std::string restLabel = inWords(rest.name);
    double length = editor.document.molecule().restLength(first);
    bool drawn = !first.restLength;
    if (tick({"rests as drawn", rest.says.sentence.c_str()}, drawn)) {
        editor.gesture = 0;
        change(restLabel, [&](Spring& s) {
            if (drawn)
                s.restLength.reset();
            else if (!s.restLength)
                s.restLength = length;
        });
    }
    if (!drawn && drawNumber(editor, rest, length))
        change(restLabel, [length](Spring& s) { s.restLength = length; });
    drawMuscle(editor, first, change);
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

template <typename Value>
void drawLook(Editor& editor, const char* name, Value Material::*member) {
    const Key& key = keyOf<Material>(name);
    Value value = editor.document.molecule().material.*member;
    bool changed = false;
    if constexpr (std::is_same_v<Value, double>)
        changed = slide(rowOf(key), limitOf(key), limitOf(key), value);
    else
        changed = pickColor(rowOf(key), limitOf(key), value);
    hold(editor);
    if (changed)
        editor.document.edit(
            key.name, [&](Draft& draft) { draft.molecule.material.*member = value; }, editor.gesture);
}

void drawMaterial(Editor& editor) {
    if (!ImGui::CollapsingHeader("Material")) return;
    drawLook(editor, "color", &Material::color);
    drawLook(editor, "roughness", &Material::roughness);
    drawLook(editor, "translucency", &Material::translucency);
    const std::string& texture = editor.document.molecule().material.texture;
    ImGui::TextDisabled("%s", texture.empty() ? "no texture" : texture.c_str());
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
