#include "window/editor/editor.h"

#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "window/interface.h"

namespace shoal::window {

std::vector<glm::dvec3> shownPlaces(const Editor& editor, const EditorStage& stage) {
    const Molecule& m = editor.molecule();
    const bool atRest = !stage.ready() || (stage.frame() == 0 && !editor.wobbling);
    if (!atRest && stage.positions().size() == m.vertices.size()) return stage.positions();
    std::vector<glm::dvec3> out;
    for (const Vertex& vertex : m.vertices)
        out.push_back(vertex.position);
    return out;
}

void EditorPointer::work(const View& view) {
    const ImGuiIO& io = ImGui::GetIO();
    EditorOverlay& overlay = editor_.overlay;
    overlay.hoveredVertex.reset();
    overlay.hoveredSpring.reset();
    overlay.hoveredTriangle.reset();
    overlay.chainEnd.reset();
    const Projector projector(view, io.DisplaySize);
    if (grip_ != Grip::none) return drag(projector);
    if (io.WantCaptureMouse) return;
    if (io.MouseWheel != 0) camera_.zoom(double(io.MouseWheel));
    hover(projector);
    if (!overlay.chain.empty()) overlay.chainEnd = io.MousePos;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) || ImGui::IsMouseClicked(ImGuiMouseButton_Middle))
        grip_ = Grip::pan;
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) click(projector, view.target);
}

void EditorPointer::hover(const Projector& projector) {
    const std::vector<glm::dvec3> x = shownPlaces(editor_, stage_);
    const Molecule& m = editor_.molecule();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    EditorOverlay& overlay = editor_.overlay;
    overlay.hoveredVertex = vertexAt(x, projector, mouse);
    if (overlay.hoveredVertex || editor_.tool != Tool::select || stage_.moved()) return;
    if (overlay.springs) overlay.hoveredSpring = springAt(m, x, projector, mouse);
    if (!overlay.hoveredSpring) overlay.hoveredTriangle = triangleAt(m, x, projector, mouse);
}

void EditorPointer::click(const Projector& projector, const glm::dvec3& near) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const std::optional<int> vertex = editor_.overlay.hoveredVertex;
    if (stage_.moved() && vertex) {
        grip_ = Grip::pull;
        held_ = *vertex;
    } else if (editor_.tool == Tool::vertex && !stage_.moved()) {
        addVertexUnder(projector, near);
    } else if ((editor_.tool == Tool::spring || editor_.tool == Tool::triangle) && vertex) {
        link(*vertex);
        if (editor_.tool == Tool::spring) grip_ = Grip::link;
    } else if (editor_.tool == Tool::select && ImGui::GetIO().KeyCtrl) {
        grip_ = Grip::box;
        box_ = mouse;
    } else if (editor_.tool == Tool::select && select()) {
        if (vertex && !stage_.moved()) beginMove(*vertex);
    } else {
        grip_ = Grip::turn;
        moved_ = 0;
    }
}

// Selects the element under the pointer, with Shift adds or removes it; false: there is none.
bool EditorPointer::select() {
    const EditorOverlay& o = editor_.overlay;
    if (!o.hoveredVertex && !o.hoveredSpring && !o.hoveredTriangle) return false;
    ElementSet& s = editor_.overlay.selection;
    const bool adds = ImGui::GetIO().KeyShift;
    const auto take = [&](std::set<int>& set, int index) {
        if (adds && set.contains(index)) return void(set.erase(index));
        if (!adds && !set.contains(index)) s = {};
        set.insert(index);
    };
    if (o.hoveredVertex)
        take(s.vertices, *o.hoveredVertex);
    else if (o.hoveredSpring)
        take(s.springs, *o.hoveredSpring);
    else
        take(s.triangles, *o.hoveredTriangle);
    return true;
}

void EditorPointer::beginMove(int vertex) {
    grip_ = Grip::move;
    held_ = vertex;
    before_ = editor_.document.draft();
    start_ = ImGui::GetIO().MousePos;
    editor_.gesture = 0;
    gesture_ = editor_.document.newGesture();
}

double EditorPointer::snapped(double number) const {
    return editor_.snaps ? std::round(number / editor_.grid) * editor_.grid : number;
}

void EditorPointer::addVertexUnder(const Projector& projector, const glm::dvec3& near) {
    glm::dvec3 place = projector.onPlane(ImGui::GetIO().MousePos, near);
    for (int i = 0; i < 3; ++i)
        place[i] = snapped(place[i]);
    int made = -1;
    editor_.document.edit("add vertex",
                          [&](Draft& draft) { made = addVertexAt(draft, place, editor_.mirrorAxis); });
    editor_.overlay.selection = {{made}, {}, {}};
}

// The next vertex of a spring or a triangle.
void EditorPointer::link(int vertex) {
    std::vector<int>& chain = editor_.overlay.chain;
    if (std::find(chain.begin(), chain.end(), vertex) != chain.end()) return;
    chain.push_back(vertex);
    const size_t needed = editor_.tool == Tool::spring ? 2 : 3;
    if (chain.size() < needed) return;
    const std::vector<int> c = chain;
    chain.clear();
    ElementSet made;
    if (editor_.tool == Tool::spring && springBetween(editor_.molecule(), c[0], c[1]) < 0)
        editor_.document.edit("add spring", [&](Draft& draft) {
            made.springs.insert(connect(draft, c[0], c[1], editor_.mirrorAxis));
        });
    if (editor_.tool == Tool::triangle)
        editor_.document.edit("add triangle", [&](Draft& draft) {
            const int triangle = addFace(draft, c[0], c[1], c[2], editor_.mirrorAxis);
            if (triangle >= 0) made.triangles.insert(triangle);
        });
    if (!made.empty()) editor_.overlay.selection = made;
}

void EditorPointer::drag(const Projector& projector) {
    const ImGuiIO& io = ImGui::GetIO();
    const double dx = double(io.MouseDelta.x) / io.DisplaySize.y,
                 dy = double(io.MouseDelta.y) / io.DisplaySize.y;
    const bool left = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    moved_ += std::abs(io.MouseDelta.x) + std::abs(io.MouseDelta.y);
    switch (grip_) {
    case Grip::turn:
        camera_.turn(dx, dy);
        if (!left && moved_ < points(3)) editor_.overlay.selection = {}, editor_.overlay.chain.clear();
        break;
    case Grip::pan:
        camera_.pan(dx, dy);
        break;
    case Grip::move:
        move(projector);
        break;
    case Grip::pull:
        pull(projector, left);
        break;
    case Grip::link:
        editor_.overlay.chainEnd = io.MousePos;
        hover(projector);
        if (!left && editor_.overlay.hoveredVertex && !editor_.overlay.chain.empty())
            link(*editor_.overlay.hoveredVertex);
        break;
    default:
        break;
    }
    const bool other =
        ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle);
    if (grip_ == Grip::pan ? other : left) return;
    if (grip_ == Grip::box) selectBox(projector);
    grip_ = Grip::none;
    box_.reset();
}

// By what the pointer has moved since, in the plane through the vertex that faces the eye, or along an
// axis.
void EditorPointer::move(const Projector& projector) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (std::hypot(mouse.x - start_.x, mouse.y - start_.y) < points(3) && !dragging_) return;
    dragging_ = true;
    const glm::dvec3 from = before_.molecule.vertices[size_t(held_)].position;
    glm::dvec3 shift = projector.onPlane(mouse, from) - projector.onPlane(start_, from);
    constexpr int axisKeys[] = {GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_Z};
    for (int axis = 0; axis < 3; ++axis)
        if (keys_.held(axisKeys[axis]))
            for (int i = 0; i < 3; ++i)
                if (i != axis) shift[i] = 0;
    for (int i = 0; i < 3; ++i)
        if (shift[i] != 0) shift[i] = snapped(from[i] + shift[i]) - from[i];
    const std::set<int> which = editor_.overlay.selection.vertices;
    editor_.document.edit(
        "move", [&](Draft& draft) { moveVertices(draft, before_, which, shift, editor_.mirrorAxis); },
        gesture_);
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragging_ = false;
}

void EditorPointer::pull(const Projector& projector, bool left) {
    stage_.pull.reset();
    if (!left || size_t(held_) >= stage_.positions().size()) return;
    stage_.pull = EditorStage::Pull{
        held_, projector.onPlane(ImGui::GetIO().MousePos, stage_.positions()[size_t(held_)])};
}

void EditorPointer::selectBox(const Projector& projector) {
    const ImVec2 a = *box_, b = ImGui::GetIO().MousePos;
    const std::vector<glm::dvec3> x = shownPlaces(editor_, stage_);
    if (!ImGui::GetIO().KeyShift) editor_.overlay.selection = {};
    for (size_t v = 0; v < x.size(); ++v) {
        const auto p = projector.place(x[v]);
        if (p && p->x >= std::min(a.x, b.x) && p->x <= std::max(a.x, b.x) && p->y >= std::min(a.y, b.y) &&
            p->y <= std::max(a.y, b.y))
            editor_.overlay.selection.vertices.insert(int(v));
    }
}

void EditorPointer::draw() const {
    if (!box_) return;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddRect(*box_, ImGui::GetIO().MousePos, IM_COL32(255, 220, 90, 220));
    list->AddRectFilled(*box_, ImGui::GetIO().MousePos, IM_COL32(255, 220, 90, 30));
}

}  // namespace shoal::window
