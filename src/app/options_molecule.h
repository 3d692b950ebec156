// The options of `shoal molecule COMMAND`. A further command is a function here that adds its options, a word
// of Options::Command, and a row in addMolecule().
#pragma once

#include <string>
#include <vector>

#include "author/from_mesh.h"

namespace CLI {
class App;
}

namespace shoal::app {

struct Options;

struct MoleculeOptions {
    // from-mesh
    FromMesh fromMesh;
    std::string output;  // empty: nothing is written
    bool force = false;  // write over a file that is there
    std::string texture;
    std::string color;
    std::string springs = "surface";
    std::vector<std::string> pinRules;
    // show
    std::string sheet;  // its size in pixels; empty: the usual
};

// Adds `molecule` with its commands.
void addMolecule(CLI::App& app, Options& options);

// Once the command line is parsed: which command of `molecule` it is, if any, and its values. Error: out of
// range, or not what is expected.
void finishMolecule(const CLI::App& app, Options& options);

}  // namespace shoal::app
