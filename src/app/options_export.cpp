#include <algorithm>
#include <cmath>

#include "app/cli.h"
#include "app/commands.h"
#include "app/options.h"
#include "core/error.h"
#include "core/file.h"

namespace shoal::app {

static const std::vector<std::string> texelWords = {"png", "half", "float"};

void addExport(CLI::App& command, Options& options, Texts& texts) {
    ExportOptions& animation = options.animation;
    addScene(command, options);
    section(command, "What is written");
    command.add_option("--vat", animation.vat, "Vertex animation textures of a group, in OpenVAT's layout")
        ->type_name("FOLDER");
    addFile(command, "--glb", animation.glb, "All that is drawn at one moment, as glTF (.glb)");
    command
        .add_option("--usd", animation.usd,
                    "The run as USD: a .usda file, or a folder of one file a frame (value clips)")
        ->type_name("TARGET");
    command.add_option("--group", animation.group, "Which group (default: the only one)");
    addWhole(command, "--first", animation.first, "Frames to run before the first that is written")
        ->capture_default_str();
    addWhole(command, "--frames", animation.frames, "Frames of the animation")->capture_default_str();
    addWhole(command, "--molecules", animation.molecules, "Only so many, the first ones");
    addWhole(command, "--loop", animation.loop,
             "So many frames at the end blend into what came before the first")
        ->capture_default_str();
    command.add_option("--texels", animation.texels, "16-bit PNG, or OpenEXR")
        ->type_name(joined(texelWords, "|"))
        ->capture_default_str();
    command.add_flag("--rigid", animation.rigid,
                     "A rotation and a place for each molecule instead of its vertices");
    command
        .add_option("--rigid-within", animation.rigidWithin,
                    "--rigid for groups whose vertices then lie at most so far off, m; others are meshes")
        ->type_name("FLOAT");
    excludes(command, "--vat", {"--glb", "--usd"});
    excludes(command, "--glb", {"--usd", "--frames", "--rigid"});
    needs(command, "--rigid-within", "--usd");
    excludes(command, "--rigid-within", {"--rigid"});
    for (const char* option : {"--group", "--molecules", "--loop", "--texels"})
        needs(command, option, "--vat");
    addOverrides(command, options, texts);
    addPath(command, options, texts);
    addContext(command, options, texts);
}

void finishExport(Options& options) {
    if (options.command != exportCommand) return;
    ExportOptions& animation = options.animation;
    if (animation.vat.empty() && animation.glb.empty() && animation.usd.empty())
        throw Error("export: say what to write: --vat FOLDER, --glb FILE or --usd TARGET");
    if (!animation.glb.empty() && lowerExtension(animation.glb) != ".glb")
        throw Error(concat("--glb: expected a name ending in .glb, found \"", animation.glb, "\""));
    const auto found = std::find(texelWords.begin(), texelWords.end(), animation.texels);
    if (found == texelWords.end())
        throw Error(concat("--texels: unknown word \"", animation.texels, "\"",
                           suggestion(animation.texels, texelWords)));
    animation.format = exchange::TexelFormat(found - texelWords.begin());
    const std::string kind = lowerExtension(animation.usd);
    if (!kind.empty() && kind != ".usda")
        throw Error(
            concat("--usd: expected a folder, or a name ending in .usda, found \"", animation.usd, "\""));
    const int mostFrames = animation.vat.empty() ? 1000000 : int(exchange::AnimationTexture::mostRows) / 2;
    const auto within = [](const char* option, int value, int least, int most) {
        if (value < least || value > most)
            throw Error(concat(option, ": expected ", least, " to ", most, ", found ", value));
    };
    within("--first", animation.first, 0, 1000000);
    within("--frames", animation.frames, 1, mostFrames);
    within("--loop", animation.loop, 0, animation.frames - 1);
    if (const auto& bound = animation.rigidWithin; bound && !(*bound >= 0 && std::isfinite(*bound)))
        throw Error(concat("--rigid-within: expected metres, 0 or more, found ", *bound));
    if (animation.molecules) within("--molecules", *animation.molecules, 1, maxGroupCount);
}

}  // namespace shoal::app
