#include "app/data_paths.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include "core/cache_folder.h"
#include "core/error.h"
#include "core/sandbox.h"

namespace shoal::app {

namespace fs = std::filesystem;

std::string shaderRoot() {
    std::error_code code;
    const fs::path executable = fs::read_symlink("/proc/self/exe", code);
    std::vector<fs::path> roots;
    if (const char* variable = std::getenv("SHOAL_DATA")) roots.emplace_back(variable);
    roots.push_back(executable.parent_path().parent_path() / SHOAL_DATA_DIR);
    roots.push_back(executable.parent_path().parent_path());  // a bundle (cmake/bundle.sh)
    roots.push_back(executable.parent_path());
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

void keepToSandbox(const Options& options, const std::string& file) {
    if (!options.sandbox) return;
    fs::path own = file;
    std::error_code code;
    if (!fs::is_directory(own, code)) own = own.parent_path();
    std::vector<fs::path> folders = {own.empty() ? fs::path(".") : own, shaderRoot(), moleculeFolder(),
                                     modelFolder(), cacheFolder()};
    for (const std::string& given : {options.resume, options.exports, options.plot})
        folders.emplace_back(given);
    if (!options.molecule.output.empty())
        folders.push_back(fs::absolute(options.molecule.output).parent_path());
    openOnlyWithin(folders);
}

}  // namespace shoal::app
