#pragma once

#include <string>

namespace shoal::app {

// The commit of the sources that this command was built from, with "-dirty" where they differ from it;
// "unknown" without git.
const char* commit();

std::string today();  // "2026-02-28", UTC

}  // namespace shoal::app
