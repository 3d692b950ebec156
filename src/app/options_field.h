// The options of `shoal field`.
#pragma once

#include "app/cli.h"
#include "app/options.h"

namespace shoal::app {

// `slice` and `size`: where their texts go.
void addField(CLI::App& command, Options& options, std::string& slice, std::string& size);
// Reads the slice. Error: out of range, or what excludes itself.
void checkField(Options& options, const std::string& slice);

}  // namespace shoal::app
