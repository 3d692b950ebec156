// The commands; each returns the exit code. Errors are thrown and end in one line on standard error.
#pragma once

#include "app/line/options.h"

namespace shoal::app {

int runCommand(const Options& options);
int scenesCommand(const Options& options);
int keysCommand(const Options& options);
int checkCommand(const Options& options);
int explainCommand(const Options& options);
int infoCommand(const Options& options);
int benchCommand(const Options& options);
int benchDeviceCommand(const Options& options);     // shoal bench --report
int benchSortCommand(const Options& options);       // shoal bench sort
int benchCollideCommand(const Options& options);    // shoal bench collide
int benchParticlesCommand(const Options& options);  // shoal bench particles
int benchSchoolCommand(const Options& options);     // shoal bench school
int measureCommand(const Options& options);
int fieldCommand(const Options& options);
int exportCommand(const Options& options);
int editCommand(const Options& options);
int moleculeFromMeshCommand(const Options& options);  // shoal molecule from-mesh
int moleculeNewCommand(const Options& options);       // shoal molecule new
int moleculeShowCommand(const Options& options);      // shoal molecule show

// Returns the warnings of check beside the plan's own.
std::vector<Warning> warningsOfStart(const Scene& scene, const Plan& plan);

// With --sandbox: from now on only what lies in the folder of `file`, in the shipped data, in the cache and
// in what other options name is opened (core/file.h).
void keepToSandbox(const Options& options, const std::string& file);

// For a context of the kind that --context asks for, with nothing to see.
gpu::ContextOptions hiddenContext(const Options& options);

// The scene that a command is about, with its plan, unless --error has to find first what to compile
// (measure.h).
Loaded load(const Options& options);

}  // namespace shoal::app
