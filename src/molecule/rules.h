// What makes a molecule valid. Its reader holds files to it, and compile() what was made in code.
#pragma once

#include <set>
#include <utility>

#include "core/members.h"
#include "molecule/molecule.h"

namespace shoal {

// Sizes that single precision on the GPU can square and add without overflow.
constexpr double maxCoordinate = 1e6;  // m
constexpr double mostFrequency = 1e6;  // Hz

template <typename V>
void members(V&& v, Either<Vertex> auto& vertex) {
    v.number("position", vertex.position, Range::between(-maxCoordinate, maxCoordinate));
    v.number("uv", vertex.uv, Range::between(-maxCoordinate, maxCoordinate));
}

template <typename V>
void members(V&& v, Either<Actuation> auto& muscle) {
    v.number("amplitude", muscle.amplitude, Range::between(0, 0.99));
    v.number("frequency", muscle.frequency, Range::between(0, mostFrequency));
    v.number("phase", muscle.phase, Range::between(-maxCoordinate, maxCoordinate));
}

template <typename V>
void members(V&& v, Either<Material> auto& material) {
    const Range unit = Range::between(0, 1);
    v.number("color", material.color, unit);
    v.number("secondColor", material.secondColor, unit);
    v.number("alphaCut", material.alphaCut, unit);
    v.number("translucency", material.translucency, unit);
    v.number("roughness", material.roughness, unit);
    v.number("metallic", material.metallic, unit);
    v.number("pointSize", material.pointSize, Range{0, maxCoordinate, true});
    v.number("opacity", material.opacity, unit);
    v.word("blend", material.blend, {"none", "alpha", "additive", "multiplicative"});
    v.word("sort", material.sort, {"none", "frame", "spread"});
    v.number("spreadFrames", material.spreadFrames, Range::between(1, mostSpreadFrames));
}

// Errors, each at what is wrong.
void checkMass(double mass, const Location& where);                // kg
void checkCoefficient(double coefficient, const Location& where);  // N/m, and N s/m
void checkEnds(const Spring& spring, const Molecule& molecule, const Where& where);
void checkLength(const Spring& spring, const Molecule& molecule, const Where& where);
// `seen`: the ends of the springs before.
void checkNew(const Spring& spring, std::set<std::pair<int, int>>& seen, const Where& where);
void checkIndex(int index, const Molecule& molecule, const Location& where);
void checkCorners(const Triangle& triangle, const Location& where);  // three different ones
void checkTexture(const Material& material, const Where& where);

// All of it, with its skin.
void checkMolecule(const Molecule& molecule, const Where& where);

}  // namespace shoal
