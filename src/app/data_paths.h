// Where the shaders and shipped data are: the source tree, or the install prefix.
#pragma once

#include <string>

namespace shoal::app {

// Error: neither holds the shaders; says where was looked. SHOAL_DATA in the environment goes first.
std::string shaderRoot();
std::string moleculeFolder();  // of the molecules that ship, beside the shaders

}  // namespace shoal::app
