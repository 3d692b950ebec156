#include "window/notices.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <iostream>
#include <utility>

#include "window/font.h"
#include "window/interface.h"

namespace shoal::window {

namespace {

constexpr ImGuiWindowFlags plainWindow = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar |
                                         ImGuiWindowFlags_NoSavedSettings |
                                         ImGuiWindowFlags_NoFocusOnAppearing;

// A driver may have a page to say: its first lines tell.
std::string firstLines(const std::string& text) {
    constexpr int most = 8;
    size_t end = 0;
    for (int line = 0; line < most && end != std::string::npos; ++line)
        end = text.find('\n', end == 0 ? 0 : end + 1);
    return end == std::string::npos ? text : text.substr(0, end) + "\n...";
}

void centered() {
    const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    const float width = std::min(points(460), ImGui::GetIO().DisplaySize.x - points(24));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, ImGui::GetIO().DisplaySize.y));
}

bool beginQuestion(const char* title) {
    if (!ImGui::IsPopupOpen(title)) ImGui::OpenPopup(title);
    centered();
    return ImGui::BeginPopupModal(title, nullptr,
                                  ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar);
}

}  // namespace

bool Troubles::begin(const std::string& cause, const std::string& words) {
    std::string& said = words_[cause];
    return std::exchange(said, words) != words;
}

void Troubles::warn(const std::string& cause, const std::string& words) {
    if (begin(cause, words)) std::cerr << "shoal: warning: " << words << std::endl;
}

std::string Troubles::text() const {
    std::string out;
    for (const auto& [cause, words] : words_)
        out += (out.empty() ? "" : "\n") + words;
    return out;
}

bool showNotices(const std::string& problem, const std::string& message, float left, float right) {
    if (problem.empty() && message.empty()) return false;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    float width = screen.x - left - right;
    const bool narrow = width < points(260);  // no room between the panels: over their ends
    if (narrow) left = points(12), width = screen.x - points(24);
    ImGui::SetNextWindowPos(ImVec2(left, narrow ? screen.y - points(12) : points(12)), ImGuiCond_Always,
                            ImVec2(0, narrow ? 1 : 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.2f, 0.07f, 0.05f, 0.94f));
    ImGui::Begin("Message", nullptr, plainWindow);
    if (!problem.empty()) {
        ImGui::TextColored(ImVec4(1, 0.62f, 0.5f, 1),
                           "A changed file does not run; what ran before runs on:");
        ImGui::TextWrapped("%s", firstLines(problem).c_str());
    }
    if (!problem.empty() && !message.empty()) ImGui::Separator();
    bool closed = false;
    if (!message.empty()) {
        ImGui::TextWrapped("%s", firstLines(message).c_str());
        closed = ImGui::Button("Close");
    }
    ImGui::End();
    ImGui::PopStyleColor();
    return closed;
}

void showWarnings(const std::vector<Warning>& warnings, float right, float bottom) {
    if (warnings.empty()) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(screen.x - right, screen.y - bottom), ImGuiCond_Always, ImVec2(1, 1));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.25f, 0.18f, 0.04f, 0.98f));
    ImGui::Begin("Warnings", nullptr, plainWindow);
    if (ImGui::TreeNode("list", "%s", many(int64_t(warnings.size()), "warning", "warnings").c_str())) {
        ImGui::PushTextWrapPos(std::min(points(460), screen.x - points(24)));
        for (const Warning& warning : warnings)
            ImGui::TextUnformatted(inLetters(text(warning)).c_str());
        ImGui::PopTextWrapPos();
        ImGui::TreePop();
    }
    ImGui::End();
    ImGui::PopStyleColor();
}

void StatusLine::say(const std::string& line) {
    line_ = line;
    saidAt_ = ImGui::GetTime();
}

void StatusLine::draw(const std::string& instead) {
    constexpr double shownFor = 4;  // s
    if (instead.empty() && ImGui::GetTime() - saidAt_ > shownFor) return;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, screen.y - points(12)), ImGuiCond_Always,
                            ImVec2(0.5f, 1));
    ImGui::Begin("Status", nullptr, plainWindow | ImGuiWindowFlags_NoInputs);
    if (!instead.empty())
        ImGui::TextColored(ImVec4(1, 0.45f, 0.35f, 1), "%s", instead.c_str());
    else
        ImGui::TextUnformatted(line_.c_str());
    ImGui::End();
}

void drawWaiting(const std::string& words, double share) {
    centered();
    ImGui::Begin("Waiting", nullptr, plainWindow | ImGuiWindowFlags_NoInputs);
    ImGui::TextWrapped("%s", words.c_str());
    if (share > 0) ImGui::ProgressBar(float(share), ImVec2(-FLT_MIN, points(10)), "");
    ImGui::End();
}

Answer askBeforeLeaving(const std::string& file, const char* what) {
    Answer answer = Answer::none;
    if (!beginQuestion("Close")) return answer;
    ImGui::TextWrapped("What you changed is not saved in %s.",
                       std::filesystem::path(file).filename().string().c_str());
    if (ImGui::Button(concat("Save and ", what).c_str())) answer = Answer::save;
    ImGui::SameLine();
    if (ImGui::Button("Do not save")) answer = Answer::discard;
    ImGui::SameLine();
    if (ImGui::Button("Stay")) answer = Answer::stay;
    if (answer != Answer::none) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return answer;
}

std::optional<Prefer> askWhoWins(const std::vector<std::string>& conflicts) {
    std::optional<Prefer> answer;
    if (conflicts.empty() && !ImGui::IsPopupOpen("Conflict")) return answer;
    if (!beginQuestion("Conflict")) return answer;
    ImGui::TextWrapped("The file has changed what you changed here, too, and not in the same way:");
    for (const std::string& conflict : conflicts)
        ImGui::BulletText("%s", conflict.c_str());
    ImGui::TextWrapped("Everything else of both is kept.");
    if (ImGui::Button("Keep mine")) answer = Prefer::mine;
    ImGui::SameLine();
    if (ImGui::Button("Take the file's")) answer = Prefer::theirs;
    if (answer || conflicts.empty()) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
    return answer;
}

void beginMiddle(const char* title, bool* open, float widest) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float width = std::min(points(widest), screen.x - points(24));
    ImGui::SetNextWindowPos(ImVec2(0.5f * screen.x, 0.5f * screen.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, screen.y - points(24)));
    ImGui::SetNextWindowBgAlpha(0.98f);  // panels that it lies on are not read through it
    ImGui::Begin(title, open,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
}

bool showHelp(const char* title, const HelpRow* rows) {
    bool open = true;
    beginMiddle(title, &open, 500);
    for (; rows->keys; ++rows) {
        ImGui::TextColored(ImVec4(0.62f, 0.78f, 0.45f, 1), "%s", rows->keys);
        ImGui::SameLine(points(172));
        ImGui::TextUnformatted(rows->what);
    }
    ImGui::End();
    return open;
}

}  // namespace shoal::window
