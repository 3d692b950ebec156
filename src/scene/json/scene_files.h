// The files that a scene is made of.
#pragma once

#include <string>
#include <vector>

namespace shoal {

// The scene file and whatever it names, directly or through another JSON file (molecules, their images, skins
// and so on): every text in them that is the name of a file which is there, relative to the file that names
// it, or that stands for numbered ones (wind-##.vti); and the materials that .obj models name. Files that
// cannot be read name nothing. Sorted, each once.
std::vector<std::string> filesOf(const std::string& sceneFile);

}  // namespace shoal
