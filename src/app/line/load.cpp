// Loads the commands' scenes, and restricts what they may open (--sandbox).
#include <filesystem>

#include "app/line/commands.h"
#include "core/cache_folder.h"
#include "core/data_paths.h"
#include "core/file.h"

namespace shoal::app {

namespace fs = std::filesystem;

void keepToSandbox(const Options& options, const std::string& file) {
    if (!options.sandbox) return;
    fs::path own = file;
    std::error_code code;
    if (!fs::is_directory(own, code)) own = own.parent_path();
    std::vector<fs::path> folders = {own.empty() ? fs::path(".") : own, shaderRoot(), moleculeFolder(),
                                     modelFolder(), cacheFolder()};
    for (const std::string& given : {options.resume, options.exports})
        folders.emplace_back(given);
    if (!options.molecule.output.empty())
        folders.push_back(fs::absolute(options.molecule.output).parent_path());
    openOnlyWithin(folders);
}

gpu::ContextOptions hiddenContext(const Options& options) {
    gpu::ContextOptions out = gpu::contextOptions();
    out.kind = options.gpu ? gpu::ContextKind::egl : options.context;
    out.device = options.gpu;
    return out;
}

Loaded load(const Options& options) {
    const std::string& file = options.files.front();
    if (options.error) return {readScene(file, options), {}};
    return loadScene(file, options);
}

}  // namespace shoal::app
