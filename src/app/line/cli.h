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

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/line/options.h"
#include "core/error.h"

namespace shoal::app {

// Whether all of the text is a T: no sign that an unsigned number would swallow, nothing behind it.
template <typename T>
bool isAll(const std::string& text, T& value) {
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    return code == std::errc() && end == text.data() + text.size();
}

// Accepts values that are a T and meet the test; of others it says "expected `what`, found …".
template <typename T>
CLI::Validator isA(const std::string& what, const std::function<bool(T)>& test) {
    return CLI::Validator(
        [what, test](const std::string& text) {
            T value{};
            if (isAll(text, value) && test(value)) return std::string();
            return concat("expected ", what, ", found \"", text, "\"");
        },
        "");
}

// Accepts one of the words.
CLI::Validator oneOf(const std::vector<std::string>& words);

// Accepts names of files with one of the endings and, where a folder will do, names without any.
CLI::Validator endsIn(const std::vector<std::string>& endings, bool orFolder = false);

// `option` means something only beside `other`.
inline void needs(CLI::App& command, const char* option, const char* other) {
    command.get_option(option)->needs(command.get_option(other));
}

// `option` stands beside none of the others.
inline void excludes(CLI::App& command, const char* option, std::initializer_list<const char*> others) {
    for (const char* other : others)
        command.get_option(option)->excludes(command.get_option(other));
}

// Titles in a command's help, of what is declared from here on.
inline const char* const ofScene = "In place of what the scene says";
inline const char* const execution = "How it runs";
inline const char* const reports = "What is reported";
inline void section(CLI::App& command, const char* title) {
    command.option_defaults()->group(title);
}

// Adds an option whose value is a whole number from `least` to `most`.
template <typename T>
CLI::Option* addWhole(CLI::App& command, const char* name, T& value, const std::string& what,
                      int least = std::numeric_limits<int>::min(),
                      int most = std::numeric_limits<int>::max()) {
    const std::string range = most < std::numeric_limits<int>::max() ? concat(" from ", least, " to ", most)
                              : least > std::numeric_limits<int>::min() ? concat(", ", least, " or more")
                                                                        : "";
    return command.add_option(name, value, what)->check(isA<int>("a whole number" + range, [=](int n) {
        return n >= least && n <= most;
    }));
}
// Adds one whose value is a number; `kind` says which, such as "a time in seconds".
template <typename T>
CLI::Option* addNumber(
    CLI::App& command, const char* name, T& value, const std::string& what, const std::string& kind,
    bool (*test)(double) = [](double) { return true; }) {
    return command.add_option(name, value, what)->check(isA<double>(kind, test));
}
// Adds one whose value is the name of a file.
template <typename T>
CLI::Option* addFile(CLI::App& command, const char* name, T& value, const std::string& what) {
    return command.add_option(name, value, what)->type_name("FILE");
}
// Calls read(text), and tells its Error as one of the option.
template <typename Read>
auto namingErrors(const char* name, Read read) {
    return [name, read](const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            throw CLI::ValidationError(name, error.message());
        }
    };
}
// Adds one whose value read(text) takes.
template <typename Read>
CLI::Option* addRead(CLI::App& command, const char* name, const std::string& what, Read read) {
    return command.add_option_function<std::string>(name, namingErrors(name, read), what);
}
// Adds one that may be repeated, whose values read(text) takes one after another.
template <typename Read>
CLI::Option* addReads(CLI::App& command, const char* name, const std::string& what, Read read) {
    const auto each = [readEach = namingErrors(name, read)](const std::vector<std::string>& texts) {
        std::for_each(texts.begin(), texts.end(), readEach);
    };
    return command.add_option_function<std::vector<std::string>>(name, each, what);
}
// Adds one whose value is one of the words, which stand in the order of the enumeration T.
template <typename T>
CLI::Option* addWord(CLI::App& command, const char* name, T& value, const std::string& what,
                     const std::vector<std::string>& words) {
    const auto read = [&value, words](const std::string& word) {
        value = T(std::find(words.begin(), words.end(), word) - words.begin());
    };
    return addRead(command, name, what, read)
        ->check(oneOf(words))
        ->type_name(joined(words, "|"))
        ->default_str(words[size_t(value)]);
}

void addScene(CLI::App& command, Options& options);
void addOverrides(CLI::App& command, Options& options);
void addError(CLI::App& command, Options& options, const std::string& what);
void addPath(CLI::App& command, Options& options);
void addContext(CLI::App& command, Options& options);
void addCountAndSeed(CLI::App& command, Options& options);
CLI::Option* addSize(CLI::App& command, Options& options, const std::string& what);
void addMeasure(CLI::App& command, Options& options);
void addExport(CLI::App& command, Options& options);
void addBench(CLI::App& command, Options& options);
void addField(CLI::App& command, Options& options);

// These look at options together once all are read. Error: they do not go together.
void finishExport(const Options& options);
void finishMeasure(Options& options);

// Adds `molecule` with its commands. A further one is a function in options_molecule.cpp that adds its
// options, and a function of commands.h.
void addMolecule(CLI::App& app, Options& options);

// Finds which command of `molecule` it is, if any. Error: its options do not go together.
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
