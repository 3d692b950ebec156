#include "app/line/commit.h"

#include "shoal_commit.h"  // cmake/commit.cmake

namespace shoal::app {

const char* commit() {
    return SHOAL_COMMIT;
}

}  // namespace shoal::app
