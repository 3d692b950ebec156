// The options of `shoal measure` and `shoal bench`, and what they share with the others.
#pragma once

#include "app/cli.h"
#include "app/options.h"

namespace shoal::app {

// Options whose words are read when all are there.
struct Texts {
    std::string context = "auto", size = "1280x720", path = "auto", lanes = "auto", solver, slice,
                exportCells = "surface";
    std::vector<std::string> solvers, samplings;
};

// Titles in a command's help, of what is declared from here on.
inline const char* const ofScene = "In place of what the scene says";
inline const char* const execution = "How it runs";
inline const char* const reports = "What is reported";
inline void section(CLI::App& command, const char* title) {
    command.option_defaults()->group(title);
}

inline CLI::Validator wholeNumber() {
    return kindOf(isAll<int>, "a whole number");
}

void addPath(CLI::App& command, Options& options, Texts& texts);
void addContext(CLI::App& command, Options& options, Texts& texts);
void addCountAndSeed(CLI::App& command, Options& options);
void addMeasure(CLI::App& command, Options& options, Texts& texts);
void addBench(CLI::App& command, Options& options, Texts& texts);

// Error: unknown; `option` is what it was given to. Nothing: auto.
std::optional<SolverKind> solverNamed(const char* option, const std::string& word);

// Reads and checks the options of `measure` and `bench`. Error: unknown words, or out of range.
void finishMeasure(const Texts& texts, Options& options);

}  // namespace shoal::app
