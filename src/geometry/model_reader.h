// The readers of model files, a source each (read_*.cpp), and what they share. For loadMesh, which chooses
// among them (load_model.cpp), alone.
//
// A reader returns what the file says: Mesh's arrays of corners with node transforms applied, triangles,
// objects, parts, materials, images, bones; zero for a normal that the file does not have. What it leaves out
// it tells in Mesh::notes. What follows from these, the weld among it, is completeMesh's.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "geometry/mesh.h"

namespace shoal {

// A model, and who is told of the bytes of each file that is opened for it (the limits of a child process
// grow with them).
struct ModelFile {
    std::string name;
    std::function<void(uint64_t)> opened;
};

Mesh read3mf(const ModelFile& model);
Mesh readGltf(const ModelFile& model);
Mesh readOff(const ModelFile& model);
Mesh readPly(const ModelFile& model);
Mesh readWithAssimp(const ModelFile& model);
Mesh readObj(const ModelFile& model);
Mesh readXyz(const ModelFile& model);

// For readers that hold coordinates in single precision: tells, as a note or a loss, where they lie so far
// from the origin that it rounds them by a part of the model's size.
void tellOfRounding(Mesh& mesh);

constexpr size_t mostElements = size_t{1} << 28;  // vertices, and triangles
constexpr double farthest = 1e30;                 // m; beyond, volumes and their squares would overflow

inline bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Whether a vertex may lie there; at what is not finite, never.
inline bool isWithinReach(const glm::dvec3& place) {
    return std::abs(place.x) <= farthest && std::abs(place.y) <= farthest && std::abs(place.z) <= farthest;
}

// Returns texture coordinates, 0 instead of what is not finite.
inline glm::dvec2 finiteUv(const glm::dvec2& uv) {
    return std::isfinite(uv.x + uv.y) ? uv : glm::dvec2(0);
}

// Returns a vector with length 1; `fallback` for one that has no length, or none that is finite.
inline glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& fallback = glm::dvec3(0)) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 0 ? v / length : fallback;
}

constexpr std::string_view blanks = " \t\n\r\v\f";
// Returns a text without the blanks at its ends.
inline std::string_view trimmed(std::string_view text) {
    const size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

}  // namespace shoal
