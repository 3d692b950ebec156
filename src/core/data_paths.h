// Where the shaders and shipped data are: the source tree, or the install prefix.
#pragma once

#include <string>
#include <vector>

namespace shoal {

// Error: neither holds the shaders; says where was looked. SHOAL_DATA in the environment goes first.
std::string shaderRoot();
// Folders of the shipped data, beside the shaders.
std::string moleculeFolder();
std::string modelFolder();  // with the scenes

std::vector<std::string> shippedMolecules();  // by their names: "leaf" for leaf.json
// Whether a text can be such a name: that of a file has an ending or a folder.
bool isShippedName(const std::string& text);
// The file of a molecule that a file names: one that ships by its name, any other relative to the folder of
// the file that names it.
std::string moleculeFile(const std::string& written, const std::string& namedIn);

}  // namespace shoal
