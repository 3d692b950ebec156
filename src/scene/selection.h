// Finds the vertices and triangles of a model that a Selection means.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace shoal {

struct Selected {
    std::vector<int> vertices;   // welded vertices, ascending
    std::vector<int> triangles;  // all three vertices selected and, when named, of the object
    // How many vertices met each condition, for messages: "object \"twigs\" matched 120 of 4000 vertices;
    // ..."
    std::string report;
};

// Conditions hold one by one; `thinnest` then takes its share of the vertices that met all others.
// A vertex belongs to an object or has a colour when one of its corners does.
Selected select(const Mesh& mesh, const Selection& selection);

// m^2, of the selected triangles.
double selectedArea(const Mesh& mesh, const Selection& selection);

}  // namespace shoal
