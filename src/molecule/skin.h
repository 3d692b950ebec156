// Where a molecule's skin lies, and how a mesh is bound to a molecule's few vertices as its skin.
#pragma once

#include "molecule/molecule.h"

namespace shoal {

// The normals of simulated vertices at `positions`: unit sums of the area vectors of their triangles (Decker,
// section 3.5; shaders/physics/normal.glsl); zero for a vertex of none.
std::vector<glm::dvec3> vertexNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions);
// As vertexNormals(), into `out`, for loops that should not allocate.
void sumNormals(const Molecule& molecule, const std::vector<glm::dvec3>& positions,
                std::vector<glm::dvec3>& out);

// Where the skin's vertices lie when the simulated ones lie at `positions`.
std::vector<glm::dvec3> skinPositions(const Molecule& molecule, const std::vector<glm::dvec3>& positions);

// Fills the positions of the skin's vertices from the rest shape. Call it when vertices were moved.
void placeSkin(Molecule& molecule);

struct SkinMesh {
    std::vector<glm::dvec3> positions;  // m, about the molecule's rest shape
    std::vector<glm::dvec2> uvs;        // as many
    std::vector<SkinTriangle> triangles;
};

// Moving least squares [Lancaster 1981] over the nearest vertices, at most Skin::mostWeights: of all weights
// that add up to 1 and reproduce the point, those with the least sum of weight^2 / kernel. The kernel falls
// to 0 at the first vertex that is left out, so that weights change smoothly along the skin.
//
// Weights are rounded to 1e-7, uvs to 1e-6, which the file keeps. Of vertices that lie in a plane, what the
// plane does not reach is an offset along the molecule's normal.
Skin bindSkin(const Molecule& molecule, const SkinMesh& mesh);

// Binds a molecule's skin anew, at the places that it has: after vertices were added, removed or renumbered.
void rebindSkin(Molecule& molecule);

// How a skin vertex turns with the molecule: the tangents t and b of the skin in the rest shape, with t x b
// its normal, move as sum of along_k x_k + offset n and sum of across_k x_k + offset n. The weights of both
// add up to 0 and reproduce the tangent, so that normals follow every affine motion exactly.
struct SkinFrame {
    std::vector<double> along, across;  // one a weight of the vertex
    double alongOffset = 0, acrossOffset = 0;
};

// Returns the frame of every vertex of the molecule's skin. Normals are smooth; vertices in one place share
// theirs unless they differ by more than 40 degrees, as at the edge of a box.
std::vector<SkinFrame> skinFrames(const Molecule& molecule);
std::vector<glm::dvec3> skinNormals(const Skin& skin);  // the same normals, in the rest shape
// Returns the normals where the simulated vertices lie at `positions`; `frames`: skinFrames(). Zero where the
// tangents have fallen together.
std::vector<glm::dvec3> skinNormals(const Molecule& molecule, const std::vector<SkinFrame>& frames,
                                    const std::vector<glm::dvec3>& positions);

}  // namespace shoal
