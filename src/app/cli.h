// How the command line is declared and read: CLI11, and what the sources of the options share.
#pragma once

// The warnings of CLI11 are not ours.
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#endif
#include <CLI/CLI.hpp>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#include <charconv>
#include <memory>
#include <string>

#include "app/options.h"
#include "core/error.h"

namespace shoal::app {

// Whether all of the text is a T: no sign that an unsigned number would swallow, nothing behind it.
template <typename T>
bool isAll(const std::string& text) {
    T value;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size();
}

inline CLI::Validator kindOf(bool (*test)(const std::string&), const std::string& what) {
    return CLI::Validator(
        [test, what](const std::string& text) {
            return test(text) ? std::string() : concat("expected ", what, ", found \"", text, "\"");
        },
        "");
}

// `option` means something only beside `other`.
inline void needs(CLI::App& command, const char* option, const char* other) {
    command.get_option(option)->needs(command.get_option(other));
}

// `option` stands beside none of the others.
inline void excludes(CLI::App& command, const char* option, std::initializer_list<const char*> others) {
    for (const char* other : others)
        command.get_option(option)->excludes(command.get_option(other));
}

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

// Options whose value is a whole number, any number (`kind`, such as "a time in seconds"), or a file.
template <typename T>
CLI::Option* addWhole(CLI::App& command, const char* name, T& value, const std::string& what) {
    return command.add_option(name, value, what)->check(kindOf(isAll<int>, "a whole number"));
}
template <typename T>
CLI::Option* addNumber(CLI::App& command, const char* name, T& value, const std::string& what,
                       const char* kind) {
    return command.add_option(name, value, what)->check(kindOf(isAll<double>, kind));
}
template <typename T>
CLI::Option* addFile(CLI::App& command, const char* name, T& value, const std::string& what) {
    return command.add_option(name, value, what)->type_name("FILE");
}

void addScene(CLI::App& command, Options& options);
void addOverrides(CLI::App& command, Options& options, Texts& texts);
void addPath(CLI::App& command, Options& options, Texts& texts);
void addContext(CLI::App& command, Options& options, Texts& texts);
void addCountAndSeed(CLI::App& command, Options& options);
void addMeasure(CLI::App& command, Options& options, Texts& texts);
void addExport(CLI::App& command, Options& options, Texts& texts);
void finishExport(Options& options);
void addBench(CLI::App& command, Options& options, Texts& texts);

// Error: unknown; `option` is what it was given to. Nothing: auto.
std::optional<SolverKind> solverNamed(const char* option, const std::string& word);

// Reads and checks the options of `measure` and `bench`. Error: unknown words, or out of range.
void finishMeasure(const Texts& texts, Options& options);

// `slice` and `size`: where their texts go.
void addField(CLI::App& command, Options& options, std::string& slice, std::string& size);
// Reads the slice. Error: out of range, or what excludes itself.
void checkField(Options& options, const std::string& slice);

// Adds `molecule` with its commands. A further one is a function in options_molecule.cpp that adds its
// options, and a function of commands.h.
void addMolecule(CLI::App& app, Options& options);

// Once the command line is parsed: which command of `molecule` it is, if any, and its values. Error: out of
// range, or not what is expected.
void finishMolecule(const CLI::App& app, Options& options);

// ---- Documents
// The command's documentation, made from the declarations of its options: --help, and the files that are
// installed with it.

// Formats --help: an option's type follows its name, its default follows its description.
std::shared_ptr<CLI::FormatterBase> helpFormat();

// In the language of man (section 1).
std::string manPage(const CLI::App& app);

// In Markdown: a section a command with a table of its options (docs/command.md).
std::string markdown(const CLI::App& app);

// For bash: commands, options, the words that an option takes, scenes by their names, and files.
std::string bashCompletion(const CLI::App& app);

}  // namespace shoal::app
