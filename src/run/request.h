// The user's request for a run, in a window or without: how it is solved, which values replace those of the
// scene's file, and which states are saved.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compile/path.h"
#include "compile/plan.h"
#include "scene/scene.h"

namespace shoal {

struct RunRequest {
    Path path = Path::automatic;
    Lanes lanes = Lanes::automatic;
    bool inPlace = false;  // fused: one side of the state

    // Instead of what the scene says.
    std::optional<double> dt;                         // s, of a frame
    std::optional<std::optional<SolverKind>> solver;  // inner nothing: auto
    std::optional<FieldSampling> sampling;
    std::optional<int> substeps, count;
    std::optional<uint64_t> seed;

    bool diagnostics = true;  // the run tells of itself (measure/diagnostics.h)
    bool lenient = false;     // reads models of which something is lost (geometry/mesh.h)

    std::string save;             // a checkpoint
    std::vector<int> saveFrames;  // empty: the last
    std::string resume;           // a checkpoint to go on from

    // What of it binds another scene as well.
    RunRequest forAnother() const;
};

// Puts the values that were asked for in place of the scene's.
void apply(const RunRequest& request, Scene& scene);

// Reads the scene of a file, with what was asked for. Error: the reader's, and what `check` refuses, before
// anything is baked.
Scene readScene(const std::string& file, const RunRequest& request,
                void (*check)(const Scene&) = checkCounts);

// That scene and its plan.
struct Loaded {
    Scene scene;
    Plan plan;
};
// Makes the plan; warnings go to standard error. Error: compile's.
void planScene(Loaded& loaded);
// Error: the reader's or compile's.
Loaded loadScene(const std::string& file, const RunRequest& request);

}  // namespace shoal
