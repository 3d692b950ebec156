// From any mesh to a molecule: few vertices that are simulated, springs that hold their shape, and the mesh
// itself as a skin that moves with them.
//
//   mesh -> coarse mesh (coarse.h, rings.cpp or lattice.h) -> springs -> masses -> pins -> braces ->
//   stiffness
//        -> skin (molecule/bind_skin.h)
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "author/pins.h"
#include "geometry/mesh.h"
#include "molecule/analysis.h"
#include "molecule/molecule.h"

namespace shoal {

struct FromMesh {
    enum class Springs {
        surface,  // along the coarse surface, across its edges, and through the inside
        lattice,  // tetrahedra on a body-centred cubic lattice within the mesh
    };
    int vertices = 24;         // at most so many are simulated
    std::optional<int> rings;  // instead: so many rings of four vertices along the longest axis
    Springs springs = Springs::surface;
    std::string material;             // of the material scale; empty: flesh for a body, leaf for a sheet
    std::optional<double> size;       // m, of the longest side of its box; nothing: the file's
    std::optional<double> mass;       // kg, in all; nothing: from the material's density
    std::optional<double> density;    // kg/m^3, instead of the material's
    std::optional<double> frequency;  // Hz, the lowest; nothing: from the material
    std::optional<double> damping;    // ratio of the lowest mode; nothing: the material's
    bool centre = false;              // the middle of its box to the origin
    bool skin = true;
    std::optional<int> skinTriangles;  // the skin is simplified to about so many; nothing: all
    PinChoice pins;
    std::string name;
};

// The fewest vertices that can hold a body, and the most that the fused path runs on every device
// (compile/path.h).
constexpr int leastMadeVertices = 4;
int mostMadeVertices();

struct MadeMolecule {
    Molecule molecule;
    // Springs by kind; they are stored in this order.
    int edges = 0, shears = 0, bends = 0, braces = 0, repairs = 0;
    bool solid = false;              // has a volume
    double area = 0, volume = 0;     // m^2, m^3; the volume of a sheet is 0
    glm::dvec3 extent{0};            // m, of the mesh's box
    double lowestFrequency = 0;      // Hz, of the free molecule
    double dampingRatio = 0;         // of that mode; at most the material's
    double skinError = 0;            // m, how far the skin lies off the mesh at rest, at most
    std::string material;            // as used
    std::vector<std::string> notes;  // what was done that was not asked for
};

// Error: a number that is out of range, two that exclude each other, more vertices than the fused path holds.
void checkOptions(const FromMesh& options);

// Error: without a place, as the mesh or the options have it: no volume where one is needed, more vertices
// than the fused path holds, an unknown material, a number out of range, pins that no vertex meets.
MadeMolecule makeMolecule(const Mesh& mesh, const FromMesh& options);

}  // namespace shoal
