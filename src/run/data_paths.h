// Where the shaders and shipped data are: the source tree, or the install prefix.
#pragma once

#include <string>

#include "gpu/context.h"

namespace shoal {

// Error: neither holds the shaders; says where was looked. SHOAL_DATA in the environment goes first.
std::string shaderRoot();
// Returns the options of a context that makes programs of these and keeps them in the user's cache
// (core/cache_folder.h).
gpu::ContextOptions contextOptions();
// Folders of the shipped data, beside the shaders.
std::string moleculeFolder();
std::string modelFolder();  // with the scenes

}  // namespace shoal
