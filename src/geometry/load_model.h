// Triangle meshes from model files of any format that Assimp reads.
#pragma once

#include <string>

#include "geometry/mesh.h"

namespace shoal {

// All triangles of the file with node transforms applied, one Mesh::Object per node that has triangles.
// Polygons are cut into triangles; lines and points are ignored. Vertex colours become linear: OBJ and PLY
// files hold them in sRGB by custom, glTF and the others linear.
// The file is read in a child process (core/confined.h), unless SHOAL_TRUST_MODELS is set and not empty.
// Error: no such file, not readable as a model within limits of time and memory, a position that is not
// finite or beyond 1e30 m, no triangles.
Mesh loadMesh(const std::string& file);

// Fills what follows from positions and triangles: missing normals (zero or an empty array), the weld
// by position (within 1e-6 of the bounding box's diagonal), welded positions and normals, the box.
void completeMesh(Mesh& mesh);

}  // namespace shoal
