#include "window/edit_widgets.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "core/description.h"
#include "window/font.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

constexpr float labelWidth = 136;  // points

// Labels are unique within a node only together with what they belong to, which the caller has pushed.
std::string hidden(const Row& row) {
    return std::string("##") + row.label;
}

// What was typed beyond a limit last.
struct Beyond {
    ImGuiID row = 0;
    std::string words;
};

Beyond& beyond() {
    static Beyond out;
    return out;
}

// Draws one number or several, which move within `reach` and are typed within `limit`.
template <typename Draw>
bool drawShown(const Row& row, const Limit& reach, const Limit& limit, double* values, int count,
               const Draw& draw) {
    const double least = reach.least * row.scale, most = reach.most * row.scale;
    std::array<double, 4> shown{};
    for (int i = 0; i < count; ++i)
        shown[size_t(i)] = values[i] * row.scale;
    const std::array<double, 4> before = shown;
    const bool changed = draw(shown.data(), &least, &most);
    tip(row.tip);
    const ImGuiID id = ImGui::GetID(hidden(row).c_str());
    if (changed) beyond() = {};
    for (int i = 0; i < count; ++i) {
        if (shown[size_t(i)] == before[size_t(i)]) continue;
        // an end of a slider is the limit itself, despite rounding
        const double wanted = shown[size_t(i)] / row.scale;
        const double rounding = 1e-9 * std::max(std::abs(limit.least), std::abs(limit.most));
        values[i] = std::clamp(wanted, limit.least, limit.most);
        if (std::abs(values[i] - wanted) > rounding)
            beyond() = {id, concat(plain(shown[size_t(i)]), " is beyond ", plain(values[i] * row.scale),
                                   ", the ", wanted > limit.most ? "most" : "least", " ", limit.words)};
    }
    if (beyond().row == id) ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1), "%s", beyond().words.c_str());
    return changed;
}

bool slideShown(const Row& row, const Limit& reach, const Limit& limit, double* values, int count) {
    beginRow(row);
    return drawShown(
        row, reach, limit, values, count, [&](double* shown, const double* least, const double* most) {
            return ImGui::SliderScalarN(hidden(row).c_str(), ImGuiDataType_Double, shown, count, least, most,
                                        row.format, row.steep ? ImGuiSliderFlags_Logarithmic : 0);
        });
}

}  // namespace

Row rowOf(const Key& key) {
    return {key.name.c_str(), key.says.sentence.c_str()};
}

Limit limitOf(const Key& key) {
    return {key.says.range.least, key.says.range.most};
}

void beginRow(const Row& row) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(row.label);
    tip(row.tip);
    besideLabel();
    if (row.says) {
        ImGui::Checkbox("##says", row.says);
        tip(row.tip);
        ImGui::SameLine();
    }
    ImGui::SetNextItemWidth(-1);
}

void besideLabel() {
    ImGui::SameLine(points(labelWidth));
}

bool slide(const Row& row, const Limit& reach, const Limit& limit, double& value) {
    return slideShown(row, reach, limit, &value, 1);
}

bool slideSpan(const Row& row, const Limit& reach, const Limit& limit, glm::dvec2& span) {
    const glm::dvec2 before = span;
    if (!slideShown(row, reach, limit, &span.x, 2)) return false;
    if (!row.free && span.x != before.x) span.y = std::max(span.x, span.y);
    if (!row.free && span.x == before.x) span.x = std::min(span.x, span.y);
    return true;
}

// Several numbers with all their digits have no room beside a label, and take a line of their own.
bool drag(const Row& row, const Limit& limit, double* values, int count, double speed) {
    if (count == 1 || row.says) {
        beginRow(row);
    } else {
        ImGui::TextUnformatted(row.label);
        tip(row.tip);
    }
    if (count > 1 && row.says) ImGui::NewLine();
    if (count > 1) ImGui::SetNextItemWidth(-1);
    return drawShown(row, limit, limit, values, count,
                     [&](double* shown, const double* least, const double* most) {
                         return ImGui::DragScalarN(hidden(row).c_str(), ImGuiDataType_Double, shown, count,
                                                   float(speed), least, most, row.format);
                     });
}

bool tick(const Row& row, bool& value) {
    beginRow(row);
    const bool changed = ImGui::Checkbox(hidden(row).c_str(), &value);
    tip(row.tip);
    return changed;
}

bool type(const Row& row, std::string& text) {
    // what is being typed: ImGui forgets it where something that is drawn earlier is clicked
    static ImGuiID typing = 0;
    static std::string typed;
    beginRow(row);
    const ImGuiID id = ImGui::GetID(hidden(row).c_str());
    const bool mine = typing == id;
    std::array<char, 1024> shown{};
    (mine ? typed : text).copy(shown.data(), shown.size() - 1);
    ImGui::InputText(hidden(row).c_str(), shown.data(), shown.size());
    tip(row.tip);
    if (ImGui::IsItemActive()) {
        typing = id;
        typed = shown.data();
        return false;
    }
    if (!mine) return false;
    typing = 0;
    if (text == shown.data()) return false;
    text = shown.data();
    return true;
}

std::optional<size_t> choose(const Row& row, const std::string& current,
                             const std::vector<std::string>& words) {
    std::optional<size_t> chosen;
    beginRow(row);
    if (!ImGui::BeginCombo(hidden(row).c_str(), current.c_str())) return chosen;
    for (size_t i = 0; i < words.size(); ++i)
        if (ImGui::Selectable(words[i].c_str(), words[i] == current) && words[i] != current) chosen = i;
    ImGui::EndCombo();
    return chosen;
}

bool pickColor(const Row& row, const Limit& limit, glm::dvec3& color) {
    std::array<float, 3> shown{float(color.x), float(color.y), float(color.z)};
    beginRow(row);
    const ImGuiColorEditFlags flags =
        ImGuiColorEditFlags_Float | (limit.most > 1 ? ImGuiColorEditFlags_HDR : 0);
    if (!ImGui::ColorEdit3(hidden(row).c_str(), shown.data(), flags)) return false;
    for (int i = 0; i < 3; ++i)
        color[i] = std::clamp(std::round(double(shown[size_t(i)]) * 1000) / 1000, limit.least, limit.most);
    return true;
}

bool turnDirection(const char* tip, glm::dvec3& direction, glm::dvec2& angles) {
    const auto directionOf = [](const glm::dvec2& a) {
        return glm::dvec3(std::cos(a.x) * std::sin(a.y), std::sin(a.x), -std::cos(a.x) * std::cos(a.y));
    };
    if (glm::length(directionOf(angles) - direction) > 1e-6) {
        const bool upright = std::hypot(direction.x, direction.z) < 1e-6;
        angles.x = std::asin(std::clamp(direction.y, -1.0, 1.0));
        if (!upright) angles.y = std::atan2(direction.x, -direction.z);
    }
    const double quarter = 90 / degrees;
    const Limit up{-quarter, quarter, "there is"}, around{-2 * quarter, 2 * quarter, "around"};
    bool changed = slide({"elevation", tip, "%.1f\xC2\xB0", false, degrees}, up, up, angles.x);
    changed |= slide({"heading", "Which way around: 0 is -z, 90 is +x.", "%.1f\xC2\xB0", false, degrees},
                     around, around, angles.y);
    if (!changed) return false;
    direction = glm::normalize(directionOf(angles));
    for (int i = 0; i < 3; ++i)  // straight up is written as such
        if (std::abs(direction[i]) < 1e-12) direction[i] = 0;
    return true;
}

void heading(const char* words) {
    ImGui::Spacing();
    ImGui::TextColored(ImVec4(0.55f, 0.78f, 0.42f, 1), "%s", words);
    ImGui::Separator();
}

bool toggle(const char* label, bool on) {
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool pressed = ImGui::Button(label);
    if (on) ImGui::PopStyleColor();
    return pressed;
}

// Where the first sentence ends, if another one follows it in the line.
static size_t endOfSentence(const std::string& words) {
    const size_t end = words.find(". ");
    return end == std::string::npos ? end : end + 1;
}

void tip(const std::string& words) {
    constexpr float widest = 40;  // letters
    if (words.empty() || ImGui::IsItemActive() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(widest * ImGui::CalcTextSize("n").x);
    const size_t rest = ImGui::GetIO().KeyShift ? std::string::npos : endOfSentence(words);
    ImGui::TextUnformatted(inLetters(words.substr(0, rest)).c_str());
    if (rest < words.size()) ImGui::TextDisabled("Shift shows more.");
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

std::string plain(double number) {
    return formatted("%.4g", number);
}

std::string inWords(const std::string& key) {
    std::string out;
    for (const char c : key) {
        if (std::isupper(static_cast<unsigned char>(c))) out += ' ';
        out += char(std::tolower(static_cast<unsigned char>(c)));
    }
    return out;
}

}  // namespace shoal::window
