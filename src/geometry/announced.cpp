#include "geometry/announced.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/file.h"

namespace shoal {

namespace {

// The next line that is no comment and not empty.
bool nextLine(std::istream& in, std::string& line) {
    while (std::getline(in, line)) {
        line.erase(std::min(line.find('#'), line.size()));
        if (line.find_first_not_of(" \t\r") != std::string::npos) return true;
    }
    return false;
}

std::optional<size_t> trianglesOfOff(std::istream& in) {
    std::string line, word;
    size_t vertices = 0, faces = 0;
    if (!nextLine(in, line)) return std::nullopt;
    std::istringstream head(line);
    if (!(head >> word) || !word.ends_with("OFF")) return std::nullopt;
    if (!(head >> vertices >> faces)) {
        if (!nextLine(in, line)) return std::nullopt;
        std::istringstream counts(line);
        if (!(counts >> vertices >> faces)) return std::nullopt;
    }
    for (size_t i = 0; i < vertices; ++i)
        if (!nextLine(in, line)) return std::nullopt;
    size_t triangles = 0;
    for (size_t i = 0; i < faces && nextLine(in, line); ++i) {
        size_t corners = 0, vertex = 0;
        std::istringstream numbers(line);
        if (!(numbers >> corners)) return std::nullopt;
        for (size_t k = 0; k < corners && corners > 0; ++k)
            if (!(numbers >> vertex) || vertex >= vertices) corners = 0;  // a corner that is not there
        triangles += corners >= 3 ? corners - 2 : 0;
    }
    return triangles;
}

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

// What an animation repeats of a mesh is no triangle more.
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
    if (ending != ".off" && ending != ".stl" && ending != ".ase" && ending != ".ac") return std::nullopt;
    const std::string text = readFile(file);
    if (ending == ".stl") return trianglesOfStl(text);
    if (ending == ".ase") return trianglesOfAse(text);
    if (ending == ".ac") return trianglesOfAc(text);
    std::istringstream in(text);
    return trianglesOfOff(in);
}

}  // namespace shoal
