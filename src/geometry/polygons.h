// Polygons whose corners have texture coordinates, and which have colours of their own, become triangles of a
// mesh. For the readers of models.
#pragma once

#include "geometry/mesh.h"

namespace shoal {

struct Polygons {
    // `count` of `corners`, from `first` on; three or more.
    struct Polygon {
        size_t first = 0, count = 0;
        int image = 0;  // the number of what it is painted with, by which parts are made
        glm::dvec3 color{1};
    };
    std::vector<Polygon> polygons;
    std::vector<int> corners;           // of all polygons: vertices of the mesh
    std::vector<glm::dvec2> cornerUvs;  // beside them; empty: vertices have them, or nothing has
    bool colored = false;               // whether the polygons' colours count, instead of the vertices'

    // Cuts the polygons into triangles, adds them to a mesh that has vertices, and returns the image of each
    // of Mesh::parts, which are in the order of these numbers. Vertices are repeated where corners differ.
    // Error: they become more than mostElements.
    std::vector<int> addTo(Mesh& mesh, const std::string& file);
};

}  // namespace shoal
