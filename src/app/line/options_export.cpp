#include <algorithm>
#include <cmath>

#include "app/line/cli.h"
#include "app/line/commands.h"
#include "app/line/options.h"
#include "core/error.h"
#include "core/file.h"

namespace shoal::app {

constexpr int mostFrames = 1000000;

void addExport(CLI::App& command, Options& options) {
    ExportOptions& animation = options.animation;
    addScene(command, options);
    section(command, "What is written");
    command.add_option("--vat", animation.vat, "Vertex animation textures of a group, in OpenVAT's layout")
        ->type_name("FOLDER");
    addFile(command, "--glb", animation.glb, "All that is drawn at one moment, as glTF (.glb)")
        ->check(endsIn({".glb"}));
    command
        .add_option("--usd", animation.usd,
                    "The run as USD: a .usda file, or a folder of one file a frame (value clips)")
        ->check(endsIn({".usda"}, true))
        ->type_name("TARGET");
    command.add_option("--group", animation.group, "Which group (default: the only one)");
    addWhole(command, "--first", animation.first, "Frames to run before the first that is written", 0,
             mostFrames)
        ->capture_default_str();
    addWhole(command, "--frames", animation.frames, "Frames of the animation", 1, mostFrames)
        ->capture_default_str();
    addWhole(command, "--molecules", animation.molecules, "Only so many, the first ones", 1, maxGroupCount);
    addWhole(command, "--loop", animation.loop,
             "So many frames at the end blend into what came before the first", 0)
        ->capture_default_str();
    addWord(command, "--texels", animation.format, "16-bit PNG, or OpenEXR", {"png", "half", "float"});
    command.add_flag("--rigid", animation.rigid,
                     "A rotation and a place for each molecule instead of its vertices");
    addNumber(command, "--rigid-within", animation.rigidWithin,
              "--rigid for groups whose vertices then lie at most so far off, m; others are meshes",
              "a length of at least 0 m", [](double m) { return m >= 0 && std::isfinite(m); });
    excludes(command, "--vat", {"--glb", "--usd"});
    excludes(command, "--glb", {"--usd", "--frames", "--rigid"});
    needs(command, "--rigid-within", "--usd");
    excludes(command, "--rigid-within", {"--rigid"});
    for (const char* option : {"--group", "--molecules", "--loop", "--texels"})
        needs(command, option, "--vat");
    addOverrides(command, options);
    addPath(command, options);
    addContext(command, options);
}

void finishExport(const Options& options) {
    if (options.command != exportCommand) return;
    const ExportOptions& animation = options.animation;
    if (animation.vat.empty() && animation.glb.empty() && animation.usd.empty())
        throw Error("export: say what to write: --vat FOLDER, --glb FILE or --usd TARGET");
    constexpr int mostOfTextures = int(exchange::AnimationTexture::mostRows) / 2;
    if (!animation.vat.empty() && animation.frames > mostOfTextures)
        throw Error(concat("--frames: textures hold at most ", mostOfTextures, ", found ", animation.frames));
    if (animation.loop >= animation.frames)
        throw Error(
            concat("--loop: expected fewer than the ", animation.frames, " frames, found ", animation.loop));
}

}  // namespace shoal::app
