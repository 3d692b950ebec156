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

ImGuiSliderFlags flagsOf(const Row& row) {
    return ImGuiSliderFlags_AlwaysClamp | (row.steep ? ImGuiSliderFlags_Logarithmic : 0);
}

// Labels are unique within a node only together with what they belong to, which the caller has pushed.
std::string hidden(const Row& row) {
    return std::string("##") + row.label;
}

bool slideShown(const Row& row, const Limit& limit, double* values, int count) {
    const double least = limit.least * row.scale, most = limit.most * row.scale;
    const bool changed = ImGui::SliderScalarN(hidden(row).c_str(), ImGuiDataType_Double, values, count,
                                              &least, &most, row.format, flagsOf(row));
    tip(row.tip);
    return changed;
}

// Converts a shown value to a stored one: an end of the slider is the limit itself, despite rounding.
double stored(const Row& row, const Limit& limit, double shown) {
    return std::clamp(shown / row.scale, limit.least, limit.most);
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
    ImGui::SetNextItemWidth(-1);
}

void besideLabel() {
    ImGui::SameLine(points(labelWidth));
}

bool slide(const Row& row, const Limit& limit, double& value) {
    beginRow(row);
    double shown = value * row.scale;
    if (!slideShown(row, limit, &shown, 1)) return false;
    value = stored(row, limit, shown);
    return true;
}

bool slide(const Row& row, const Limit& limit, int& value) {
    beginRow(row);
    const int least = int(limit.least), most = int(limit.most);
    const bool changed = ImGui::SliderInt(hidden(row).c_str(), &value, least, most, row.format, flagsOf(row));
    tip(row.tip);
    return changed;
}

bool slideSpan(const Row& row, const Limit& limit, glm::dvec2& span) {
    beginRow(row);
    std::array<double, 2> shown{span.x * row.scale, span.y * row.scale};
    if (!slideShown(row, limit, shown.data(), 2)) return false;
    const glm::dvec2 wanted(stored(row, limit, shown[0]), stored(row, limit, shown[1]));
    if (row.free) {
        span = wanted;
        return true;
    }
    const bool least = shown[0] != span.x * row.scale;  // is the one that moved
    span = least ? glm::dvec2(wanted.x, std::max(wanted.x, span.y))
                 : glm::dvec2(std::min(span.x, wanted.y), wanted.y);
    return true;
}

// Several numbers with all their digits have no room beside a label, and take a line of their own.
bool drag(const Row& row, const Limit& limit, double* values, int count, double speed) {
    if (count == 1) {
        beginRow(row);
    } else {
        ImGui::TextUnformatted(row.label);
        tip(row.tip);
        ImGui::SetNextItemWidth(-1);
    }
    const double least = limit.least * row.scale, most = limit.most * row.scale;
    std::array<double, 4> shown{};
    for (int i = 0; i < count; ++i)
        shown[size_t(i)] = values[i] * row.scale;
    const std::array<double, 4> before = shown;
    const bool changed =
        ImGui::DragScalarN(hidden(row).c_str(), ImGuiDataType_Double, shown.data(), count, float(speed),
                           &least, &most, row.format, ImGuiSliderFlags_AlwaysClamp);
    tip(row.tip);
    for (int i = 0; i < count; ++i)
        if (shown[size_t(i)] != before[size_t(i)]) values[i] = stored(row, limit, shown[size_t(i)]);
    return changed;
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
    bool changed = slide({"elevation", tip, "%.1f\xC2\xB0", false, degrees}, {-quarter, quarter}, angles.x);
    changed |= slide({"heading", "Which way around: 0 is -z, 90 is +x.", "%.1f\xC2\xB0", false, degrees},
                     {-2 * quarter, 2 * quarter}, angles.y);
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

void tip(const std::string& words) {
    constexpr float widest = 40;  // letters
    if (words.empty() || ImGui::IsItemActive() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(widest * ImGui::CalcTextSize("n").x);
    ImGui::TextUnformatted(inLetters(words).c_str());
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
