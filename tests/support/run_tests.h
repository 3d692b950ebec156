#pragma once

// Runs the tests of this program as Catch2's command line says; returns the exit code.
int runTests(int argumentCount, char** arguments);
