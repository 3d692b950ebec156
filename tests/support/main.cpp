// The main of every test program that needs no preparation of its own.
#define CATCH_CONFIG_RUNNER
#include "support/catch.h"

int main(int argumentCount, char** arguments) {
    return Catch::Session().run(argumentCount, arguments);
}
