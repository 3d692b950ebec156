// Where the shaders and shipped data are: the source tree, or the install prefix.
#pragma once

#include <string>

namespace shoal {

// Error: neither holds the shaders; says where was looked. SHOAL_DATA in the environment goes first.
std::string shaderRoot();
// Folders of the shipped data, beside the shaders.
std::string moleculeFolder();
std::string modelFolder();  // with the scenes

}  // namespace shoal
