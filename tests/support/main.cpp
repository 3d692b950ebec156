// The main of every test program that needs no preparation of its own.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 in std::regex, with sanitizers
#define CATCH_CONFIG_RUNNER
#include "support/catch.h"

int main(int argumentCount, char** arguments) {
    return Catch::Session().run(argumentCount, arguments);
}
