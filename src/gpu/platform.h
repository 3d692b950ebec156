// Declares the common interface of the three ways to a context, and where OpenGL's functions come from at the
// moment; used inside `gpu` only.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gpu/context.h"

namespace shoal::gpu {

using Procedure = void (*)();
using Loader = Procedure (*)(const char* name);

struct CurrentLoader {
    Loader load = nullptr;    // null: no context of ours is current
    bool isWindow = false;    // GLX or EGL below GLFW: the process's own libGL serves it
    unsigned generation = 1;  // counts the changes, so that pointers found earlier can be thrown away
};

// A global, because OpenGL's "current context" is one, and because glXGetProcAddressARB and the OpenGL 1.1
// functions (gpu/forward.cpp) have no argument that could carry it. context.cpp sets it.
inline CurrentLoader currentLoader;

class Platform {
  public:
    virtual ~Platform() = default;  // also releases
    virtual void makeCurrent() = 0;
    virtual void release() = 0;  // afterwards nothing is current on this thread
    virtual Loader loader() const = 0;
    virtual std::string description() const = 0;
    virtual bool isWindow() const { return false; }
    virtual GLFWwindow* openWindow(int, int) const { return nullptr; }
};

// Error: cannot be had, and why. Nothing may be current when they are called.
std::unique_ptr<Platform> createWindowPlatform(const ContextOptions& options);
std::unique_ptr<Platform> createEglPlatform(const ContextOptions& options);
std::unique_ptr<Platform> createGivenPlatform(const ContextOptions& options);
int countEglDevices();
std::unique_ptr<Platform> createOsmesaPlatform(const ContextOptions& options);

// Asked for in this order: drivers may refuse a version above theirs, and some give exactly what was asked.
// The last asks for anything at all, so that a context that is too old can be named.
struct AskedVersion {
    int major, minor;
    bool any() const { return major == 0; }
};
inline constexpr AskedVersion askedVersions[] = {{4, 6}, {4, 5}, {4, 4}, {4, 3}, {4, 2},
                                                 {4, 1}, {4, 0}, {3, 3}, {0, 0}};

// ---- Drivers that crash (context_trial.cpp)

// Makes a context in a fork. Returns how that crashed; empty: it did not.
std::string crashInChild(const std::function<void()>& make);

// A driver, by all that chooses it, whose first context has been made in a child.
class TriedDriver {
  public:
    // `folder`: of the cache; empty: nothing can be remembered, and it counts as known.
    TriedDriver(const std::string& folder, const std::string& kind, std::optional<int> device);
    bool isKnown() const;
    void remember() const;

  private:
    std::filesystem::path mark_;
};

bool isSoftwareRenderer(const std::string& renderer);

}  // namespace shoal::gpu
