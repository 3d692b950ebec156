#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "core/error.h"
#include "gl/gl_test.h"
#include "gpu/context.h"
#include "gpu/gl.h"
#include "gpu/texture.h"
#include "support/catch.h"

using namespace shoal::gpu;

// An environment variable for the length of a block.
class Environment {
  public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* old = std::getenv(name)) {
            old_ = old;
            had_ = true;
        }
        if (value != nullptr) {
            setenv(name, value, 1);
        } else {
            unsetenv(name);
        }
    }
    ~Environment() {
        if (had_) {
            setenv(name_, old_.c_str(), 1);
        } else {
            unsetenv(name_);
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

  private:
    const char* name_;
    std::string old_;
    bool had_ = false;
};

static std::string failure(const ContextOptions& options) {
    try {
        Context context(options);
        return "";
    } catch (const shoal::Error& error) {
        return error.what();
    }
}

// Draws with functions of OpenGL 1.1 (forwarded) and of later versions (GLEW), and looks at the result.
static bool clearsAndReadsBack(Context& context) {
    Texture texture(context, Format::rgba8, 4, 4, "cleared");
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    glViewport(0, 0, 4, 4);
    glClearColor(1.0f, 0.0f, 0.2f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    unsigned char pixel[4] = {};
    glReadPixels(3, 3, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    context.checkErrors("clearing");
    return pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 51 && pixel[3] == 255;
}

TEST_CASE("a context says what it is and what it can do", "[context]") {
    const ContextInfo& info = testContext().info();
    CHECK(info.atLeast(3, 3));
    CHECK(info.kind != ContextKind::automatic);
    CHECK_FALSE(info.renderer.empty());
    CHECK_FALSE(info.glslVersion.empty());
    // The least that OpenGL 3.3 promises.
    CHECK(info.maxTextureSize >= 1024);
    CHECK(info.maxColorAttachments >= 8);
    CHECK(info.maxVertexTextureUnits >= 16);
    CHECK(info.max3DTextureSize >= 256);
    CHECK(info.maxBufferTexels >= 65536);
    CHECK(info.computeShaders == info.atLeast(4, 3));
    CHECK((info.maxStorageBlockBytes > 0) == info.atLeast(4, 3));
}

TEST_CASE("a version that was asked of Mesa is the version that comes", "[context]") {
    const char* wanted = std::getenv("MESA_GL_VERSION_OVERRIDE");
    if (wanted == nullptr) return;
    const ContextInfo& info = testContext().info();
    CHECK(shoal::concat(info.major, ".", info.minor) == std::string(wanted).substr(0, 3));
}

TEST_CASE("drawing arrives in the current context", "[context]") {
    testContext().makeCurrent();
    CHECK(clearsAndReadsBack(testContext()));
}

TEST_CASE("contexts of several kinds take turns in one process", "[context]") {
    int there = 0;
    for (int round = 0; round < 2; ++round) {
        for (const ContextKind kind : {ContextKind::egl, ContextKind::osmesa}) {
            ContextOptions options;
            options.kind = kind;
            std::optional<Context> made;
            try {
                made.emplace(options);
            } catch (const shoal::Error& error) {
                testContext().makeCurrent();
                WARN("left out: " << error.what());
                continue;
            }
            Context& other = *made;
            ++there;
            INFO(name(kind));
            CHECK(other.isCurrent());
            CHECK_FALSE(testContext().isCurrent());
            CHECK(clearsAndReadsBack(other));
            testContext().makeCurrent();
            CHECK(clearsAndReadsBack(testContext()));
            other.makeCurrent();
            CHECK(clearsAndReadsBack(other));
        }
        testContext().makeCurrent();
        CHECK(clearsAndReadsBack(testContext()));
    }
    CHECK(there >= 2);  // one kind, twice
}

TEST_CASE("a context can be moved while textures borrow it", "[context]") {
    {
        ContextOptions options;
        options.kind = testContext().info().kind;
        Context first(options);
        Texture texture(first, Format::r32f, 2, 1, "borrower");
        Context second(std::move(first));
        CHECK(second.isCurrent());
        const float values[] = {1, 2};
        texture.upload(Traffic::Kind::state, 0, 0, 2, 1, values, sizeof values);
        CHECK(second.traffic().up(Traffic::Kind::state) == sizeof values);
    }
    testContext().makeCurrent();
}

TEST_CASE("probing leaves the current context alone", "[context]") {
    const std::vector<ContextProbe> probes = probeContexts();
    REQUIRE(probes.size() == 3);
    for (const ContextProbe& probe : probes) {
        INFO(name(probe.kind));
        CHECK(probe.info.has_value() == probe.reason.empty());
        if (probe.info) CHECK(probe.info->kind == probe.kind);
        if (probe.kind == testContext().info().kind) CHECK(probe.info.has_value());
    }
    CHECK(testContext().isCurrent());
    CHECK(clearsAndReadsBack(testContext()));
}

TEST_CASE("without a display a window says so and automatic goes headless", "[context]") {
    const Environment x("DISPLAY", nullptr), wayland("WAYLAND_DISPLAY", nullptr);
    ContextOptions options;
    options.kind = ContextKind::window;
    const std::string message = failure(options);
    CHECK(message.find("DISPLAY") != std::string::npos);
    CHECK(message.find("xvfb-run") != std::string::npos);
    CHECK(testContext().isCurrent());

    options.kind = ContextKind::automatic;
    options.preferWindow = true;
    {
        const Context headless(options);
        CHECK(headless.info().kind != ContextKind::window);
    }
    testContext().makeCurrent();
}

// In a process of its own: Mesa reads its overrides once. This program starts again, and ends in main().
TEST_CASE("a context that is too old is refused by its version", "[context]") {
    if (!testContext().info().software) return;
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = std::string("MESA_GL_VERSION_OVERRIDE=2.1 MESA_GLSL_VERSION_OVERRIDE=120 ") +
                                "SHOAL_TEST_CONTEXT=" + name(testContext().info().kind) + " '" + program +
                                "' 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string output;
    char part[256];
    while (std::fgets(part, sizeof part, pipe) != nullptr)
        output += part;
    CHECK(pclose(pipe) != 0);
    INFO(output);
    CHECK(output.find("found OpenGL 2.1") != std::string::npos);
    CHECK(output.find("3.3 or newer is needed") != std::string::npos);
}

TEST_CASE("the kind of a context is read from a word", "[context]") {
    CHECK(contextKind("auto") == ContextKind::automatic);
    CHECK(contextKind("osmesa") == ContextKind::osmesa);
    try {
        contextKind("osmessa");
        FAIL("accepted a misspelling");
    } catch (const shoal::Error& error) {
        CHECK(std::string(error.what()).find("did you mean \"osmesa\"?") != std::string::npos);
    }
}

TEST_CASE("mistakes of ours come out with the place that looked", "[context]") {
    glEnable(0xFFFF);
    try {
        testContext().checkErrors("the test's mistake");
        FAIL("not noticed");
    } catch (const shoal::Error& error) {
        CHECK(std::string(error.what()).find("GL_INVALID_ENUM (the test's mistake)") != std::string::npos);
    }
    CHECK_NOTHROW(testContext().checkErrors("afterwards"));
}
