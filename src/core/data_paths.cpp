#include "core/data_paths.h"

#include <dlfcn.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/error.h"

namespace shoal {

namespace fs = std::filesystem;

// Where this code lies: the executable, or the Python module.
static fs::path ownFile() {
    Dl_info info{};
    std::error_code code;
    if (dladdr(reinterpret_cast<const void*>(&ownFile), &info) == 0 || !info.dli_fname) return {};
    return fs::canonical(info.dli_fname, code);
}

std::string shaderRoot() {
    std::error_code code;
    fs::path executable = fs::read_symlink("/proc/self/exe", code);
    if (executable.empty()) executable = ownFile();  // a root folder without /proc
    std::vector<fs::path> roots;
    if (const char* variable = std::getenv("SHOAL_DATA")) roots.emplace_back(variable);
    roots.push_back(executable.parent_path().parent_path() / SHOAL_DATA_DIR);
    roots.push_back(executable.parent_path().parent_path());  // a bundle (cmake/bundle.sh)
    roots.push_back(executable.parent_path());
    // An installed module lies in lib/python3.11/site-packages, or the like, of the prefix.
    fs::path folder = ownFile().parent_path();
    for (int level = 0; level < 5 && folder.has_relative_path(); ++level, folder = folder.parent_path())
        roots.push_back(folder / SHOAL_DATA_DIR);
    roots.emplace_back(SHOAL_SOURCE_DIR);
    std::string tried;
    for (const fs::path& root : roots) {
        if (fs::exists(root / "shaders" / "passes" / "advect.frag", code)) return (root / "shaders").string();
        tried += "\n  " + (root / "shaders").string();
    }
    throw Error("the shaders are missing; looked in" + tried +
                "\n  set SHOAL_DATA to the folder that holds them");
}

std::string moleculeFolder() {
    return (fs::path(shaderRoot()).parent_path() / "molecules").string();
}

std::string modelFolder() {
    return (fs::path(shaderRoot()).parent_path() / "models").string();
}

std::vector<std::string> shippedMolecules() {
    std::vector<std::string> names;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(moleculeFolder(), code)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".json" && isShippedName(name)) names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

bool isShippedName(const std::string& text) {
    return !text.empty() && text.find_first_of(std::string("/\\.\0", 4)) == std::string::npos;
}

std::string moleculeFile(const std::string& written, const std::string& namedIn) {
    const fs::path file = isShippedName(written) ? fs::path(moleculeFolder()) / (written + ".json")
                                                 : fs::absolute(namedIn).parent_path() / written;
    return file.lexically_normal().string();
}

}  // namespace shoal
