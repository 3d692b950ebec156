#include "window/time_line.h"

#include <imgui.h>

#include <algorithm>

#include "window/edit_widgets.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

template <typename T>
size_t bytesIn(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

// Counts the arrays that grow with the scene.
size_t bytesOf(const SavedState& state) {
    const ContactMemory& contacts = state.contacts;
    size_t out = bytesIn(contacts.partners) + bytesIn(contacts.pushes) + bytesIn(contacts.anchors) +
                 bytesIn(contacts.known) + bytesIn(contacts.loads) + bytesIn(contacts.calm) +
                 bytesIn(contacts.walls) + bytesIn(contacts.wallPushes);
    for (const GroupState& group : state.groups)
        out += bytesIn(group.positions) + bytesIn(group.velocities) + bytesIn(group.displacements) +
               bytesIn(group.velocityChanges) + bytesIn(group.anchors) + bytesIn(group.lives) +
               bytesIn(group.seeds) + bytesIn(group.looks) + bytesIn(group.steering);
    return out;
}

}  // namespace

void TimeLine::forget() {
    kept_.clear();
    every_ = usualEvery;
    loop_.reset();
}

void TimeLine::note(Simulation& simulation) {
    if (!open) return;
    const int frame = simulation.frames();
    while (!kept_.empty() && kept_.back().frames >= frame)
        kept_.pop_back();
    if (kept_.empty() || frame >= kept_.back().frames + every_ || frame == loop_) {
        kept_.push_back(simulation.save());
        size_t bytes = 0;
        for (const SavedState& state : kept_)
            bytes += bytesOf(state);
        if (bytes > mostBytes) thinOut();
    }
    if (loop_ && frame >= *loop_ && kept_.front().frames < frame) simulation.load(kept_.front());
}

// Every second one goes, and as many fewer come.
void TimeLine::thinOut() {
    for (size_t i = 1; i < kept_.size(); ++i)
        kept_.erase(kept_.begin() + std::ptrdiff_t(i));
    every_ *= 2;
}

const SavedState* TimeLine::draw(float left, float right, const Simulation& simulation) {
    if (!open) return nullptr;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(left, screen.y - points(12)), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSize(ImVec2(std::max(points(240), screen.x - left - right), 0), ImGuiCond_Always);
    ImGui::Begin("Time", &open, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoFocusOnAppearing);
    const SavedState* chosen = nullptr;
    bool loops = loop_.has_value();
    ImGui::BeginDisabled(!loops && (kept_.empty() || kept_.front().frames >= simulation.frames()));
    if (ImGui::Checkbox("Loop", &loops)) loop_ = loops ? std::optional(simulation.frames()) : std::nullopt;
    ImGui::EndDisabled();
    tip("Goes back to the first state that was kept whenever it comes to where you ticked this.");
    ImGui::SameLine();
    const int first = kept_.empty() ? simulation.frames() : kept_.front().frames;
    const int last = std::max(simulation.frames(), kept_.empty() ? 0 : kept_.back().frames);
    int frame = simulation.frames();
    ImGui::SetNextItemWidth(-1);
    ImGui::BeginDisabled(kept_.empty() || first == last);
    if (ImGui::SliderInt("##frame", &frame, first, last, "frame %d", ImGuiSliderFlags_AlwaysClamp))
        for (const SavedState& state : kept_)
            if (!chosen || std::abs(state.frames - frame) < std::abs(chosen->frames - frame)) chosen = &state;
    ImGui::EndDisabled();
    tip("Goes to the nearest state that was kept, and pauses. Playing on from there replaces what came "
        "after.");
    ImGui::End();
    return chosen && chosen->frames != simulation.frames() ? chosen : nullptr;
}

}  // namespace shoal::window
