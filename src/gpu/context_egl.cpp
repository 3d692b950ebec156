// A context of EGL without a display. libEGL is opened when asked for.
//
// The surfaceless platform comes first, then the device platform. Where the surfaceless one is a CPU
// rasteriser and the device platform knows a GPU (as with NVIDIA's driver beside Mesa), the GPU wins, unless
// LIBGL_ALWAYS_SOFTWARE asks otherwise.
#include <dlfcn.h>

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "gpu/platform.h"

namespace shoal::gpu {
namespace {

struct EglApi {
    PFNEGLGETPROCADDRESSPROC getProcAddress = nullptr;
    PFNEGLGETERRORPROC getError = nullptr;
    PFNEGLQUERYSTRINGPROC queryString = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLBINDAPIPROC bindApi = nullptr;
    PFNEGLCHOOSECONFIGPROC chooseConfig = nullptr;
    PFNEGLCREATECONTEXTPROC createContext = nullptr;
    PFNEGLDESTROYCONTEXTPROC destroyContext = nullptr;
    PFNEGLCREATEPBUFFERSURFACEPROC createPbufferSurface = nullptr;
    PFNEGLDESTROYSURFACEPROC destroySurface = nullptr;
    PFNEGLMAKECURRENTPROC makeCurrent = nullptr;
    PFNEGLGETCURRENTCONTEXTPROC getCurrentContext = nullptr;
    // Extensions; null where there are none.
    PFNEGLGETPLATFORMDISPLAYEXTPROC getPlatformDisplay = nullptr;
    PFNEGLQUERYDEVICESEXTPROC queryDevices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC queryDeviceString = nullptr;
    std::string clientExtensions;

    EglApi() {
        void* library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
        if (library == nullptr) throw Error("libEGL.so.1 is not installed");
        load(library, getProcAddress, "eglGetProcAddress");
        load(library, getError, "eglGetError");
        load(library, queryString, "eglQueryString");
        load(library, initialize, "eglInitialize");
        load(library, bindApi, "eglBindAPI");
        load(library, chooseConfig, "eglChooseConfig");
        load(library, createContext, "eglCreateContext");
        load(library, destroyContext, "eglDestroyContext");
        load(library, createPbufferSurface, "eglCreatePbufferSurface");
        load(library, destroySurface, "eglDestroySurface");
        load(library, makeCurrent, "eglMakeCurrent");
        load(library, getCurrentContext, "eglGetCurrentContext");
        loadExtension(getPlatformDisplay, "eglGetPlatformDisplayEXT");
        loadExtension(queryDevices, "eglQueryDevicesEXT");
        loadExtension(queryDeviceString, "eglQueryDeviceStringEXT");
        const char* names = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
        if (names != nullptr) clientExtensions = names;
    }

    template <typename Function>
    static void load(void* library, Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(library, name));
        if (function == nullptr) throw Error(concat("libEGL has no ", name));
    }
    template <typename Function>
    void loadExtension(Function& function, const char* name) {
        function = reinterpret_cast<Function>(getProcAddress(name));
    }
};

// Once per process and never closed: drivers' threads and exit handlers do not survive that.
const EglApi& egl() {
    static const EglApi api;
    return api;
}

bool hasWord(const std::string& words, const std::string& word) {
    return (" " + words + " ").find(" " + word + " ") != std::string::npos;
}

bool displayHas(EGLDisplay display, const char* extension) {
    const char* words = egl().queryString(display, EGL_EXTENSIONS);
    return words != nullptr && hasWord(words, extension);
}

std::string errorText() {
    static constexpr std::pair<EGLint, const char*> words[] = {{EGL_NOT_INITIALIZED, "EGL_NOT_INITIALIZED"},
                                                               {EGL_BAD_ACCESS, "EGL_BAD_ACCESS"},
                                                               {EGL_BAD_ALLOC, "EGL_BAD_ALLOC"},
                                                               {EGL_BAD_ATTRIBUTE, "EGL_BAD_ATTRIBUTE"},
                                                               {EGL_BAD_CONFIG, "EGL_BAD_CONFIG"},
                                                               {EGL_BAD_MATCH, "EGL_BAD_MATCH"},
                                                               {EGL_BAD_PARAMETER, "EGL_BAD_PARAMETER"}};
    const EGLint code = egl().getError();
    for (const auto& [known, word] : words)
        if (code == known) return word;
    return concat("EGL error ", code);
}

// A display is the same object for all who ask for it, and eglTerminate would end it for all of them. So it
// is left to the end of the process, as the libraries are.
EGLDisplay initialised(EGLDisplay display) {
    if (egl().initialize(display, nullptr, nullptr) != EGL_TRUE)
        throw Error("cannot be initialised, " + errorText());
    return display;
}

struct Candidate {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string description;
    bool gpu = false;  // known to be one
    int device = -1;   // its number; none: the surfaceless platform
};

class EglPlatform final : public Platform {
  public:
    EglPlatform(const Candidate& candidate, const ContextOptions& options)
        : display_(initialised(candidate.display)), description_(candidate.description) {
        if (egl().bindApi(EGL_OPENGL_API) != EGL_TRUE) throw Error("has no desktop OpenGL, " + errorText());
        const EGLConfig config = chooseConfig();
        try {
            createContext(config, options);
            if (!displayHas(display_, "EGL_KHR_surfaceless_context")) createSurface(config);
            makeCurrent();
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~EglPlatform() override { destroy(); }

    void makeCurrent() override {
        // The bound API belongs to the thread, and others (such as a toolkit) may have changed it.
        egl().bindApi(EGL_OPENGL_API);
        if (egl().makeCurrent(display_, surface_, surface_, context_) != EGL_TRUE)
            throw Error("the context cannot be made current, " + errorText());
    }
    void release() override { egl().makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    Loader loader() const override { return egl().getProcAddress; }
    std::string description() const override { return description_; }

    std::string renderer() const {
        constexpr unsigned rendererName = 0x1F01;  // GL_RENDERER; GLEW is not ready yet
        using GetString = const unsigned char* (*)(unsigned);
        const auto getString = reinterpret_cast<GetString>(egl().getProcAddress("glGetString"));
        const unsigned char* text = getString != nullptr ? getString(rendererName) : nullptr;
        return text != nullptr ? reinterpret_cast<const char*>(text) : "";
    }

  private:
    EGLConfig chooseConfig() const {
        for (const EGLint surfaceType : {EGLint{EGL_PBUFFER_BIT}, EGLint{0}}) {
            const EGLint attributes[] = {EGL_SURFACE_TYPE, surfaceType, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                         EGL_NONE};
            EGLConfig config = nullptr;
            EGLint count = 0;
            if (egl().chooseConfig(display_, attributes, &config, 1, &count) == EGL_TRUE && count > 0)
                return config;
        }
        throw Error("has no configuration for desktop OpenGL");
    }

    // The driver is asked to say when it has reset the device (checkAlive), for which some refuse a context.
    void createContext(EGLConfig config, const ContextOptions& options) {
        std::string reason;
        for (const bool tellsLoss : {true, false})
            if (createContext(config, options.debug, tellsLoss, reason)) return;
        throw Error("makes no OpenGL context, " + reason);
    }
    bool createContext(EGLConfig config, bool debug, bool tellsLoss, std::string& reason) {
        for (const AskedVersion version : askedVersions) {
            std::vector<EGLint> attributes;
            if (!version.any()) {
                attributes = {EGL_CONTEXT_MAJOR_VERSION_KHR,       version.major,
                              EGL_CONTEXT_MINOR_VERSION_KHR,       version.minor,
                              EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR};
                if (debug)
                    attributes.insert(attributes.end(),
                                      {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
            }
            if (tellsLoss)
                attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_KHR,
                                                     EGL_LOSE_CONTEXT_ON_RESET_KHR});
            attributes.push_back(EGL_NONE);
            context_ = egl().createContext(display_, config, EGL_NO_CONTEXT, attributes.data());
            if (context_ != EGL_NO_CONTEXT) return true;
            reason = errorText();
        }
        return false;
    }

    void createSurface(EGLConfig config) {
        const EGLint attributes[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
        surface_ = egl().createPbufferSurface(display_, config, attributes);
        if (surface_ == EGL_NO_SURFACE)
            throw Error("has neither contexts without a surface nor a pbuffer, " + errorText());
    }

    void destroy() {
        if (context_ != EGL_NO_CONTEXT && egl().getCurrentContext() == context_) release();
        if (surface_ != EGL_NO_SURFACE) egl().destroySurface(display_, surface_);
        if (context_ != EGL_NO_CONTEXT) egl().destroyContext(display_, context_);
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    std::string description_;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

std::vector<Candidate> candidates() {
    std::vector<Candidate> out;
    if (egl().getPlatformDisplay == nullptr) return out;
    if (hasWord(egl().clientExtensions, "EGL_MESA_platform_surfaceless")) {
        const EGLDisplay display = egl().getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display != EGL_NO_DISPLAY) out.push_back({display, "EGL, surfaceless", false});
    }
    if (egl().queryDevices == nullptr || !hasWord(egl().clientExtensions, "EGL_EXT_platform_device"))
        return out;
    EGLDeviceEXT devices[32] = {};
    EGLint count = 0;
    if (egl().queryDevices(32, devices, &count) != EGL_TRUE) return out;
    for (EGLint i = 0; i < count; ++i) {
        const EGLDisplay display = egl().getPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
        if (display == EGL_NO_DISPLAY) continue;
        const char* words = egl().queryDeviceString != nullptr
                                ? egl().queryDeviceString(devices[i], EGL_EXTENSIONS)
                                : nullptr;
        const bool gpu = words != nullptr && !hasWord(words, "EGL_MESA_device_software");
        out.push_back({display, concat("EGL, device ", i), gpu, i});
    }
    return out;
}

bool softwareWanted() {
    const std::string wanted = environment("LIBGL_ALWAYS_SOFTWARE");
    return !wanted.empty() && wanted != "0" && wanted != "false";
}

}  // namespace

int countEglDevices() {
    int count = 0;
    for (const Candidate& candidate : candidates())
        count = std::max(count, candidate.device + 1);
    return count;
}

static std::unique_ptr<Platform> createOnDevice(const ContextOptions& options) {
    for (const Candidate& candidate : candidates())
        if (candidate.device == *options.device) return std::make_unique<EglPlatform>(candidate, options);
    const int count = countEglDevices();
    throw Error("there is no device ", *options.device, ": ",
                count == 0 ? std::string("EGL lists none") : concat("shoal info lists 0 to ", count - 1));
}

std::unique_ptr<Platform> createEglPlatform(const ContextOptions& options) {
    if (options.device) return createOnDevice(options);
    std::unique_ptr<EglPlatform> software;  // to fall back to
    std::string tried;
    for (const Candidate& candidate : candidates()) {
        if (software != nullptr && !candidate.gpu) continue;
        if (candidate.gpu && softwareWanted()) continue;
        if (software != nullptr) software->release();
        try {
            auto platform = std::make_unique<EglPlatform>(candidate, options);
            if (!isSoftwareRenderer(platform->renderer())) return platform;
            platform->release();
            if (software == nullptr) software = std::move(platform);
        } catch (const Error& error) {
            tried += (tried.empty() ? "" : "; ") + candidate.description + ": " + error.message();
        }
    }
    if (software != nullptr) return software;
    throw Error(tried.empty() ? "libEGL offers neither the surfaceless nor the device platform" : tried);
}

}  // namespace shoal::gpu
