// The commands; each returns the exit code. Errors are thrown and end in one line on standard error.
#pragma once

#include "app/options.h"
#include "compile/plan.h"

namespace shoal::app {

int runCommand(const Options& options);
int scenesCommand(const Options& options);
int checkCommand(const Options& options);
int explainCommand(const Options& options);
int infoCommand(const Options& options);
int benchCommand(const Options& options);           // with a word after it: one of those below
int benchSortCommand(const Options& options);       // shoal bench sort
int benchCollideCommand(const Options& options);    // shoal bench collide
int benchParticlesCommand(const Options& options);  // shoal bench particles
int benchSchoolCommand(const Options& options);     // shoal bench school
int measureCommand(const Options& options);
int fieldCommand(const Options& options);
int editCommand(const Options& options);
int moleculeFromMeshCommand(const Options& options);  // shoal molecule from-mesh
int moleculeShowCommand(const Options& options);      // shoal molecule show

// A scene and its plan with the options applied; warnings go to standard error.
struct Loaded {
    Scene scene;
    Plan plan;
};
Loaded load(const Options& options);

}  // namespace shoal::app
