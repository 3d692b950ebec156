// What the command line says. Every command takes the same common options, as far as they mean something to
// it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compile/path.h"
#include "gpu/context.h"
#include "scene/scene.h"

namespace shoal::app {

constexpr int headlessFrames = 240;  // unless --frames says otherwise

struct Options {
    enum class Command { run, check, explain, info, bench };
    Command command = Command::run;
    std::vector<std::string> files;

    gpu::ContextKind context = gpu::ContextKind::automatic;
    bool headless = false;
    bool json = false;
    bool timings = false;  // time per pass
    Path path = Path::automatic;
    Lanes lanes = Lanes::automatic;
    bool inPlace = false;  // fused: one side of the state
    bool shader = false;   // explain: print the kernels
    std::optional<int> frames;
    int width = 1280, height = 720;

    // Instead of what the scene says.
    std::optional<double> dt;                         // s, of a frame
    std::optional<std::optional<SolverKind>> solver;  // inner nothing: auto
    std::optional<std::string> fieldSampling;
    std::optional<int> substeps, count;
    std::optional<uint64_t> seed;

    std::string capture;   // folder, or a video's name
    int captureEvery = 1;  // frames
    std::string exports;   // folder, or a name that ends in .csv or .ply
    std::vector<int> exportFrames;
    std::string screenshot;  // window: a picture of it after `frames`, then close

    // bench
    bool quick = false;
    std::optional<double> seconds;  // of measuring, each group of cases
    std::string only;               // cases with this in their name
    std::string plot;               // .svg or .png
};

// Error: unknown command, option or value, with a suggestion. Prints help or the version itself and returns
// nothing then.
std::optional<Options> parseOptions(int argc, char** argv);

// Puts the options' values in place of the scene's. Error: such a value is out of range.
void apply(const Options& options, Scene& scene);

}  // namespace shoal::app
