#include "app/interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

namespace shoal::app {

static void style() {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 6;
    style.FrameRounding = style.GrabRounding = 4;
    style.WindowPadding = ImVec2(12, 10);
    style.ItemSpacing = ImVec2(8, 5);
    style.WindowBorderSize = 0;
    const auto color = [&](ImGuiCol which, float r, float g, float b, float a) {
        style.Colors[which] = ImVec4(r, g, b, a);
    };
    color(ImGuiCol_WindowBg, 0.07f, 0.085f, 0.08f, 0.88f);
    color(ImGuiCol_TitleBg, 0.11f, 0.16f, 0.11f, 0.95f);
    color(ImGuiCol_TitleBgActive, 0.16f, 0.25f, 0.14f, 1);
    color(ImGuiCol_FrameBg, 0.17f, 0.2f, 0.18f, 1);
    color(ImGuiCol_FrameBgHovered, 0.22f, 0.28f, 0.22f, 1);
    color(ImGuiCol_FrameBgActive, 0.26f, 0.34f, 0.25f, 1);
    color(ImGuiCol_CheckMark, 0.5f, 0.68f, 0.33f, 1);
    color(ImGuiCol_SliderGrab, 0.5f, 0.68f, 0.33f, 1);
    color(ImGuiCol_SliderGrabActive, 0.62f, 0.8f, 0.42f, 1);
    color(ImGuiCol_PlotHistogram, 0.3f, 0.44f, 0.22f, 1);
    color(ImGuiCol_Button, 0.22f, 0.32f, 0.19f, 1);
    color(ImGuiCol_ButtonHovered, 0.3f, 0.44f, 0.25f, 1);
    color(ImGuiCol_ButtonActive, 0.38f, 0.55f, 0.3f, 1);
    color(ImGuiCol_Header, 0.22f, 0.32f, 0.19f, 1);
    color(ImGuiCol_HeaderHovered, 0.3f, 0.44f, 0.25f, 1);
    color(ImGuiCol_HeaderActive, 0.38f, 0.55f, 0.3f, 1);
    color(ImGuiCol_TableHeaderBg, 0.13f, 0.17f, 0.13f, 1);
}

Interface::Interface(GLFWwindow* window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the panel's place is not worth a file in the user's folder
    style();
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 330");
}

Interface::~Interface() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Interface::begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Interface::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace shoal::app
