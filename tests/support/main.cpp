// The main of every test program that needs no preparation of its own.
#include "support/run_tests.h"

int main(int argumentCount, char** arguments) {
    return runTests(argumentCount, arguments);
}
