// A mesh of few vertices in the shape of one of many: simplified (coarse.cpp), of rings (rings.cpp), or the
// surface of a lattice (lattice.cpp) or of a cage (cage.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "geometry/sample_grid.h"

namespace shoal {

struct CoarseMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::ivec3> triangles;  // anticlockwise seen from the front
    // Welded vertex of the source -> coarse vertex, the nearest along the surface, so that what is known of
    // the source (pins, paint) is known of these.
    std::vector<int> map;
    std::vector<int> source;  // coarse vertex -> welded vertex nearest to it
};

// Simplifies a mesh to at most `vertices` vertices, 3 or more. Edges collapse by the quadric error metric
// ([Garland 1997], by meshoptimizer). In three cases vertices are gathered about seeds far from one another
// instead: where the topology stops the collapse too early, in flat meshes, where every collapse costs
// nothing, and where a straight piece would keep no vertex. No vertex of the mesh is left further than a
// quarter of its size from the nearest coarse vertex.
CoarseMesh simplify(const Mesh& mesh, int vertices);

// So many rings of four vertices (right, top, left, bottom) around the longest axis of the box, from its
// positive end to its negative one, closed at the ends. Error: the mesh is flat along an axis.
CoarseMesh ringsOf(const Mesh& mesh, int rings);
// Whether all sections across that axis are of one part.
bool holdsRings(const Mesh& mesh);

// At most so many vertices in rows across a flat sheet. Nothing where a row would have gaps: the sheet has
// holes or lobes, or lies on itself.
std::optional<CoarseMesh> rowsOf(const Mesh& mesh, int vertices);

// The volume of a closed mesh as samples of a grid: is a point inside, how much is near what.
class Inside {
  public:
    // Samples a closed mesh. Parts thinner than a cell, a 250th of the longest side at the finest, may be
    // missed.
    explicit Inside(const Mesh& mesh);

    bool contains(const glm::dvec3& point) const;
    // The share of points of the segment that lie inside.
    double share(const glm::dvec3& a, const glm::dvec3& b) const;
    double volume() const { return double(samples_.size()) * grid_.cell * grid_.cell * grid_.cell; }
    const std::vector<glm::dvec3>& samples() const { return samples_; }  // the middle of every cell inside

  private:
    SampleGrid grid_;
    std::vector<int16_t> winding_;
    std::vector<glm::dvec3> samples_;
};

// Tetrahedra of a body-centred cubic lattice that fill a volume ([Molino 2003]: the lattice, not its
// refinement).
struct Lattice {
    CoarseMesh surface;                     // its vertices, and the faces of one tetrahedron only
    std::vector<std::array<int, 4>> cells;  // tetrahedra
};

// As fine as `vertices` allow: of all lattices over the box the one that fills most with at most so many
// vertices. Error: the shape is too thin for any.
Lattice latticeIn(const Mesh& mesh, const Inside& inside, int vertices);

// A tetrahedron of that lattice: between the centre of a cube and that of the next along an axis, one of the
// four about their common face.
struct LatticeCell {
    glm::ivec3 cube{0};
    int axis = 0, quarter = 0;

    // In halves of the spacing: both centres, which are odd, and two corners of cubes, which are even.
    std::array<glm::ivec3, 4> corners() const;
    bool operator<(const LatticeCell& o) const {
        return std::tie(cube.x, cube.y, cube.z, axis, quarter) <
               std::tie(o.cube.x, o.cube.y, o.cube.z, o.axis, o.quarter);
    }
};

// The part of each cell, by one of its cells. Those of a part hang together by faces: hinges would bend
// without resistance.
std::vector<size_t> partsOf(const std::vector<std::array<int, 4>>& cells);

// The surface of cells, and they.
Lattice latticeOf(std::vector<glm::dvec3> places, std::vector<std::array<int, 4>> cells);

// Around any mesh, of one part or many, closed or not: all cells through which its surface passes or, with
// `inside`, that hold some of its volume; as fine as `vertices` allow while they hang together by faces.
// Their vertices are drawn in towards the surface. Error: no such cage has so few vertices.
Lattice cageAround(const Mesh& mesh, const Inside* inside, int vertices);

// Fills map and source from positions: by the way along the mesh's edges, else by distance.
void mapToCoarse(const Mesh& mesh, CoarseMesh& coarse);

// The smallest of the three extents along the principal axes, as a share of the largest.
double flatness(const std::vector<glm::dvec3>& points);

// Moves the vertices of what is flat up and down in turn by half a height, m, so that bending stretches
// springs to first order.
void fold(CoarseMesh& coarse, double height);

}  // namespace shoal
