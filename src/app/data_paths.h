// Where the shaders and shipped data are: the source tree, or the install prefix.
#pragma once

#include <string>

#include "app/options.h"

namespace shoal::app {

// Error: neither holds the shaders; says where was looked. SHOAL_DATA in the environment goes first.
std::string shaderRoot();
// Of what ships, beside the shaders.
std::string moleculeFolder();
std::string modelFolder();  // with the scenes

// With --sandbox: from now on only what lies in the folder of `file`, in the shipped data, in the cache and
// in what other options name is opened (core/sandbox.h).
void keepToSandbox(const Options& options, const std::string& file);

}  // namespace shoal::app
