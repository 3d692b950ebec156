// The options of the command line. Every command takes the same common options, as far as they mean
// something to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "author/from_mesh.h"
#include "exchange/animation_texture.h"
#include "gpu/context.h"
#include "measure/reading.h"
#include "run/request.h"

namespace shoal::app {

// Selects the parts of a state's molecules that become cells of a .vtp file.
enum class ExportCells {
    surface,   // triangles, and vertices of groups that have none
    springs,   // springs, and vertices of groups that have none
    vertices,  // vertices alone
};

constexpr int headlessFrames = 240;  // unless --frames says otherwise

// The options of `shoal molecule COMMAND`.
struct MoleculeOptions {
    // from-mesh and new
    FromMesh fromMesh;
    std::string output;  // empty: nothing is written
    bool force = false;  // write over a file that is there
    std::string report;  // .html; empty: none
    std::string texture;
    std::string color;
    // new
    std::string shape = "sheet";
    std::optional<int> divisions;
};

// The options of `shoal export` (app/export/export_scene.cpp).
struct ExportOptions {
    std::string vat;               // folder
    std::string glb;               // file
    std::string usd;               // .usda file, or a folder
    std::string group;             // empty: the only one
    int first = 0;                 // frames that are not exported
    int frames = 120;              // that are
    std::optional<int> molecules;  // at most; nothing: all
    int loop = 0;                  // frames that blend into the first
    exchange::TexelFormat format = exchange::TexelFormat::png16;
    bool rigid = false;
    std::optional<double> rigidWithin;  // m: of --usd, groups that are further off are meshes
};

struct Options : RunRequest {
    int (*command)(const Options& options) = nullptr;  // app/line/commands.h
    std::vector<std::string> files;
    std::string editShape;    // what a new molecule begins as in the editor; empty: a sheet
    bool editsScene = false;  // edit, of a scene

    gpu::ContextKind context = gpu::ContextKind::automatic;
    std::optional<int> gpu;  // a device of EGL
    bool headless = false;
    bool sandbox = false;  // nothing is opened outside the folder of the file and the shipped data
    bool json = false;
    bool timings = false;  // time per pass
    bool shader = false;   // explain: print the kernels
    bool cost = false;     // explain: what they cost on this device
    bool passes = false;   // explain: what a frame asks of it
    std::optional<int> frames;
    int width = 1280, height = 720;
    std::optional<double> scale;  // of the window's panels; nothing: as its screen asks for

    std::string capture;       // folder, or a video's name
    bool transparent = false;  // no sky behind: straight alpha
    int captureEvery = 1;      // frames
    std::string exports;       // folder, or a name that ends in .csv, .ply, .vtp or .pvd
    std::vector<int> exportFrames;
    std::optional<int> exportEvery;  // frames
    ExportCells exportCells = ExportCells::surface;
    bool unwatched = false;  // no watchdog
    std::vector<measure::Requirement> requirements;
    std::string screenshot;  // window: a picture of it after `frames`, then close

    // bench
    std::string benchOf;  // "sort", "collide", "particles", "school", or empty: the simulation's frames
    bool quick = false;
    std::optional<double> seconds;  // of measuring, each group of cases
    std::string only;               // cases with this in their name

    // run, explain, measure: the largest relative error that is wanted; chooses the method
    std::optional<double> error;
    double errorSeconds = 60;  // run, explain: that finding it may take
    // measure (`seconds` as above)
    bool all = false;                      // every point of measure as text, not only the best
    std::vector<SolverKind> solvers;       // empty: all
    std::vector<FieldSampling> samplings;  // empty: all that differ
    double duration = 1;                   // s of simulated time
    std::optional<int> molecules;          // of each group, whose error is measured
    bool statistics = false;               // of runs by many seeds, in place of errors
    int seeds = 32;                        // of these
    bool contactCurve = false;             // of contact between molecules, in place of errors
    std::vector<int> eachSubsteps;         // of both; empty: the scene's, with --contact those around it
    std::vector<int> eachIterations;       // of contact; empty likewise
    std::string csv;                       // a file
    std::string report;                    // bench: a file

    // field (`only`, `capture`, `width` and `height` as above)
    struct Field {
        std::optional<int> resolution;
        std::optional<double> error, shell, thickness;  // m
        std::optional<int> sliceAxis;                   // 0 x, 1 y, 2 z
        std::optional<double> slicePosition;            // m
    } field;

    MoleculeOptions molecule;
    ExportOptions animation;
};

// Thrown when the command line asks for something impossible: exit code 2, where a run that fails has 1.
class WrongUse : public Error {
    using Error::Error;
};

// WrongUse: unknown command, option or value, with a suggestion. Prints help or the version itself and
// returns nothing then.
std::optional<Options> parseOptions(int argc, char** argv);

// Error: unknown, with the nearest.
FieldSampling samplingOf(const std::string& word);

}  // namespace shoal::app
