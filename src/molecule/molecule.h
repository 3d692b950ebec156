// A molecule: the small mass-spring mesh that every instance of a group shares (Decker, section 3.2).
// SI units throughout: metres, kilograms, seconds, newtons. Right-handed, +Y up.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal {

class Description;

struct Vertex {
    glm::dvec3 position{0};  // m, in the rest shape
    glm::dvec2 uv{0};        // texture coordinates, (0,0) at the lower left
    double mass = 1;         // kg, above 0
    bool pinned = false;     // held where it was placed until the scene releases it
};

// A muscle: L(t) = L (1 + amplitude sin(2 pi frequency t + phase)).
struct Actuation {
    double amplitude = 0;  // share of the rest length, in [0, 1)
    double frequency = 0;  // Hz
    double phase = 0;      // rad
};

// Force on a: -[stiffness (l - L) + damping n.(va - vb)] n, with n from b to a, l their distance.
struct Spring {
    int a = 0, b = 0;
    double stiffness = 0;              // N/m
    double damping = 0;                // N s/m
    std::optional<double> restLength;  // m; the distance in the rest shape when absent
    std::optional<Actuation> actuation;
};

// The bend of a surface across the edge that the triangles (a, b, c) and (b, a, d) share, a hinge that
// resists the angle t between them [Bergou 2006]. With u and v the unit vectors from the edge to c and to d,
// both perpendicular to it, |u + v| = 2 sin(t/2). In the rest shape u + v is a sum of weight_i x_i, whose
// weights add up to 0 and stay as they are. The energy is stiffness (|u + v| - its rest value)^2 / 2: without
// force in the rest shape, linear in x where that is flat, and stiffness t^2 / 2 for small angles there.
struct Bend {
    int a = 0, b = 0, c = 0, d = 0;
    double stiffness = 0;  // N m
    double damping = 0;    // N m s
};

struct Triangle {
    int a = 0, b = 0, c = 0;  // anticlockwise seen from the front
};

// Binds a skin vertex to one simulated vertex.
struct SkinWeight {
    int vertex = 0;
    double weight = 0;  // may be negative
};

// A vertex of the skin lies at  sum of weight_k x_k + offset n,  n the unit normal of sum of weight_k n_k,
// with x and n of the simulated vertices. Weights add up to 1 and reproduce the position in the rest shape,
// so that every affine motion of the molecule carries the skin exactly.
struct SkinVertex {
    glm::dvec3 position{0};  // m, in the rest shape; follows from the weights (placeSkin), not in the file
    glm::dvec2 uv{0};
    std::vector<SkinWeight> weights;  // 1 to Skin::mostWeights
    double offset = 0;                // m, along the molecule's normal
};

struct SkinTriangle {
    int a = 0, b = 0, c = 0;  // anticlockwise seen from the front
};

// A finer mesh that is drawn in place of a molecule's triangles, and moves with its few simulated vertices.
// It costs the simulation nothing.
struct Skin {
    static constexpr int mostWeights = 8;
    std::vector<SkinVertex> vertices;
    std::vector<SkinTriangle> triangles;
    bool empty() const { return triangles.empty(); }
};

// How a molecule meets what is drawn behind it, with L the light that it sends, C its colour, o its opacity:
//   alpha           o L + (1 - o) behind        additive   o L + behind
//   multiplicative  (1 + o (C - 1)) behind, like a filter
enum class Blend { none, alpha, additive, multiplicative };
// How the molecules of a group with blend alpha come into the order from back to front.
//   frame   sorted anew in every frame       spread   sorted a little in every frame (Latta, section 3.4.4)
enum class DrawSort { none, frame, spread };
constexpr int mostSpreadFrames = 1000;  // of one whole sort

const char* name(Blend blend);
const char* name(DrawSort sort);
const std::vector<std::string>& blendWords();
const std::vector<std::string>& sortWords();

// How a molecule looks. Colours are linear RGB in [0, 1].
struct Material {
    glm::dvec3 color{0.8};
    std::optional<glm::dvec3> secondColor;  // instances vary between color and this one
    std::string texture;                    // PNG beside the molecule file; alpha cuts the shape out
    double alphaCut = 0.5;                  // texels below this alpha are not drawn
    double translucency = 0;                // share of light that shines through from behind, in [0, 1]
    double roughness = 0.7;                 // in [0, 1]
    double metallic = 0;                    // share of a mirror of the material's own colour, in [0, 1]
    double pointSize = 0.02;                // m, the diameter of a molecule without triangles
    Blend blend = Blend::none;
    double opacity = 1;               // in [0, 1]; with a blend
    DrawSort sort = DrawSort::frame;  // with blend alpha; the other blends need no order
    int spreadFrames = 20;            // with sort spread: frames of one whole sort
};

struct Molecule {
    std::string name;
    std::string comment;
    std::vector<Vertex> vertices;
    std::vector<Spring> springs;
    std::vector<Bend> bends;
    std::vector<Triangle> triangles;
    Skin skin;  // empty: the triangles themselves are drawn
    Material material;
    std::string file;  // where it was read from; empty when made in code

    // Where each element stands in the file, for messages; empty when made in code.
    struct Places {
        std::vector<Location> vertices, springs, bends, triangles;
    } places;

    double restLength(const Spring& spring) const {
        if (spring.restLength) return *spring.restLength;
        return glm::length(vertices[size_t(spring.a)].position - vertices[size_t(spring.b)].position);
    }
    // The largest rest distance between two vertices: the length that relative errors refer to. 1 for a
    // point.
    double size() const;
    double mass() const;  // kg, of all vertices
    bool hasPins() const;
};

// A spring between weighted means of vertices, of which Spring and Bend are kinds: with d the sum of weight_i
// x_i, the force on vertex i is weight_i times that of a Spring whose ends are d apart. Squares of the
// weights add up to 2, as those of a Spring, 1 and -1. As weights add up to 0, momentum is kept; as the force
// is along d, angular momentum is.
struct WeightedSpring {
    std::array<int, 4> vertices{};
    std::array<double, 4> weights{};  // of a bend's a, b, c and d
    int count = 0;                    // of its vertices
    double stiffness = 0;             // N/m
    double damping = 0;               // N s/m
    double restLength = 0;            // m; 0: a bend that is flat in the rest shape

    // The sum of weight_i values_i, of differences to the first, so that values far from 0 cancel without
    // loss.
    glm::dvec3 along(const std::vector<glm::dvec3>& values) const {
        const glm::dvec3& first = values[size_t(vertices[0])];
        glm::dvec3 out(0);
        for (size_t i = 1; i < size_t(count); ++i)
            out += weights[i] * (values[size_t(vertices[i])] - first);
        return out;
    }
};

WeightedSpring weighted(const Molecule& molecule, const Spring& spring);  // without its muscle
WeightedSpring weighted(const Molecule& molecule, const Bend& bend);
// Returns all springs, then all bends.
std::vector<WeightedSpring> weightedSprings(const Molecule& molecule);

const Description& describe(const Vertex*);
const Description& describe(const Actuation*);
const Description& describe(const Spring*);
const Description& describe(const Bend*);
const Description& describe(const Material*);
const Description& describe(const Molecule*);

}  // namespace shoal
