#include "window/interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "window/notices.h"

namespace shoal::window {

// Points: the size at which the built-in font was drawn, and the em square of others.
static constexpr double builtInHeight = 13, em = 12;

static float unitsPerPoint = 1;  // of the font as it is now

// `line`: points, of the font. Rows are as far apart as with the built-in font, as far as there is room.
static void style(float line) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark();
    style.WindowRounding = 6;
    style.FrameRounding = style.GrabRounding = 4;
    style.WindowPadding = ImVec2(12, 10);
    style.ItemSpacing = ImVec2(8, std::clamp(18 - line, 3.0f, 5.0f));
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
    color(ImGuiCol_SliderGrab, 0.5f, 0.68f, 0.33f, 0.55f);  // numbers are read through it
    color(ImGuiCol_SliderGrabActive, 0.62f, 0.8f, 0.42f, 0.65f);
    color(ImGuiCol_PlotHistogram, 0.3f, 0.44f, 0.22f, 1);
    color(ImGuiCol_Button, 0.22f, 0.32f, 0.19f, 1);
    color(ImGuiCol_ButtonHovered, 0.3f, 0.44f, 0.25f, 1);
    color(ImGuiCol_ButtonActive, 0.38f, 0.55f, 0.3f, 1);
    color(ImGuiCol_Header, 0.22f, 0.32f, 0.19f, 1);
    color(ImGuiCol_HeaderHovered, 0.3f, 0.44f, 0.25f, 1);
    color(ImGuiCol_HeaderActive, 0.38f, 0.55f, 0.3f, 1);
    color(ImGuiCol_TableHeaderBg, 0.13f, 0.17f, 0.13f, 1);
    style.ScaleAllSizes(unitsPerPoint);
}

Interface::Interface(GLFWwindow* window, std::optional<double> scale)
    : window_(window), scale_(scale), outlines_(systemFont()) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the panel's place is not worth a file in the user's folder
    // Rows are reached by Tab and arrows; other keys stay those of the window meanwhile.
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavNoCaptureKeyboard;
    ImGui_ImplGlfw_InitForOpenGL(window, false);
    input_ = std::make_unique<Input>(window);
    ImGui_ImplOpenGL3_Init("#version 330");
    makeFont(density());
}

Interface::~Interface() {
    input_.reset();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

// Where the window system counts in units of several pixels (Wayland, macOS), those are part of the scale
// that it asks for.
Interface::Density Interface::density() const {
    int width = 0, height = 0, pixelsWide = 0, pixelsHigh = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixelsWide, &pixelsHigh);
    if (height < 1 || pixelsHigh < 1) return made_;  // minimised
    float asked = 1, ignored = 1;
    glfwGetWindowContentScale(window_, &asked, &ignored);
    const float pixelsPerPoint = float(std::clamp(scale_.value_or(double(asked)), leastScale, mostScale));
    const float pixelsPerUnit = float(pixelsHigh) / float(height);
    return {pixelsPerPoint / pixelsPerUnit, pixelsPerUnit};
}

void Interface::makeFont(const Density& density) {
    made_ = density;
    unitsPerPoint = density.unitsPerPoint;
    const float pixelsPerPoint = density.unitsPerPoint * density.pixelsPerUnit;
    const float height = std::round(float(outlines_ ? em * outlines_->line : builtInHeight) * pixelsPerPoint);
    style(height / pixelsPerPoint);
    addLetters(outlines_ ? &*outlines_ : nullptr, height);
    ImGui::GetIO().FontGlobalScale = 1 / density.pixelsPerUnit;
#if IMGUI_VERSION_NUM < 19200  // later ones make it as they need it
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
}

float points(float count) {
    return std::round(count * unitsPerPoint);
}

void Interface::begin() {
    begun_ = true;
    const Density current = density();
    if (!(current == made_)) makeFont(current);
    const bool chooses = ImGui::GetIO().NavVisible || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    input_->next(chooses);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    input_->settle();
    ImGui::NewFrame();
}

void Interface::end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

// A frame without the panels would end what is typed, dragged or chosen in them.
void Interface::wait(const std::string& words, double share) {
    input_->wait();
    ImDrawData* panels = ImGui::GetDrawData();
    if (!begun_ || panels == nullptr || IMGUI_VERSION_NUM >= 19200) {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        drawWaiting(words, share);
        return end();
    }
    ImGui_ImplOpenGL3_RenderDrawData(panels);
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
#if IMGUI_VERSION_NUM < 19200
    list.PushTextureID(ImGui::GetIO().Fonts->TexID);
#endif
    list.PushClipRectFullScreen();
    const ImVec2 middle(panels->DisplaySize.x / 2, panels->DisplaySize.y / 2);
    const float half = std::min(points(230), middle.x - points(12)), edge = points(12), line = points(18);
    const ImVec2 low(middle.x - half, middle.y - line - edge), high(middle.x + half, middle.y + line + edge);
    list.AddRectFilled(low, high, ImGui::GetColorU32(ImGuiCol_WindowBg), points(6));
    list.AddText(ImVec2(low.x + edge, low.y + edge), ImGui::GetColorU32(ImGuiCol_Text), words.c_str());
    const ImVec2 bar(low.x + edge, high.y - edge - points(8));
    const float reach = 2 * (half - edge), bottom = high.y - edge;
    if (share > 0) {
        list.AddRectFilled(bar, ImVec2(bar.x + reach, bottom), ImGui::GetColorU32(ImGuiCol_FrameBg));
        list.AddRectFilled(bar, ImVec2(bar.x + float(share) * reach, bottom),
                           ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    }
    ImDrawData data = *panels;
    ImDrawList* lists[] = {&list};
#if IMGUI_VERSION_NUM < 18980
    data.CmdLists = lists;
#else
    data.CmdLists.clear();
    data.CmdLists.push_back(lists[0]);
#endif
    data.CmdListsCount = 1;
    data.TotalVtxCount = list.VtxBuffer.Size;
    data.TotalIdxCount = list.IdxBuffer.Size;
    ImGui_ImplOpenGL3_RenderDrawData(&data);
}

}  // namespace shoal::window
