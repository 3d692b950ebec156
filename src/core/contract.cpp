#include "core/contract.h"

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace shoal {

void contractBroken(const char* file, int line, const char* condition) {
    const std::string_view whole(file);
    const size_t source = whole.rfind("src/");  // the folder of the tree says nothing to a reader
    const std::string_view shown = source == std::string_view::npos ? whole : whole.substr(source);
    std::fprintf(stderr, "%.*s:%d: broken contract: %s\n", int(shown.size()), shown.data(), line, condition);
    std::fflush(stderr);
    std::abort();
}

}  // namespace shoal
