// A triangle mesh as loaded from a model file (load_model.cpp): welded by position, node transforms applied;
// how its parts look (its materials), whether it encloses a volume (mesh.cpp), and how thick it is
// (closest_point.cpp).
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/image.h"

namespace shoal {

// How a part of a mesh looks: glTF 2's model of metallic and rough surfaces, into which the materials of
// other formats are translated. Colours are linear RGB. Images are numbers in Mesh::images, -1 for none;
// where there is one, what stands beside it multiplies it.
struct SurfaceMaterial {
    // How what is not opaque is drawn: cut out where opacity is below alphaCut, or blended with what is
    // behind.
    enum class Alpha { opaque, cut, blend };
    glm::dvec4 color{1};  // and opacity; multiplies the vertices' colours too
    glm::dvec3 emissive{0};
    double metallic = 0, roughness = 0.9;  // in [0, 1]
    double normalScale = 1;                // of the normal image's slopes
    double alphaCut = 0.5;
    Alpha alpha = Alpha::opaque;
    double refraction = 1;  // index of refraction of what is blended; 1: light goes straight through
    int colorImage = -1, emissiveImage = -1;  // sRGB; alpha is opacity
    int normalImage = -1;                     // the normal in tangent space, from -1 to 1
    int roughnessImage = -1;                  // green: roughness; blue: metallic
};

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

    std::vector<int> bones;  // the heaviest bone of each, in boneNames, or -1; empty when the file has none
    std::vector<std::string> boneNames;

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
        int look = -1;  // its number in `materials`; -1: the file says nothing of it
    };
    std::vector<Part> parts;

    std::vector<SurfaceMaterial> materials;
    std::vector<Image> images;       // RGBA, at most largestModelImage texels a side
    std::vector<std::string> notes;  // what is drawn otherwise than the file has it, a sentence each
    // These tell, a sentence each, what is read otherwise than the file has it in shape, place or mass.
    // loadMesh refuses these, or moves them to the notes.
    std::vector<std::string> losses;

    glm::dvec3 low{0}, high{0};  // bounding box
};

// The message where a surface is needed and there is a cloud of points.
constexpr const char* noTriangles = "has no triangles, expected a mesh with at least one";

constexpr int largestModelImage = 2048;  // larger ones are halved when they are read

// All triangles of the file with node transforms applied, one Mesh::Object per node that has triangles.
// Polygons are cut into triangles; lines and points are ignored, unless there is nothing else: then the mesh
// is the cloud of the file's points, without triangles. Vertex colours become linear: OBJ and PLY
// files hold them in sRGB by custom, glTF and the others linear. Images are embedded, or lie where the file
// says; a path that leads nowhere is looked for by its name beside the model. What is to be blended and lets
// nothing through becomes opaque. The file is read in a child
// process (core/confined.h), unless SHOAL_TRUST_MODELS is set and not empty. Error: no such file, not
// readable as a model within limits of time and memory, a position that is not finite or beyond 1e30 m,
// neither triangles nor points, and where `lenient` is not set any loss.
Mesh loadMesh(const std::string& file, bool lenient = false);

// Fills what follows from positions and triangles: missing normals (zero or an empty array), the weld
// by position (within 1e-6 of the bounding box's diagonal), welded positions and normals, the box.
void completeMesh(Mesh& mesh);

// The triangles of each material one after another, as three corners each; of two parts that look alike they
// are one piece.
struct MeshPiece {
    int look = -1;                // in Mesh::materials; -1: the file says nothing of it
    size_t first = 0, count = 0;  // corners
};
std::vector<MeshPiece> piecesByLook(const Mesh& mesh, std::vector<uint32_t>& corners);

// Whether a mesh encloses a volume, and where it does not.
//
// An edge is sound when as many triangles pass it one way as the other: then every point off the surface has
// a whole winding number, also where shells touch, overlap or share edges. Corners are compared after
// welding.
struct SurfaceReport {
    size_t triangles = 0, degenerate = 0;  // degenerate: two corners in one place; they are left out
    size_t borders = 0;                    // edges of one triangle
    size_t turned = 0;                     // edges whose triangles disagree about the outside
    size_t branching = 0;                  // edges of three or more triangles that do not cancel
    glm::dvec3 where{0};                   // the middle of the first unsound edge
    std::string object;                    // whose triangle it is
    double area = 0, volume = 0;           // m^2; m^3, negative when turned inside out

    size_t unsound() const { return borders + turned + branching; }
    // On the average thinner than a millionth of its size, a surface encloses nothing: a sheet with two
    // faces.
    bool hollow = false;
    bool closed() const { return unsound() == 0 && !hollow; }
};

SurfaceReport examineSurface(const Mesh& mesh);

// "3 border edges, the first at (0.1, 2, -1) of \"rim\"": why the surface is not closed.
std::string whyOpen(const SurfaceReport& report);

// Local thickness in metres of each welded vertex, after the shape diameter function [Shapira 2008]: eight
// rays go inward within 30 degrees of the reversed normal, each to the first surface. Those that enter
// something there started outside and do not count. The least of the middle ray's length and the median is
// taken: exact for slabs, within a few per cent for cylinders, about a diameter at the tip of a twig.
// Infinite where no ray finds a way out (open surfaces) and for vertices that are not `wanted` (one flag
// each; empty: all). O((V + T) log T).
std::vector<double> localThickness(const Mesh& mesh, const std::vector<char>& wanted = {});
// Returns the local thickness that half of the surface stays below, by area, m; 0 where all of it is
// infinite.
double medianThickness(const Mesh& mesh);

}  // namespace shoal
