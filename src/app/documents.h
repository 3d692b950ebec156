// The command's documentation, made from the declarations of its options: --help, and the files that are
// installed with it.
#pragma once

#include <memory>
#include <string>

#include "app/cli.h"

namespace shoal::app {

// Formats --help: an option's type follows its name, its default follows its description.
std::shared_ptr<CLI::FormatterBase> helpFormat();

// In the language of man (section 1).
std::string manPage(const CLI::App& app);

// In Markdown: a section a command with a table of its options (docs/command.md).
std::string markdown(const CLI::App& app);

// For bash: commands, options, the words that an option takes, scenes by their names, and files.
std::string bashCompletion(const CLI::App& app);

}  // namespace shoal::app
