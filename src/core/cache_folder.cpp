#include "core/cache_folder.h"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/file.h"

namespace shoal {

namespace fs = std::filesystem;

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
    return formatted("%016llx%016llx", static_cast<unsigned long long>(fnv(bytes)),
                     static_cast<unsigned long long>(backwards));
}

void touchFile(const fs::path& file) {
    std::error_code code;
    fs::last_write_time(file, fs::file_time_type::clock::now(), code);
}

void keepNewest(const fs::path& folder, const char* extension, size_t kept) {
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    std::error_code code;
    for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
        std::error_code gone;
        const fs::file_time_type time = entry->last_write_time(gone);
        if (!gone && entry->path().extension() == extension) files.emplace_back(time, entry->path());
    }
    if (files.size() <= kept) return;
    std::sort(files.begin(), files.end());
    for (size_t i = 0; i < files.size() - kept; ++i)
        fs::remove(files[i].second, code);
}

}  // namespace shoal
