#include "core/file.h"

#include <algorithm>

namespace shoal {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path>& folders() {
    static std::vector<fs::path> within;
    return within;
}

// Without links, as far as it exists. Empty where that cannot be found out.
fs::path real(const fs::path& path) {
    std::error_code code;
    const fs::path whole = fs::absolute(path, code);
    fs::path out = code ? fs::path() : fs::weakly_canonical(whole, code);
    if (code) return {};
    return out.has_filename() ? out : out.parent_path();  // "folder/" as "folder"
}

bool lies(const fs::path& path, const fs::path& within) {
    return std::mismatch(within.begin(), within.end(), path.begin(), path.end()).first == within.end();
}

}  // namespace

void openOnlyWithin(const std::vector<fs::path>& given) {
    folders().clear();
    for (const fs::path& folder : given)
        if (!folder.empty()) folders().push_back(real(folder));
}

bool mayOpen(const fs::path& path) {
    if (folders().empty()) return true;
    const fs::path file = real(path);
    return !file.empty() && std::any_of(folders().begin(), folders().end(), [&](const fs::path& folder) {
        return !folder.empty() && lies(file, folder);
    });
}

void refuseOutside(const fs::path& path) {
    if (!mayOpen(path)) throw Error(Location{path.string()}, outsideSandbox);
}

}  // namespace shoal
