#include "app/line/commit.h"

#include <ctime>

#include "shoal_commit.h"  // cmake/commit.cmake

namespace shoal::app {

const char* commit() {
    return SHOAL_COMMIT;
}

std::string today() {
    const std::time_t time = std::time(nullptr);
    char text[16] = {};
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&time));
    return text;
}

}  // namespace shoal::app
