// A skin: a finer mesh that is drawn in place of a molecule's triangles, and moves with its few simulated
// vertices. It costs the simulation nothing.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace shoal {

struct Molecule;

// Binds a skin vertex to one simulated vertex.
struct SkinWeight {
    int vertex = 0;
    double weight = 0;  // may be negative
};

// A vertex of the skin lies at  sum of weight_k x_k + offset n,  n the unit normal of sum of weight_k n_k,
// with x and n of the simulated vertices. Weights add up to 1 and reproduce the position in the rest shape,
// so that every affine motion of the molecule carries the skin exactly.
struct SkinVertex {
    glm::dvec3 position{
        0};  // m, in the rest shape; follows from the weights (placeSkin) and is not in the file
    glm::dvec2 uv{0};
    std::vector<SkinWeight> weights;  // 1 to Skin::mostWeights
    double offset = 0;                // m, along the molecule's normal
};

struct SkinTriangle {
    int a = 0, b = 0, c = 0;  // anticlockwise seen from the front
};

struct Skin {
    static constexpr int mostWeights = 8;
    std::vector<SkinVertex> vertices;
    std::vector<SkinTriangle> triangles;
    bool empty() const { return triangles.empty(); }
};

// The normals of simulated vertices at `positions`: unit sums of the area vectors of their triangles (Decker,
// section 3.5; shaders/physics/normal.glsl); zero for a vertex of none.
std::vector<glm::dvec3> vertexNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions);

// Where the skin's vertices lie when the simulated ones lie at `positions`.
std::vector<glm::dvec3> skinPositions(const Molecule& molecule, const std::vector<glm::dvec3>& positions);

// Fills the positions of the skin's vertices from the rest shape. Call it when vertices were moved.
void placeSkin(Molecule& molecule);

}  // namespace shoal
