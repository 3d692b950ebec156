// A molecule in the words of its file: the rules by which it is valid, its JSON, and the key "skin"
// (skin_file.cpp). Its reader holds files to these rules, and compile() molecules made in code.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/where.h"
#include "molecule/molecule.h"

namespace shoal {

// Sizes that single precision on the GPU can square and add without overflow.
constexpr double maxCoordinate = 1e6;                     // m
constexpr double mostFrequency = 1e6;                     // Hz
constexpr double leastLength = 1e-9;                      // m, below which two vertices stand in one place
const Range coefficientLimits = Range::between(0, 1e15);  // stiffness and damping

// Errors, each at what is wrong.
void checkIndex(int index, const Molecule& molecule, const Where& where);
void checkCorners(const Triangle& triangle, const Where& where);  // three different ones

void checkBends(const Molecule& molecule, const Where& where);

// All of it, with its skin.
void checkMolecule(const Molecule& molecule, const Where& where);

// The key "defaults" of its file.
const Description& describeDefaults();

// The number that most elements have, the least of several, and how many have it; 0: there are no elements.
template <typename Element>
std::pair<double, int> commonest(const std::vector<Element>& elements, double Element::*number) {
    std::map<double, int> counts;
    for (const Element& element : elements)
        ++counts[element.*number];
    std::pair<double, int> best{0, 0};
    for (const auto& [value, count] : counts)
        if (count > best.second) best = {value, count};
    return best;
}

// `spelled`: every vertex and spring says its own mass, stiffness and damping, and there are no defaults.
JsonValue toJson(const Molecule& molecule, bool spelled);

// The key "skin" of its file. Positions are not in the file: they follow from the weights and the molecule's
// rest shape.
const Description& describeSkin();
// After the molecule's vertices and triangles. Error: located.
void readSkin(JsonReader& root, Molecule& molecule);
// Applies the reader's rules to a skin that was made in code.
void checkSkin(const Molecule& molecule, const Where& where);

}  // namespace shoal
