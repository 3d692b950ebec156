// Handles the pointer in the editor: it turns the view, selects, adds and links, moves what is selected, and
// pulls at what plays.
#pragma once

#include <optional>
#include <vector>

#include <imgui.h>

#include "author/edit.h"
#include "window/editor/editor.h"
#include "window/input.h"
#include "window/orbit_camera.h"

namespace shoal::window {

// Positions of the vertices as they are drawn, m: at rest those of the draft itself, so that nothing lags
// behind the pointer.
std::vector<glm::dvec3> shownPlaces(const Editor& editor, const EditorStage& stage);

class EditorPointer {
  public:
    EditorPointer(Editor& editor, EditorStage& stage, OrbitCamera& camera, const Input& keys)
        : editor_(editor), stage_(stage), camera_(camera), keys_(keys) {}

    void work(const View& view);  // of a frame
    void draw() const;            // the box that it opens
    bool holds() const { return grip_ != Grip::none; }
    bool pulls() const { return grip_ == Grip::pull; }

  private:
    enum class Grip { none, turn, pan, move, pull, link, box };

    void hover(const Projector& projector);
    void click(const Projector& projector, const glm::dvec3& near);
    bool select();
    void beginMove(int vertex);
    double snapped(double number) const;
    void addVertexUnder(const Projector& projector, const glm::dvec3& near);
    void link(int vertex);
    void drag(const Projector& projector);
    void move(const Projector& projector);
    void pull(const Projector& projector, bool left);
    void selectBox(const Projector& projector);

    Editor& editor_;
    EditorStage& stage_;
    OrbitCamera& camera_;
    const Input& keys_;
    Grip grip_ = Grip::none;
    int held_ = 0;               // a vertex
    Draft before_;               // of a move
    ImVec2 start_{0, 0};         // of a move
    std::optional<ImVec2> box_;  // a corner
    float moved_ = 0;            // by the pointer, since it went down
    bool dragging_ = false;
    int gesture_ = 0;
};

}  // namespace shoal::window
