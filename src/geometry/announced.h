// Counts what a text says that a model consists of, since a reader that drops lines does not tell. Only
// read_assimp.cpp uses it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace shoal {

// Returns the triangles that a model has, its polygons cut: of STL as text by its "facet"s, of ASE by its
// "*MESH_FACE"s, of AC3D by its surfaces, of COLLADA by its scene. None: the file is of another format,
// binary, or not understood here.
std::optional<size_t> announcedTriangles(const std::string& file);

// Returns the triangles of a COLLADA document's scene (announced_collada.cpp).
std::optional<size_t> trianglesOfCollada(const std::string& text);

}  // namespace shoal
