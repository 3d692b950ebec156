// A triangle mesh as loaded from a model file: welded by position, node transforms applied.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {

// Corner attributes (normals, colours, uvs) stay per corner so that welding loses none of them.
// `weld[corner]` is the welded vertex of each corner: rules and pins that name a corner keep hitting
// the vertex they mean.
struct Mesh {
    // One per corner vertex of the file (after node transforms); arrays have equal length or are empty.
    std::vector<glm::dvec3> positions;  // m
    std::vector<glm::dvec3> normals;    // unit length; always filled (from the triangles where absent)
    std::vector<glm::dvec3> colors;     // linear RGB; empty when the file has none
    std::vector<glm::dvec2> uvs;        // empty when the file has none
    std::vector<glm::ivec3> triangles;  // indices into the arrays above

    std::vector<int> weld;                    // corner vertex -> welded vertex
    std::vector<glm::dvec3> weldedPositions;  // one per welded vertex
    std::vector<glm::dvec3> weldedNormals;    // unit: the vertex's triangles weighted by their angles there

    struct Object {
        std::string name;  // the file's object, mesh or node name
        int firstTriangle = 0, triangleCount = 0;
    };
    std::vector<Object> objects;

    // Pieces of objects, each of one of the file's meshes and materials.
    struct Part {
        std::string mesh, material;  // the file's names; may be empty
        int firstTriangle = 0, triangleCount = 0;
    };
    std::vector<Part> parts;

    glm::dvec3 low{0}, high{0};  // bounding box
};

}  // namespace shoal
