// The scenes to choose from, in the window and by name on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace shoal {

struct ListedScene {
    std::string file, name, comment;  // as the scene calls itself; without a name, the file's
};

// Every *.scene.json in the folder and those below it, in the order of its scenes.txt, then by their names.
// Files that cannot be read are listed by their file's name: opening one tells what is wrong.
std::vector<ListedScene> scenesBelow(const std::string& folder);

// The file of a word on the command line: a file's name, or a scene that ships, such as tree/leaves; hello is
// hello/hello, and so is what only one is called. Nothing: neither. Error: several scenes are called so.
std::optional<std::string> sceneFile(const std::string& word);
// Returns the file as sceneFile() does. Error: there is none, with the nearest name.
std::string needScene(const std::string& word);
// The name on the command line and the file of each scene that ships.
std::vector<std::pair<std::string, std::string>> shippedScenes();
// A line for each scene below the folder: what to call it, and what it says of itself.
std::string listOfScenes(const std::string& folder);

}  // namespace shoal
