// From any mesh to a molecule: few vertices that are simulated, springs that hold their shape, and the mesh
// itself as a skin that moves with them.
//
//   mesh -> coarse mesh (coarse.h) -> springs -> masses -> pins (pins.cpp) -> braces -> stiffness
//        -> colours (skin_colors.cpp) -> skin (skin_mesh.cpp, molecule/skin.h)
//
// Stiffness and mass are those of a named material (material_scale.cpp).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "author/beam_fit.h"
#include "geometry/mesh.h"
#include "molecule/analysis.h"
#include "molecule/molecule.h"

namespace shoal {

struct CoarseMesh;
struct SkinMesh;

// A rule by which vertices are pinned. "y<0.1": the coordinate in shares of the mesh's box, from 0 to 1.
// "y<0.02m": in metres.
struct PinRule {
    int axis = 1;
    bool below = true;
    double limit = 0;
    bool metres = false;
    std::string text;
};

// Error: not such a rule.
PinRule parsePinRule(const std::string& text);
// "0.5,1,0.5". Error: not three numbers.
glm::dvec3 parsePinPoint(const std::string& text);
// "+X": an axis with its sign, as a unit vector. Error: none.
glm::dvec3 parseAxis(const std::string& text);
// Turns a mesh so that an axis of it becomes +Z. +Y stays where it is, or becomes -Z where the axis is +Y, +Z
// where it is -Y.
void turnForward(Mesh& mesh, const glm::dvec3& axis);
// Makes muscles of all springs that bending about +Y stretches, for the wave of a fish that swims along +Z.
// `lowest`: the molecule's lowest frequency, Hz. Returns how fast they beat, Hz.
double addMuscles(Molecule& molecule, double lowest);
// Linear RGB: red, green, blue, yellow, cyan, magenta, white, black, or three numbers from 0 to 1
// ("1,0.5,0"). Error: neither.
glm::dvec3 parsePaint(const std::string& text);

struct PinChoice {
    std::vector<PinRule> rules;
    std::vector<std::string> names;   // of objects, meshes or materials
    std::vector<std::string> paints;  // vertex colours
    std::vector<glm::dvec3> points;   // in shares of the mesh's box: the vertex nearest to each
    bool any() const { return !rules.empty() || !names.empty() || !paints.empty() || !points.empty(); }
};

struct FromMesh {
    enum class Springs {
        automatic,  // along the surface, or of a cage where the skin would tear there
        surface,    // along the coarse surface, across its edges, and through the inside
        lattice,    // tetrahedra on a body-centred cubic lattice within the mesh
        cage,       // those about the mesh and all of its parts
    };
    std::optional<int> vertices;  // at most so many are simulated; nothing: 24, of a cage cageVertices
    std::optional<int> rings;     // instead: so many rings of four vertices along the longest axis
    Springs springs = Springs::automatic;
    std::string material;               // of the material scale; empty: flesh for a body, leaf for a sheet
    std::optional<double> size;         // m, of the longest side of its box; nothing: the file's
    std::optional<double> mass;         // kg, in all; nothing: from the material's density
    std::optional<double> density;      // kg/m^3, instead of the material's
    std::optional<double> modulus;      // Pa, Young's, instead of the material's
    std::optional<double> thickness;    // m, of a sheet, instead of the material's
    std::optional<double> frequency;    // Hz, the lowest; nothing: from the material
    std::optional<double> damping;      // ratio of the lowest mode; nothing: the material's
    bool centre = false;                // the middle of its box to the origin, as of a mesh far away
    std::optional<glm::dvec3> forward;  // an axis of the file, which is turned to +Z; nothing: none is
    bool swims = false;                 // its springs are muscles for a wave of bending along +Z
    bool skin = true;
    bool images = true;                // the skin is drawn with the colours of the mesh's materials
    std::optional<int> skinTriangles;  // the skin is simplified to about so many; nothing: all
    PinChoice pins;
    std::string name;
};

// The fewest vertices that can hold a body, and the most whose frequencies are found within seconds.
constexpr int leastMadeVertices = 4, usualMadeVertices = 24, mostMadeVertices = 227;
constexpr int cageVertices =
    40;  // which CPU rasterisers compile with the implicit solvers that stiff springs need

// What a molecule is to bend like, and how near it comes.
struct StandsFor {
    BeamMaterial material{};
    Likeness free{};                          // Hz, lowest bending of what nothing holds
    std::optional<ClampedFigures> clamped{};  // with its pins, where they hold one end
    double reach = 0;                         // m, from there to the other end
};

struct MadeMolecule {
    Molecule molecule;
    // Springs by kind; they are stored in this order.
    int edges = 0, shears = 0, bends = 0, braces = 0, repairs = 0;
    bool solid = false;              // has a volume
    double area = 0, volume = 0;     // m^2, m^3; the volume of a sheet is 0
    glm::dvec3 extent{0};            // m, of the mesh's box
    double lowestFrequency = 0;      // Hz, of the free molecule
    double beat = 0;                 // Hz, of its muscles; 0: it has none
    double dampingRatio = 0;         // of that mode; at most the material's
    double skinError = 0;            // m, how far the skin lies off the mesh at rest, at most
    double skinReach = 0;            // m, from the skin to the nearest simulated vertex, at most
    double skinLever = 0;            // how far the skin moves by how far a vertex does, at most
    std::string material;            // as used
    std::optional<StandsFor> beam;   // nothing: it is no beam, or its frequency was asked for
    std::vector<std::string> notes;  // what was done that was not asked for
    std::optional<Image> image;      // the skin's colours, by its texture coordinates
};

// Error, which begins with the name of the option: a number that is out of range, two that exclude each
// other, more vertices than the fused path holds.
void checkOptions(const FromMesh& options);

// Error: without a place, as the mesh or the options have it: no volume where one is needed, more vertices
// than the fused path holds, an unknown material, a number out of range, pins that no vertex meets.
MadeMolecule makeMolecule(const Mesh& mesh, const FromMesh& options);

// makeMolecule calls what follows, which has sources of its own.

// For each coarse vertex: it is pinned when most of the source's vertices that it stands for are; when that
// leaves none, the one with the largest share. A rule that no vertex meets, a name that is not there or a
// colour that is not painted: Error.
std::vector<bool> choosePins(const Mesh& mesh, const CoarseMesh& coarse, const PinChoice& choice);
// The welded vertices that rules, names and paints mean. Error: choosePins's.
std::vector<bool> pinnedOf(const Mesh& mesh, const PinChoice& choice);

// Returns the mesh that becomes a skin. Corners share a vertex where place and uv agree and the normals
// differ by at most 40 degrees; triangles with two corners in one vertex are left out. With `triangles`, the
// mesh is simplified to about so many (quadric edge collapse, by meshoptimizer), or as far as its seams
// allow. Error: more than a molecule file holds.
SkinMesh skinMeshOf(const Mesh& mesh, std::optional<int> triangles);

// Gathers the colours of a mesh's parts in one sRGB image, with holes where the parts' images have them. The
// mesh's texture coordinates become those of that image, and its triangles no longer share corners. Where all
// of the mesh has one colour, it stays as it is and nothing is returned. `notes` says what the image does not
// show.
std::optional<Image> gatherColors(Mesh& mesh, std::vector<std::string>& notes);

// Gives a molecule the mean colour of a mesh and of its materials, and their roughness and metallic share.
void chooseLooks(const Mesh& mesh, Material& looks);

// The skin that hangs on the corners of the cell, of these of the molecule, that holds each of its vertices,
// or is nearest to it.
Skin bindToCells(const Molecule& molecule, const SkinMesh& mesh,
                 const std::vector<std::array<int, 4>>& cells);

// A named material, from soft to stiff. Rounded values of handbooks. A sheet has the thickness; a body is as
// thick as it is.
struct ScaledMaterial {
    const char* name;
    double modulus;    // Pa, Young's
    double density;    // kg/m^3
    double thickness;  // m, of a sheet
    double damping;    // ratio of the lowest mode to critical
};

std::span<const ScaledMaterial> materialScale();
// Error: unknown, with the nearest.
const ScaledMaterial& scaledMaterial(const std::string& name);

// The lowest frequency of a free body or sheet of a material, Hz: of bending, as a beam that is free at both
// ends
//   (4.730^2 / 2 pi) sqrt(EI / (mass / length)) / length^2     (Euler and Bernoulli [Blevins 1979])
// and no higher than that of stretching, sqrt(E / density) / (2 length).
// `length` m; `gyration` m: of the section about the axis that it bends about most easily; `density` kg/m^3.
double lowestFrequency(double modulus, double density, double length, double gyration);

}  // namespace shoal
