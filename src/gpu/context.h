// An OpenGL core context of 3.3 or newer: in a window (GLFW), on EGL without a display, or on OSMesa.
//
// One binary holds all three and none is linked: libEGL and libOSMesa are opened when they are asked for.
// One thread at a time uses a context: GLEW's function pointers belong to the process, so contexts of
// different kinds may live side by side, but only the one made current last may be used. Textures, buffers
// and the like must be destroyed before their context and while it is current.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"

struct GLFWwindow;

namespace shoal::gpu {

// Bytes that crossed the bus, so that "the GPU keeps the state" can be asserted instead of believed.
//
// A frame after start-up moves 0 bytes of state and at most 256 bytes of control. Uniforms are not counted
// one by one: they are a few hundred bytes of arguments, not data. Textures and buffers are.
struct Traffic {
    enum class Kind {
        state,       // particle data: positions, velocities, normals; set-up and exports only
        parameters,  // tables, meshes, images, fields: what a scene is made of, and pictures that come back
        control,     // watchdog, counters, timers
        births,      // places that allocators on the CPU hand out, 4 bytes a newborn
    };
    static constexpr const char* names[] = {"state", "parameters", "control",
                                            "births"};  // in the order of Kind
    static constexpr int kinds = 4;
    static constexpr uint64_t controlBytesPerFrame = 256;  // at most, all readers together

    uint64_t uploaded[kinds] = {};
    uint64_t readBack[kinds] = {};

    void countUpload(Kind kind, size_t bytes) { uploaded[static_cast<size_t>(kind)] += bytes; }
    void countReadBack(Kind kind, size_t bytes) { readBack[static_cast<size_t>(kind)] += bytes; }
    uint64_t up(Kind kind) const { return uploaded[static_cast<size_t>(kind)]; }
    uint64_t down(Kind kind) const { return readBack[static_cast<size_t>(kind)]; }
    uint64_t total(Kind kind) const { return up(kind) + down(kind); }
    void reset() { *this = Traffic{}; }
};

// Returns the bytes that crossed between two readings of the counters.
inline Traffic operator-(const Traffic& after, const Traffic& before) {
    Traffic difference;
    for (int i = 0; i < Traffic::kinds; ++i) {
        difference.uploaded[i] = after.uploaded[i] - before.uploaded[i];
        difference.readBack[i] = after.readBack[i] - before.readBack[i];
    }
    return difference;
}

// The device is gone, and all that it held: nothing that follows means anything.
class DeviceLost : public Error {
    using Error::Error;
};

class Platform;
class ProgramCache;

enum class ContextKind { automatic, window, egl, osmesa, given };  // given: the caller's own

// "auto", "window", "egl" or "osmesa". Error: anything else, with the nearest of them.
ContextKind contextKind(const std::string& word);
const char* name(ContextKind kind);
// Tells whether there is a display (DISPLAY or WAYLAND_DISPLAY is set) that a window could be opened on.
bool hasDisplay();

struct ContextOptions {
    ContextKind kind = ContextKind::automatic;
    bool preferWindow = false;  // automatic: where there is a display a window's, else headless
    bool debug = false;         // the driver's messages on stderr (OpenGL 4.3+)
    // The functions of OpenGL by name (as eglGetProcAddress gives them): the caller has made a context, which
    // is current now and whenever Shoal is called. It is never released or destroyed.
    void (*(*loader)(const char* name))() = nullptr;
    std::optional<int> device;  // EGL: that of probeDevices(); nothing: the best that there is
    std::string shaders = {};   // folder of the shaders that programs are made of
    std::string cache = {};     // folder in which linked programs are kept; empty: nowhere
};
// Of a context that makes programs of the shaders that ship, and keeps them in the user's cache.
ContextOptions contextOptions();

// How often all loops of a shader together turn on Mesa's CPU rasterisers, which then leave every loop after
// one more turn and say nothing. A loop counts once more than it turns.
constexpr int mostSoftwareTurns = 65535;

struct ContextInfo {
    ContextKind kind = ContextKind::automatic;  // never automatic once there is a context
    std::string platform;                       // such as "EGL surfaceless", for people
    std::string renderer, vendor, version, glslVersion;
    int major = 0, minor = 0;
    bool software = false;  // a CPU rasteriser

    int maxTextureSize = 0, maxColorAttachments = 0, maxSamples = 0, maxVertexTextureUnits = 0;
    int maxTextureUnits = 0;  // of a program, all stages together
    int max3DTextureSize = 0, maxTextureLayers = 0;
    float maxPointSize = 1;  // pixels, of GL_POINTS
    int64_t maxBufferTexels = 0;
    int maxUniformBlockBytes = 0, maxFragmentUniformComponents = 0;
    bool computeShaders = false;  // 4.3+: by version, never by extension
    // These limit compute shaders and what they read; all 0 below 4.3.
    int64_t maxStorageBlockBytes = 0;
    int maxWorkGroupsX = 0, maxSharedBytes = 0, maxComputeUniformComponents = 0;
    int textureBufferAlignment = 0, storageBufferAlignment = 0;  // of the offsets of ranges, in bytes
    // GL_KHR_shader_subgroup with basic and shuffle operations in compute shaders. This and
    // groupVote go by an extension, because no version that is common has them; still false below 4.3.
    bool subgroups = false;
    // anyInvocationARB (GL_ARB_shader_group_vote).
    bool groupVote = false;
    // By an extension: textureGather of a shadow map (GL_ARB_gpu_shader5); that a fragment may write a
    // stencil value (GL_ARB_shader_stencil_export).
    bool shadowGather = false, stencilExport = false;

    bool atLeast(int wantedMajor, int wantedMinor) const {
        return major > wantedMajor || (major == wantedMajor && minor >= wantedMinor);
    }
};

class Context {
  public:
    // The context is current afterwards. Error: none to be had; says what was tried, why each way failed and
    // what to install.
    explicit Context(const ContextOptions& options = {});

    void makeCurrent();
    // Another thread may make it current afterwards.
    void leave();
    bool isCurrent() const;
    const ContextInfo& info() const { return state_->info; }
    Traffic& traffic() { return state_->traffic; }
    const std::string& shaders() const { return state_->shaders; }
    ProgramCache& cache() const { return *state_->cache; }  // gpu/program_cache.h
    // Sets the folder of the shaders of programs that are made from now on.
    void setShaders(const std::string& folder) { state_->shaders = folder; }
    // Files on disk that programs of this context were made of.
    const std::set<std::string>& shaderFiles() const { return state_->shaderFiles; }
    void noteShaderFile(const std::string& file) { state_->shaderFiles.insert(file); }
    // Opens a window with a context of its own, which shares textures and buffers with this one. This one
    // must be of the kind `window`, which itself never shows; the caller destroys the window first. Error:
    // none is to be had.
    GLFWwindow* openWindow(int width, int height) const;
    // Error: OpenGL reports a mistake since the last call; `where` names the work that was done.
    void checkErrors(const char* where);
    // DeviceLost: the driver has reset the device since the context was made. Below OpenGL 4.5, and where the
    // driver does not tell, nothing.
    void checkAlive() const;

    // On the heap, so that whoever borrows it need not care where the Context has moved.
    struct State {
        std::unique_ptr<Platform> platform;
        ContextInfo info;
        Traffic traffic;
        std::string shaders;
        std::unique_ptr<ProgramCache> cache;
        std::set<std::string> shaderFiles;
        unsigned noAttributes = 0;  // a vertex array
        State();
        ~State();
    };

  private:
    std::unique_ptr<State> state_;
};

// Lists the contexts that this machine offers, for `shoal info`.
struct ContextProbe {
    ContextKind kind = ContextKind::automatic;
    std::optional<ContextInfo> info;  // empty when the context cannot be had
    std::string reason;               // why not, and what to install
};

// Window, EGL and OSMesa, each tried in turn and given back. Whatever context was current stays so.
std::vector<ContextProbe> probeContexts();
// The devices of EGL, by their numbers.
std::vector<ContextProbe> probeDevices();

}  // namespace shoal::gpu
