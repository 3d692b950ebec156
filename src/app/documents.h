// What is told of the command, by --help and beside it where it is installed: made from the declarations of
// its options.
#pragma once

#include <memory>
#include <string>

#include "app/cli.h"

namespace shoal::app {

// Of --help: an option's type behind its name, its default behind what it does.
std::shared_ptr<CLI::FormatterBase> helpFormat();

// In the language of man (section 1).
std::string manPage(const CLI::App& app);

// In Markdown: a section a command with a table of its options (docs/command.md).
std::string markdown(const CLI::App& app);

// For bash: commands, options, the words that an option takes, scenes by their names, and files.
std::string bashCompletion(const CLI::App& app);

}  // namespace shoal::app
