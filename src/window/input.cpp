#include "window/interface.h"

#include <backends/imgui_impl_glfw.h>

#define GLFW_INCLUDE_NONE  // gpu/gl.h declares OpenGL
#include <GLFW/glfw3.h>

#include <cfloat>
#include <cstdlib>

namespace shoal::window {

namespace {

Input& inputOf(GLFWwindow* window) {
    return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

// They change what a press means, and mean nothing by themselves.
bool isModifier(int key) {
    return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

}  // namespace

// Keys are asked of GLFW, not of ImGui, whose key codes changed their type in 1.89.
Input::Input(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, this);
    double x = 0, y = 0;
    glfwGetCursorPos(window, &x, &y);
    place_ = ImVec2(float(x), float(y));
    if (const char* file = std::getenv("SHOAL_FRAMES")) frames_.open(file, std::ios::app);
    listen();
}

Input::~Input() {
    glfwSetCursorPosCallback(window_, nullptr);
    glfwSetMouseButtonCallback(window_, nullptr);
    glfwSetScrollCallback(window_, nullptr);
    glfwSetKeyCallback(window_, nullptr);
    glfwSetCharCallback(window_, nullptr);
    glfwSetDropCallback(window_, nullptr);
    glfwSetWindowFocusCallback(window_, nullptr);
    glfwSetCursorEnterCallback(window_, nullptr);
    glfwSetWindowUserPointer(window_, nullptr);
}

void Input::listen() {
    using Kind = Event::Kind;
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        inputOf(window).add({.kind = Kind::move, .x = x, .y = y});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
        if (button < IM_ARRAYSIZE(ImGuiIO::MouseDown))
            inputOf(window).add({.kind = Kind::button, .code = button, .down = action == GLFW_PRESS});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
        inputOf(window).add({.kind = Kind::wheel, .x = x, .y = y});
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scan, int action, int modifiers) {
        if (action == GLFW_REPEAT) return;  // ImGui repeats by itself
        inputOf(window).add({.kind = Kind::key,
                             .code = key,
                             .down = action == GLFW_PRESS,
                             .scan = scan,
                             .modifiers = modifiers});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned letter) {
        inputOf(window).add({.kind = Kind::text, .code = int(letter)});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** files) {
        for (int i = 0; i < count; ++i)
            inputOf(window).arrived_.emplace_back(files[i]);
    });
    glfwSetWindowFocusCallback(window_, ImGui_ImplGlfw_WindowFocusCallback);
    glfwSetCursorEnterCallback(window_, ImGui_ImplGlfw_CursorEnterCallback);
}

void Input::wait() {
    if (frames_.is_open()) frames_.put('w').flush();
}

void Input::next(bool chooses) {
    if (frames_.is_open() && waiting_.empty()) frames_.put('.').flush();
    pressed_.clear();
    dropped_ = std::exchange(arrived_, {});
    acts_ = !buttons_.empty() || !down_.empty();
    Taken taken;
    while (!waiting_.empty() && !taken.ends && fits(waiting_.front(), taken)) {
        const Event event = waiting_.front();
        waiting_.pop_front();
        take(event, taken);
        acts_ = acts_ || event.kind != Event::Kind::move;
    }
    for (const int key : {GLFW_KEY_SPACE, GLFW_KEY_HOME, GLFW_KEY_ESCAPE})
        if (chooses) pressed_.erase(key);
}

// Whether this frame takes the event. Other events after a move or the wheel wait for the next frame, where
// pointer and picture have followed. So does a key that is pressed again, so that its release is seen.
bool Input::fits(const Event& event, const Taken& taken) const {
    using Kind = Event::Kind;
    if (taken.rolled) return event.kind == Kind::wheel;
    if (taken.moved) return event.kind == Kind::move;
    return event.kind != Kind::key || !event.down || !taken.released.contains(event.code);
}

void Input::take(const Event& event, Taken& taken) {
    using Kind = Event::Kind;
    switch (event.kind) {
    case Kind::move:
        place_ = ImVec2(float(event.x), float(event.y));
        taken.moved = true;
        break;
    case Kind::wheel:
        ImGui_ImplGlfw_ScrollCallback(window_, event.x, event.y);
        taken.rolled = true;
        break;
    case Kind::button:
        if (event.down)
            buttons_.insert(event.code);
        else
            buttons_.erase(event.code);
        taken.ends = true;
        break;
    case Kind::key:
        ImGui_ImplGlfw_KeyCallback(window_, event.code, event.scan, event.down ? GLFW_PRESS : GLFW_RELEASE,
                                   event.modifiers);
        if (event.down) {
            down_.insert(event.code);
            pressed_.insert(event.code);
        } else {
            down_.erase(event.code);
            taken.released.insert(event.code);
        }
        // One press a frame, so that what it does is done before the next; but a text comes as fast as it is
        // typed.
        taken.ends = event.down && !isModifier(event.code) &&
                     (waiting_.empty() || waiting_.front().kind != Kind::text);
        break;
    case Kind::text:
        ImGui_ImplGlfw_CharCallback(window_, unsigned(event.code));
        taken.ends = !ImGui::GetIO().WantTextInput;
        break;
    }
}

void Input::settle() {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(place_.x, place_.y);
    for (int button = 0; button < IM_ARRAYSIZE(io.MouseDown); ++button)
        if (buttons_.contains(button) != io.MouseDown[button])
            io.AddMouseButtonEvent(button, buttons_.contains(button));
#else
    const bool outside = io.MousePos.x == -FLT_MAX;
    if (!outside || !waiting_.empty() || !buttons_.empty()) io.MousePos = place_;
    for (int button = 0; button < IM_ARRAYSIZE(io.MouseDown); ++button)
        io.MouseDown[button] = buttons_.contains(button);
#endif
}

bool Input::control() const {
    return held(GLFW_KEY_LEFT_CONTROL) || held(GLFW_KEY_RIGHT_CONTROL);
}

}  // namespace shoal::window
