// Runs the OpenGL tests in the context that SHOAL_TEST_CONTEXT names (egl, osmesa or window).
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "gl/gl_test.h"
#include "support/run_tests.h"

using namespace shoal::gpu;

static Context* sharedContext = nullptr;  // set for as long as main() runs the tests

Context& testContext() {
    return *sharedContext;
}

shoal::Path testPath() {
    const char* word = std::getenv("SHOAL_TEST_PATH");
    return shoal::path(word != nullptr ? word : "auto");
}

int main(int argc, char** argv) {
    try {
        const char* word = std::getenv("SHOAL_TEST_CONTEXT");
        ContextOptions options;
        options.shaders = SHOAL_SOURCE_DIR "/shaders";
        if (const char* folder = std::getenv("SHOAL_CACHE")) options.cache = folder;
        options.kind = contextKind(word != nullptr ? word : "egl");
        Context context(options);
        sharedContext = &context;
        std::printf("%s: OpenGL %s on %s\n", context.info().platform.c_str(), context.info().version.c_str(),
                    context.info().renderer.c_str());
        std::fflush(stdout);
        const int failed = runTests(argc, argv);
        context.checkErrors("after all tests");
        return failed;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
