// The mesh that becomes a skin: as it is drawn.
#pragma once

#include <optional>

#include "geometry/mesh.h"
#include "molecule/bind_skin.h"

namespace shoal {

// A vertex for each that differs by place, by uv or, at an edge of more than 40 degrees, by normal; without
// triangles that have no extent. With `triangles`: simplified to about so many (quadric edge collapse,
// meshoptimizer), or as far as its seams let it. Error: more than a molecule file holds.
SkinMesh skinMeshOf(const Mesh& mesh, std::optional<int> triangles);

}  // namespace shoal
