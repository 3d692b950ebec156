// Catch2's own code, which is slow to compile: once for all test programs.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 in std::regex, with sanitizers
#endif
#define CATCH_CONFIG_RUNNER
#include "support/run_tests.h"

#include "support/catch.h"

int runTests(int argumentCount, char** arguments) {
    return Catch::Session().run(argumentCount, arguments);
}
