#include "core/cache_folder.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace shoal {

namespace fs = std::filesystem;

static std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr ? value : "";
}

std::string cacheFolder() {
    if (std::getenv("SHOAL_CACHE") != nullptr) return environment("SHOAL_CACHE");
    const fs::path cache = environment("XDG_CACHE_HOME"), home = environment("HOME");
    if (cache.is_absolute()) return (cache / "shoal").string();  // its specification: ignore relative ones
    if (!home.empty()) return (home / ".cache" / "shoal").string();
    return {};
}

uint64_t fnv(std::string_view bytes, uint64_t hash) {
    for (const char c : bytes)
        hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
    return hash;
}

std::string contentKey(std::string_view bytes) {
    uint64_t backwards = fnvStart;
    for (auto c = bytes.rbegin(); c != bytes.rend(); ++c)
        backwards = (backwards ^ static_cast<unsigned char>(*c)) * 1099511628211ull;
    char digits[33];
    std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(fnv(bytes)),
                  static_cast<unsigned long long>(backwards));
    return digits;
}

}  // namespace shoal
