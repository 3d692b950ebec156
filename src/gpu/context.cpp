#include "gpu/context.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/cache_folder.h"
#include "core/contract.h"
#include "core/data_paths.h"
#include "core/error.h"
#include "core/printable.h"
#include "gpu/current.h"
#include "gpu/framebuffer.h"
#include "gpu/gl.h"
#include "gpu/platform.h"
#include "gpu/program.h"
#include "gpu/program_cache.h"

namespace shoal::gpu {

// Globals, because OpenGL's current context and GLEW's function pointers are.
static Context::State* currentState = nullptr;
static Loader glewLoader = nullptr;  // whose functions GLEW's pointers are

static void setCurrentLoader(Loader load, bool isWindow) {
    if (load == currentLoader.load && isWindow == currentLoader.isWindow) return;
    currentLoader = {load, isWindow, currentLoader.generation + 1};
}

void leaveCurrent() {
    if (currentState != nullptr) currentState->platform->release();
    currentState = nullptr;
    setCurrentLoader(nullptr, false);
}

Context::State::State() = default;
Context::State::~State() {
    if (currentState != this) return;
    if (noAttributes != 0) glDeleteVertexArrays(1, &noAttributes);  // a given context lives on
    leaveCurrent();
}

static void initGlew(Loader loader) {
    glewExperimental = GL_TRUE;
    const GLenum result = glewInit();
    // GLEW loads OpenGL first and GLX last. Under EGL it then finds no GLX display, under OSMesa no GLX at
    // all; OpenGL's pointers are valid in both cases.
    if (result != GLEW_OK && result != GLEW_ERROR_NO_GLX_DISPLAY &&
        result != GLEW_ERROR_GLX_VERSION_11_ONLY) {
        glewLoader = nullptr;
        throw Error(concat("OpenGL's functions cannot be loaded: ",
                           reinterpret_cast<const char*>(glewGetErrorString(result))));
    }
    glewLoader = loader;
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) {
        // Errors of GLEW's queries are not ours.
    }
}

// `fresh`: a context that was never current may come from another driver behind the same loader.
static void enter(Context::State& state, bool fresh) {
    // Two kinds must not be current at once: GLX, EGL and OSMesa share Mesa's per-thread state.
    if (currentState != &state) leaveCurrent();
    state.platform->makeCurrent();
    currentState = &state;
    const Loader loader = state.platform->loader();
    setCurrentLoader(loader, state.platform->isWindow());
    if (fresh || glewLoader != loader) initGlew(loader);
}

static void restore(Context::State* state) {
    if (state == nullptr)
        leaveCurrent();
    else if (state != currentState)
        enter(*state, false);
}

bool isSoftwareRenderer(const std::string& renderer) {
    for (const char* word : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer", "SwiftShader", "SWR",
                             "Microsoft Basic Render", "GDI Generic"}) {
        if (renderer.find(word) != std::string::npos) return true;
    }
    return false;
}

static std::string getString(GLenum what) {
    const GLubyte* text = glGetString(what);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

static int getInteger(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

static bool hasExtension(const char* name) {
    const int count = getInteger(GL_NUM_EXTENSIONS);
    for (int i = 0; i < count; ++i) {
        const GLubyte* text = glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (text != nullptr && std::strcmp(reinterpret_cast<const char*>(text), name) == 0) return true;
    }
    return false;
}

static bool hasSubgroups() {
    if (!hasExtension("GL_KHR_shader_subgroup")) return false;
    constexpr int features = GL_SUBGROUP_FEATURE_BASIC_BIT_KHR | GL_SUBGROUP_FEATURE_SHUFFLE_BIT_KHR;
    return (getInteger(GL_SUBGROUP_SUPPORTED_STAGES_KHR) & GL_COMPUTE_SHADER_BIT) != 0 &&
           (getInteger(GL_SUBGROUP_SUPPORTED_FEATURES_KHR) & features) == features;
}

static void readComputeLimits(ContextInfo& info) {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    info.maxStorageBlockBytes = bytes;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &info.maxWorkGroupsX);
    info.maxComputeUniformComponents = getInteger(GL_MAX_COMPUTE_UNIFORM_COMPONENTS);
    info.maxSharedBytes = getInteger(GL_MAX_COMPUTE_SHARED_MEMORY_SIZE);
    info.textureBufferAlignment = getInteger(GL_TEXTURE_BUFFER_OFFSET_ALIGNMENT);
    info.storageBufferAlignment = getInteger(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
    info.subgroups = hasSubgroups();
    info.groupVote = hasExtension("GL_ARB_shader_group_vote");
}

static ContextInfo readInfo(ContextKind kind, const Platform& platform) {
    ContextInfo info;
    info.kind = kind;
    info.platform = platform.description();
    info.renderer = getString(GL_RENDERER);
    info.vendor = getString(GL_VENDOR);
    info.version = getString(GL_VERSION);
    info.glslVersion = getString(GL_SHADING_LANGUAGE_VERSION);
    info.software = isSoftwareRenderer(info.renderer);
    info.shadowGather = hasExtension("GL_ARB_gpu_shader5");
    info.stencilExport = hasExtension("GL_ARB_shader_stencil_export");
    if (std::sscanf(info.version.c_str(), "%d.%d", &info.major, &info.minor) != 2 || !info.atLeast(3, 3))
        throw Error(concat("found OpenGL ",
                           info.version.empty() ? "of unknown version" : info.version.c_str(), " (",
                           info.renderer, "), 3.3 or newer is needed"));
    info.maxTextureSize = getInteger(GL_MAX_TEXTURE_SIZE);
    info.maxColorAttachments =
        std::min(getInteger(GL_MAX_COLOR_ATTACHMENTS), getInteger(GL_MAX_DRAW_BUFFERS));
    info.maxSamples = getInteger(GL_MAX_SAMPLES);
    info.maxVertexTextureUnits = getInteger(GL_MAX_VERTEX_TEXTURE_IMAGE_UNITS);
    info.maxTextureUnits = std::min(getInteger(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS), editUnit);
    info.max3DTextureSize = getInteger(GL_MAX_3D_TEXTURE_SIZE);
    info.maxUniformBlockBytes = getInteger(GL_MAX_UNIFORM_BLOCK_SIZE);
    info.maxFragmentUniformComponents = getInteger(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS);
    info.maxTextureLayers = getInteger(GL_MAX_ARRAY_TEXTURE_LAYERS);
    GLfloat pointSizes[2] = {1, 1};
    glGetFloatv(GL_POINT_SIZE_RANGE, pointSizes);
    info.maxPointSize = pointSizes[1];
    info.maxBufferTexels = getInteger(GL_MAX_TEXTURE_BUFFER_SIZE);
    info.computeShaders = info.atLeast(4, 3);
    if (info.computeShaders) readComputeLimits(info);
    return info;
}

static void GLAPIENTRY printMessage(GLenum, GLenum, GLuint, GLenum severity, GLsizei, const GLchar* text,
                                    const void*) {
    if (severity != GL_DEBUG_SEVERITY_NOTIFICATION)
        std::fprintf(stderr, "OpenGL: %s\n", printableLines(indented(text)).c_str());
}

// ---- The kinds of contexts

struct KindRow {
    ContextKind kind;
    const char* name;
    std::unique_ptr<Platform> (*create)(const ContextOptions& options);
    const char* advice;
};
static constexpr KindRow kindTable[] = {
    {ContextKind::automatic, "auto", nullptr, ""},
    {ContextKind::window, "window", createWindowPlatform,
     "for a window: start it from a graphical session (or under xvfb-run), and install "
     "libgl1-mesa-dri or the driver of your GPU"},
    {ContextKind::egl, "egl", createEglPlatform,
     "for EGL: install libegl1 and libgl1-mesa-dri, or the driver of your GPU"},
    {ContextKind::osmesa, "osmesa", createOsmesaPlatform,
     "for OSMesa: install libosmesa6 (Mesa up to 25.0 has it)"},
    {ContextKind::given, "given", createGivenPlatform, "a context of OpenGL 3.3 or newer that is current"},
};

static const KindRow& rowOf(ContextKind kind) {
    return kindTable[static_cast<size_t>(kind)];
}

const char* name(ContextKind kind) {
    return rowOf(kind).name;
}

ContextOptions contextOptions() {
    ContextOptions out;
    out.shaders = shaderRoot();
    out.cache = cacheFolder();
    return out;
}

ContextKind contextKind(const std::string& word) {
    std::vector<std::string> names;
    for (const KindRow& row : kindTable) {
        if (row.kind == ContextKind::given) continue;  // by a function, not by a word
        if (word == row.name) return row.kind;
        names.emplace_back(row.name);
    }
    throw Error("unknown context \"" + word + "\"" + suggestion(word, names));
}

static std::unique_ptr<Context::State> open(ContextKind kind, const ContextOptions& options) {
    auto state = std::make_unique<Context::State>();
    state->platform = rowOf(kind).create(options);
    enter(*state, true);
    state->info = readInfo(kind, *state->platform);
    glGenVertexArrays(1, &state->noAttributes);
    state->shaders = options.shaders;
    state->cache = std::make_unique<ProgramCache>(state->info, options.cache);
    if (options.debug && state->info.atLeast(4, 3)) {
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);  // so that a debugger stops at the call that is wrong
        glDebugMessageCallback(&printMessage, nullptr);
    }
    return state;
}

// A process that has had a context tries none in a child: what a driver has begun does not go on in a fork.
static bool hadContext = false;

static std::string crashOf(ContextKind kind, const ContextOptions& options) {
    if (hadContext) return {};
    return crashInChild([&] { (void)open(kind, options).release(); });
}

// Error: open()'s, or the driver crashes. One that did not is remembered, and not tried again.
static std::unique_ptr<Context::State> openTried(ContextKind kind, const ContextOptions& options) {
    const TriedDriver driver(options.cache, name(kind), options.device);
    const bool isNew = !hadContext && kind != ContextKind::given && !driver.isKnown();
    const std::string crash = isNew ? crashOf(kind, options) : "";
    if (!crash.empty()) throw Error(crash);
    std::unique_ptr<Context::State> state = open(kind, options);
    if (isNew) driver.remember();
    hadContext = true;
    return state;
}

static std::vector<ContextKind> kindsToTry(const ContextOptions& options) {
    if (options.loader != nullptr) return {ContextKind::given};
    if (options.kind != ContextKind::automatic) return {options.kind};
    if (options.preferWindow) return {ContextKind::window, ContextKind::egl, ContextKind::osmesa};
    return {ContextKind::egl, ContextKind::osmesa};
}

Context::Context(const ContextOptions& options) {
    State* before = currentState;
    std::string tried, help;
    for (const ContextKind kind : kindsToTry(options)) {
        leaveCurrent();
        try {
            state_ = openTried(kind, options);
            return;
        } catch (const Error& error) {
            tried += concat("\n    ", name(kind), ": ", error.message());
            help += concat("\n    ", rowOf(kind).advice);
        }
    }
    restore(before);
    if (options.device) throw Error("EGL's device cannot be used:" + tried);
    throw Error("no OpenGL context of 3.3 or newer can be had\n  tried:" + tried + "\n  what helps:" + help);
}

void drawVertices(int count, GLenum primitive) {
    beginPass();
    glBindVertexArray(currentState->noAttributes);
    glDrawArrays(primitive, 0, count);
}

void Context::makeCurrent() {
    if (currentState != state_.get()) enter(*state_, false);
}
bool Context::isCurrent() const {
    return state_ != nullptr && currentState == state_.get();
}
void Context::leave() {
    if (isCurrent()) leaveCurrent();
}
GLFWwindow* Context::openWindow(int width, int height) const {
    GLFWwindow* window = state_->platform->openWindow(width, height);
    EXPECTS(window != nullptr && "only a window's context shares with a window");
    return window;
}

void Context::checkErrors(const char* where) {
    std::string found;
    for (int i = 0; i < 16; ++i) {  // bounded: a lost context reports errors for ever
        const GLenum code = glGetError();
        if (code == GL_NO_ERROR) break;
        const char* word = code == GL_INVALID_ENUM                    ? "GL_INVALID_ENUM"
                           : code == GL_INVALID_VALUE                 ? "GL_INVALID_VALUE"
                           : code == GL_INVALID_OPERATION             ? "GL_INVALID_OPERATION"
                           : code == GL_INVALID_FRAMEBUFFER_OPERATION ? "GL_INVALID_FRAMEBUFFER_OPERATION"
                           : code == GL_OUT_OF_MEMORY                 ? "GL_OUT_OF_MEMORY"
                                                                      : "an unknown error";
        found += concat(found.empty() ? "" : ", ", word);
    }
    if (!found.empty()) throw Error(concat("OpenGL reports ", found, " (", where, ")"));
}

void Context::checkAlive() const {
    if (!info().atLeast(4, 5) || glGetGraphicsResetStatus == nullptr) return;
    const GLenum status = glGetGraphicsResetStatus();
    if (status == GL_NO_ERROR) return;
    throw DeviceLost(concat("the device was lost: the driver reset it",
                            status == GL_GUILTY_CONTEXT_RESET     ? ", for what this program did"
                            : status == GL_INNOCENT_CONTEXT_RESET ? ", for what another program did"
                                                                  : ""));
}

static ContextOptions probeOptions(ContextKind kind, std::optional<int> device) {
    ContextOptions out;
    out.kind = kind;
    out.device = device;
    return out;
}

static ContextProbe probe(ContextKind kind, std::optional<int> device, const std::string& crash) {
    ContextProbe out;
    out.kind = kind;
    try {
        if (!crash.empty()) throw Error(crash);
        out.info = Context(probeOptions(kind, device)).info();
    } catch (const std::exception& error) {
        out.reason = error.what();
    }
    return out;
}

static int deviceCount() {
    try {
        return countEglDevices();
    } catch (const Error&) {
        return 0;  // no EGL, no devices: probeContexts() says why
    }
}

constexpr ContextKind probedKinds[] = {ContextKind::window, ContextKind::egl, ContextKind::osmesa};

// How all of them crash, the kinds first, then EGL's devices: found out before any is made here.
static const std::vector<std::string>& crashes() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> out;
        for (const ContextKind kind : probedKinds)
            out.push_back(crashOf(kind, probeOptions(kind, {})));
        for (int i = 0; i < deviceCount(); ++i)
            out.push_back(crashOf(ContextKind::egl, probeOptions(ContextKind::egl, i)));
        return out;
    }();
    return all;
}

std::vector<ContextProbe> probeContexts() {
    Context::State* before = currentState;
    std::vector<ContextProbe> out;
    for (size_t i = 0; i < std::size(probedKinds); ++i)
        out.push_back(probe(probedKinds[i], {}, crashes()[i]));
    restore(before);
    return out;
}

std::vector<ContextProbe> probeDevices() {
    Context::State* before = currentState;
    std::vector<ContextProbe> out;
    for (size_t i = std::size(probedKinds); i < crashes().size(); ++i)
        out.push_back(probe(ContextKind::egl, int(out.size()), crashes()[i]));
    restore(before);
    return out;
}

}  // namespace shoal::gpu
