#pragma once

namespace shoal::app {

// The commit of the sources that this command was built from, with "-dirty" where they differ from it;
// "unknown" without git.
const char* commit();

}  // namespace shoal::app
