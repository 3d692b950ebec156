// Bends: their weights, the rules by which they are valid, their keys.
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "core/describe.h"
#include "molecule/molecule_json.h"

namespace shoal {

WeightedSpring weighted(const Molecule& molecule, const Spring& spring) {
    return {.vertices = {spring.a, spring.b},
            .weights = {1, -1},
            .count = 2,
            .stiffness = spring.stiffness,
            .damping = spring.damping,
            .restLength = molecule.restLength(spring)};
}

WeightedSpring weighted(const Molecule& molecule, const Bend& bend) {
    constexpr double flat = 1e-6;  // rad, of the fold that positions in decimals leave by rounding
    const auto place = [&](int vertex) { return molecule.vertices[size_t(vertex)].position; };
    const glm::dvec3 a = place(bend.a), edge = place(bend.b) - a;
    WeightedSpring out{.vertices = {bend.a, bend.b, bend.c, bend.d}, .count = 4};
    glm::dvec3 sum(0);  // u + v
    for (const size_t i : {size_t{2}, size_t{3}}) {
        const glm::dvec3 arm = place(out.vertices[i]) - a;
        const double share = glm::dot(arm, edge) / glm::dot(edge, edge);  // of the edge, where its foot is
        const glm::dvec3 across = arm - share * edge;
        const double height = glm::length(across);
        sum += across / height;
        out.weights[i] = 1 / height;
        out.weights[0] -= (1 - share) / height;
        out.weights[1] -= share / height;
    }
    double squares = 0;
    for (const double weight : out.weights)
        squares += weight * weight;
    const double unit = std::sqrt(2 / squares);  // m, of |u + v| = 1
    for (double& weight : out.weights)
        weight *= unit;
    out.stiffness = bend.stiffness / (unit * unit);
    out.damping = bend.damping / (unit * unit);
    const double fold = glm::length(sum);
    out.restLength = fold > flat ? unit * fold : 0;
    return out;
}

std::vector<WeightedSpring> weightedSprings(const Molecule& molecule) {
    std::vector<WeightedSpring> out;
    out.reserve(molecule.springs.size() + molecule.bends.size());
    for (const Spring& spring : molecule.springs)
        out.push_back(weighted(molecule, spring));
    for (const Bend& bend : molecule.bends)
        out.push_back(weighted(molecule, bend));
    return out;
}

namespace {

void checkCorners(const Bend& bend, const Molecule& molecule, const Where& where) {
    const std::array<std::pair<const char*, int>, 4> corners = {
        std::pair("a", bend.a), {"b", bend.b}, {"c", bend.c}, {"d", bend.d}};
    for (size_t i = 0; i < corners.size(); ++i) {
        const auto [key, vertex] = corners[i];
        checkIndex(vertex, molecule, where.in(key));
        for (size_t j = 0; j < i; ++j)
            if (corners[j].second == vertex)
                throw Error(where.locate(key), "a bend needs four different vertices, found ", vertex,
                            " twice");
    }
}

// A bend needs an edge to bend across, and two triangles that have an angle between them.
void checkShape(const Bend& bend, const Molecule& molecule, const Where& where) {
    constexpr double leastHeight = 1e-6;  // of the edge
    const auto place = [&](int vertex) { return molecule.vertices[size_t(vertex)].position; };
    const glm::dvec3 edge = place(bend.b) - place(bend.a);
    const double length = glm::length(edge);
    if (length < leastLength)
        throw Error(where.here(), "this bend has no edge: vertices ", bend.a, " and ", bend.b,
                    " stand in the same place (move one)");
    for (const auto& [key, vertex] : {std::pair("c", bend.c), std::pair("d", bend.d)}) {
        const double height = glm::length(glm::cross(edge, place(vertex) - place(bend.a))) / length;
        if (height < std::max(leastLength, leastHeight * length))
            throw Error(where.locate(key), "the triangle of vertices ", bend.a, ", ", bend.b, " and ", vertex,
                        " has no area: a bend needs two triangles at its edge");
    }
}

// `seen`: the bends before, each of its edge and its other two vertices.
void checkNew(const Bend& bend, std::set<std::array<int, 4>>& seen, const Where& where) {
    const auto [a, b] = std::minmax(bend.a, bend.b);
    const auto [c, d] = std::minmax(bend.c, bend.d);
    if (!seen.insert({a, b, c, d}).second)
        throw Error(where.here(), "a bend of vertices ", bend.c, " and ", bend.d, " across ", bend.a, "-",
                    bend.b, " exists already: add up their stiffness instead");
}

}  // namespace

void checkBends(const Molecule& molecule, const Where& where) {
    std::set<std::array<int, 4>> seen;
    for (size_t i = 0; i < molecule.bends.size(); ++i) {
        const Where here = where.in("bends", i);
        checkCorners(molecule.bends[i], molecule, here);
        checkShape(molecule.bends[i], molecule, here);
        checkNew(molecule.bends[i], seen, here);
    }
}

const Description& describe(const Bend*) {
    static const Description description =
        Describe<Bend>("bend",
                       "A hinge that resists the bending of two triangles across the edge that they share.")
            .key("a", &Bend::a, {"", "The index of the vertex at one end of the edge."})
            .needed()
            .key("b", &Bend::b, {"", "The index of the vertex at its other end."})
            .needed()
            .key("c", &Bend::c, {"", "The index of the vertex opposite the edge in one triangle."})
            .needed()
            .key("d", &Bend::d, {"", "The index of the vertex opposite the edge in the other triangle."})
            .needed()
            .key("stiffness", &Bend::stiffness,
                 {"N m", "Its stiffness: torque a radian of the angle beyond that of the rest shape.",
                  coefficientLimits})
            .needed()
            .key("damping", &Bend::damping,
                 {"N m s", "Its damping: torque a radian a second.", coefficientLimits})
            .rule([](const Bend&, const Where&) {},
                  R"({"properties": {"a": {"minimum": 0}, "b": {"minimum": 0},
                                     "c": {"minimum": 0}, "d": {"minimum": 0}}})");
    return description;
}

}  // namespace shoal
