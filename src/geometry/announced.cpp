#include "geometry/announced.h"

#include <cstdlib>
#include <sstream>

#include "core/file.h"

namespace shoal {

namespace {

size_t linesThatBeginWith(const char* keyword, const std::string& text) {
    std::istringstream in(text);
    size_t count = 0;
    for (std::string line, word; std::getline(in, line);)
        if (std::istringstream(line) >> word && word == keyword) ++count;
    return count;
}

bool isBinary(const std::string& text) {
    return text.find('\0') != std::string::npos;
}

// A binary file may begin with "solid", too: its bytes are no text.
std::optional<size_t> trianglesOfStl(const std::string& text) {
    if (!text.starts_with("solid") || isBinary(text)) return std::nullopt;
    return linesThatBeginWith("facet", text);
}

// Leaves out the shapes that an animation repeats of a mesh.
std::optional<size_t> trianglesOfAse(const std::string& text) {
    if (isBinary(text) || text.find("*MESH_ANIMATION") != std::string::npos) return std::nullopt;
    return linesThatBeginWith("*MESH_FACE", text);
}

// The first four bits of a surface are 0 for a polygon, else it is a line. An object that is to be subdivided
// has more triangles than its text.
std::optional<size_t> trianglesOfAc(const std::string& text) {
    if (!text.starts_with("AC3D")) return std::nullopt;
    std::istringstream in(text);
    size_t triangles = 0;
    bool isPolygon = false;
    for (std::string line, word; std::getline(in, line);) {
        std::istringstream words(line);
        if (!(words >> word)) continue;
        if (word == "subdiv") return std::nullopt;
        if (word == "SURF" && words >> word) isPolygon = std::strtoul(word.c_str(), nullptr, 0) % 16 == 0;
        size_t corners = 0;
        if (line.starts_with("refs ") && words >> corners && isPolygon && corners > 2)
            triangles += corners - 2;
    }
    return triangles;
}

}  // namespace

std::optional<size_t> announcedTriangles(const std::string& file) {
    const std::string ending = lowerExtension(file);
    if (ending != ".stl" && ending != ".ase" && ending != ".ac" && ending != ".dae") return std::nullopt;
    const std::string text = readFile(file);
    if (ending == ".stl") return trianglesOfStl(text);
    if (ending == ".dae") return trianglesOfCollada(text);
    if (ending == ".ase") return trianglesOfAse(text);
    return trianglesOfAc(text);
}

}  // namespace shoal
