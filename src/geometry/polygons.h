// Polygons whose corners have texture coordinates and colours of their own become triangles of a mesh. For
// the readers of models.
#pragma once

#include <cstdint>

#include "geometry/mesh.h"

namespace shoal {

struct Polygons {
    // `count` of `corners`, from `first` on; three or more.
    struct Polygon {
        size_t first = 0, count = 0;
        int look = 0;  // the number of what it is painted with, by which parts are made
    };
    std::vector<Polygon> polygons;
    std::vector<int> corners;  // of all polygons: vertices of the mesh
    // Beside the corners, linear RGB; empty: vertices have them, or nothing has. Those behind an array's end
    // are 0 and white.
    std::vector<glm::dvec2> cornerUvs;
    std::vector<glm::dvec3> cornerColors;
    int64_t flat = 0;  // polygons of fewer than three corners, which are left out

    // Makes a polygon of the last `count` corners. Error: all corners become more than mostElements.
    void close(size_t count, int look, const std::string& file);

    // Notes how many polygons are flat.
    void tellFlat(Mesh& mesh) const;

    // Cuts the polygons into triangles, adds them to a mesh that has vertices, and returns the look of each
    // of Mesh::parts, which are in the order of these numbers. Vertices are repeated where corners differ.
    // Error: they become more than mostElements.
    std::vector<int> addTo(Mesh& mesh, const std::string& file);
};

}  // namespace shoal
