// A context of a window that is never shown, through GLFW (X11 or Wayland, whichever GLFW was built for), and
// windows that show what is drawn in it.

#include "core/error.h"
#include "core/file.h"
#include "gpu/platform.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace shoal::gpu {
namespace {

// GLFW is one per process and does not count its users; so we do.
int windowCount = 0;

std::string lastGlfwError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no reason given";
}

class GlfwSession {
  public:
    GlfwSession() {
#ifdef GLFW_PLATFORM  // 3.4
        // Wayland cannot be reached without the folder of its sockets, and its library would say so on
        // stderr.
        if (environment("XDG_RUNTIME_DIR").empty() && glfwPlatformSupported(GLFW_PLATFORM_X11) == GLFW_TRUE)
            glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (glfwInit() != GLFW_TRUE) throw Error("GLFW does not start: " + lastGlfwError());
        ++windowCount;
    }
    ~GlfwSession() {
        if (--windowCount == 0) glfwTerminate();
    }
    GlfwSession(const GlfwSession&) = delete;
    GlfwSession& operator=(const GlfwSession&) = delete;
};

class WindowPlatform final : public Platform {
  public:
    explicit WindowPlatform(const ContextOptions& options) {
        std::string reason;
        for (const AskedVersion version : askedVersions) {
            hint(options.debug, version);
            constexpr int side = 64;  // nothing is drawn into it
            window_ = glfwCreateWindow(side, side, "Shoal", nullptr, nullptr);
            version_ = version, debug_ = options.debug;
            if (window_ != nullptr) break;
            const char* text = nullptr;
            const int code = glfwGetError(&text);
            if (reason.empty() && text != nullptr) reason = text;
            if (code != GLFW_VERSION_UNAVAILABLE && code != GLFW_API_UNAVAILABLE) break;
        }
        if (window_ == nullptr) throw Error("no window: " + (reason.empty() ? "no reason given" : reason));
    }
    ~WindowPlatform() override {
        if (glfwGetCurrentContext() == window_) glfwMakeContextCurrent(nullptr);
        glfwDestroyWindow(window_);
    }

    void makeCurrent() override {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() != window_)
            throw Error("the window's context cannot be made current: " + lastGlfwError());
    }
    void release() override { glfwMakeContextCurrent(nullptr); }
    Loader loader() const override { return &glfwGetProcAddress; }
    std::string description() const override { return concat("window, GLFW ", glfwGetVersionString()); }
    bool isWindow() const override { return true; }
    GLFWwindow* openWindow(int width, int height) const override {
        hint(debug_, version_);
        glfwWindowHint(GLFW_VISIBLE, GLFW_TRUE);
        GLFWwindow* window = glfwCreateWindow(width, height, "Shoal", nullptr, window_);
        if (window == nullptr) throw Error("no window: " + lastGlfwError());
        return window;
    }

  private:
    static void hint(bool debug, AskedVersion version) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug ? GLFW_TRUE : GLFW_FALSE);
        if (!version.any()) {
            glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version.major);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version.minor);
            glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
            glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        }
    }

    GlfwSession session_;
    GLFWwindow* window_ = nullptr;
    AskedVersion version_{0, 0};
    bool debug_ = false;
};

}  // namespace

bool hasDisplay() {
    return !environment("DISPLAY").empty() || !environment("WAYLAND_DISPLAY").empty();
}

std::unique_ptr<Platform> createWindowPlatform(const ContextOptions& options) {
    if (!hasDisplay()) throw Error("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set)");
    return std::make_unique<WindowPlatform>(options);
}

}  // namespace shoal::gpu
