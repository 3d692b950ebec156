#include "window/group_editors.h"

#include <imgui.h>

#include <algorithm>

#include "window/edit_widgets.h"

namespace shoal::window {

namespace {

constexpr double degrees = 57.29577951308232;

Limit upTo(double usual, std::initializer_list<double> own, double least = 0) {
    return {least, std::max({usual, 2 * std::max(own)})};
}

bool drawTargets(const char* title, const char* tip, const Limit& limit, std::vector<SchoolTarget>& targets) {
    bool changed = false;
    for (size_t i = 0; i < targets.size(); ++i) {
        ImGui::PushID(title);
        ImGui::PushID(int(i));
        ImGui::TextDisabled("%s %s", title, targets[i].group.c_str());
        changed |= slide({"noticed within", tip, "%.2f m", true}, {0.01, limit.most}, targets[i].radius);
        changed |= slide({"strength", tip, "%.1f m/s\xC2\xB2"}, limit, targets[i].strength);
        ImGui::PopID();
        ImGui::PopID();
    }
    return changed;
}

}  // namespace

SchoolEditor::SchoolEditor(const School& s)
    : radius_(upTo(2, {s.radius}, 0.01)),
      separation_(upTo(20, {s.separation})),
      rate_(upTo(10, {s.alignment, s.cohesion, s.depthStrength})),
      speed_(upTo(3, {s.slowest, s.cruise, s.fastest}, 0.001)),
      acceleration_(upTo(10, {s.acceleration}, 0.01)),
      turn_(upTo(10, {s.turn}, 0.01)),
      wander_(upTo(2, {s.wander})),
      walls_(upTo(2, {s.walls})),
      targets_(upTo(20, {0})) {
    for (const auto* list : {&s.flees, &s.hunts})
        for (const SchoolTarget& target : *list)
            targets_.most = std::max({targets_.most, 2 * target.radius, 2 * target.strength});
}

bool SchoolEditor::draw(School& s) const {
    const School before = s;
    bool changed =
        slide({"sees within", "Others nearer than this count.", "%.2f m", true}, radius_, s.radius);
    changed |=
        slide({"keeps off", "From those nearer than this.", "%.2f m", true}, radius_, s.separationRadius);
    changed |= slide({"separation", "How hard it keeps off.", "%.1f m/s\xC2\xB2"}, separation_, s.separation);
    changed |= slide({"alignment", "How fast its velocity becomes that of the others.", "%.2f 1/s"}, rate_,
                     s.alignment);
    changed |= slide({"cohesion", "Towards the others' middle.", "%.2f 1/s\xC2\xB2"}, rate_, s.cohesion);
    changed |= slide({"slowest", "It swims at least so fast.", "%.2f m/s"}, speed_, s.slowest);
    changed |= slide({"cruise", "As fast as it likes to swim.", "%.2f m/s"}, speed_, s.cruise);
    changed |= slide({"fastest", "When it flees or hunts.", "%.2f m/s"}, speed_, s.fastest);
    changed |= slide({"acceleration", "The most that all wishes together may ask.", "%.1f m/s\xC2\xB2"},
                     acceleration_, s.acceleration);
    changed |= slide({"turn", "The most that it turns.", "%.0f\xC2\xB0/s", false, degrees}, turn_, s.turn);
    changed |= slide({"bend", "The most that its ends turn to one another.", "%.0f\xC2\xB0", false, degrees},
                     {0, 3}, s.bend);
    changed |= slide({"wander", "To here and there at random.", "%.2f m/s\xC2\xB2"}, wander_, s.wander);
    changed |=
        slide({"walls", "Turns from those nearer than this; 0: it does not.", "%.2f m"}, walls_, s.walls);
    if (s.depth)
        changed |= slide({"depth strength", "Back to where it likes to be.", "%.2f 1/s\xC2\xB2"}, rate_,
                         s.depthStrength);
    changed |= drawTargets("flees", "From those of another group.", targets_, s.flees);
    changed |= drawTargets("hunts", "Those of another group.", targets_, s.hunts);
    // numbers that stand in an order push each other
    if (s.separationRadius != before.separationRadius) s.radius = std::max(s.radius, s.separationRadius);
    s.separationRadius = std::min(s.separationRadius, s.radius);
    if (s.slowest != before.slowest) s.cruise = std::max(s.cruise, s.slowest);
    if (s.fastest != before.fastest) s.cruise = std::min(s.cruise, s.fastest);
    s.slowest = std::min(s.slowest, s.cruise);
    s.fastest = std::max(s.fastest, s.cruise);
    return changed;
}

}  // namespace shoal::window
