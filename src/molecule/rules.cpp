#include "molecule/rules.h"

#include <algorithm>
#include <limits>

#include "molecule/molecule_file.h"
#include "molecule/skin_file.h"

namespace shoal {

namespace {

constexpr double leastMass = 1e-12, mostMass = 1e12;  // kg
constexpr double mostStiffness = 1e15;                // N/m, and N s/m
constexpr double leastLength = 1e-9;                  // m, below which two vertices stand in one place

constexpr double anySize = std::numeric_limits<double>::infinity();  // these limits are a molecule's own

bool isVertex(int index, const Molecule& molecule) {
    return index >= 0 && size_t(index) < molecule.vertices.size();
}

bool isMass(double mass) {
    return mass >= leastMass && mass <= mostMass;
}

bool isCoefficient(double value) {
    return value >= 0 && value <= mostStiffness;
}

void checkVertices(const Molecule& molecule, const Where& where) {
    if (molecule.vertices.empty())
        throw Error(where.at("vertices"), "expected at least one vertex, found none");
    needAtMost(where, "vertices", molecule.vertices.size(), maxMoleculeVertices);
    for (size_t i = 0; i < molecule.vertices.size(); ++i) {
        const Where here = where.in("vertices", i);
        const Vertex& vertex = molecule.vertices[i];
        members(CheckMembers(here, anySize), vertex);
        if (!isMass(vertex.mass)) checkMass(vertex.mass, here.at("mass"));
    }
}

void checkSprings(const Molecule& molecule, const Where& where) {
    needAtMost(where, "springs", molecule.springs.size(), maxMoleculeSprings);
    std::set<std::pair<int, int>> seen;
    for (size_t i = 0; i < molecule.springs.size(); ++i) {
        const Where here = where.in("springs", i);
        const Spring& spring = molecule.springs[i];
        checkEnds(spring, molecule, here);
        if (!isCoefficient(spring.stiffness)) checkCoefficient(spring.stiffness, here.at("stiffness"));
        if (!isCoefficient(spring.damping)) checkCoefficient(spring.damping, here.at("damping"));
        if (spring.actuation) {
            const Where muscle = here.in("actuation");
            members(CheckMembers(muscle, anySize), *spring.actuation);
        }
        checkLength(spring, molecule, here);
        checkNew(spring, seen, here);
    }
}

void checkTriangles(const Molecule& molecule, const Where& where) {
    needAtMost(where, "triangles", molecule.triangles.size(), maxMoleculeTriangles);
    for (size_t i = 0; i < molecule.triangles.size(); ++i) {
        const Where here = where.in("triangles", i);
        const Triangle& t = molecule.triangles[i];
        for (const int corner : {t.a, t.b, t.c})
            if (!isVertex(corner, molecule)) checkIndex(corner, molecule, here.here());
        if (t.a == t.b || t.b == t.c || t.c == t.a) checkCorners(t, here.here());
    }
}

}  // namespace

void checkMass(double mass, const Location& where) {
    needWithin(where, mass, Range::positive());
    if (!isMass(mass))
        throw Error(where, concat("expected a mass from ", leastMass, " to ", mostMass, " kg, found ", mass));
}

void checkCoefficient(double coefficient, const Location& where) {
    needWithin(where, coefficient, Range::atLeast(0));
    if (!isCoefficient(coefficient))
        throw Error(where, concat("expected a number of at most ", mostStiffness, ", found ", coefficient));
}

void checkIndex(int index, const Molecule& molecule, const Location& where) {
    const size_t count = molecule.vertices.size();
    if (!isVertex(index, molecule))
        throw Error(where, concat("vertex index ", index, " is out of range: the molecule has ", count,
                                  count == 1 ? " vertex" : " vertices"));
}

void checkEnds(const Spring& spring, const Molecule& molecule, const Where& where) {
    if (!isVertex(spring.a, molecule)) checkIndex(spring.a, molecule, where.at("a"));
    if (!isVertex(spring.b, molecule)) checkIndex(spring.b, molecule, where.at("b"));
    if (spring.a == spring.b)
        throw Error(where.at("b"),
                    concat("a spring needs two different vertices, found ", spring.a, " twice"));
}

void checkLength(const Spring& spring, const Molecule& molecule, const Where& where) {
    if (const std::optional<double>& length = spring.restLength) {
        if (!contains(Range::positive(), *length))
            needWithin(where.at("restLength"), *length, Range::positive());
        if (*length < leastLength || *length > maxCoordinate)
            throw Error(where.at("restLength"), concat("expected a length from ", leastLength, " to ",
                                                       maxCoordinate, " m, found ", *length));
    }
    if (molecule.restLength(spring) < leastLength)
        throw Error(where.here(), concat("this spring has no length: vertices ", spring.a, " and ", spring.b,
                                         " stand in the same place (move one, or give a restLength)"));
}

void checkNew(const Spring& spring, std::set<std::pair<int, int>>& seen, const Where& where) {
    if (!seen.insert(std::minmax(spring.a, spring.b)).second)
        throw Error(where.here(), concat("a spring between vertices ", spring.a, " and ", spring.b,
                                         " exists already: add up their stiffness instead"));
}

void checkCorners(const Triangle& t, const Location& where) {
    if (t.a == t.b || t.b == t.c || t.c == t.a)
        throw Error(where,
                    concat("a triangle needs three different vertices, found ", t.a, ", ", t.b, ", ", t.c));
}

void checkTexture(const Material& material, const Where& where) {
    if (material.texture.find('\0') != std::string::npos)
        throw Error(where.at("texture"), "expected a file name, found a zero byte in it");
}

void checkMolecule(const Molecule& molecule, const Where& where) {
    checkVertices(molecule, where);
    checkSprings(molecule, where);
    checkTriangles(molecule, where);
    checkSkin(molecule, where.in("skin"));
    const Where material = where.in("material");
    members(CheckMembers(material, anySize), molecule.material);
    checkTexture(molecule.material, material);
}

}  // namespace shoal
