// The key "skin" of a molecule file:
//
//   "skin": { "weights":   [[vertex, weight, vertex, weight, ...], ...],   one array a vertex of the skin
//             "uvs":       [[u, v], ...],                                  as many; all (0, 0) when absent
//             "offsets":   [m, ...],                                       as many; all 0 when absent
//             "triangles": [[a, b, c], ...] }                              vertices of the skin
//
// Positions are not in the file: they follow from the weights and the molecule's rest shape.
#pragma once

#include "core/where.h"
#include "molecule/molecule.h"

namespace shoal {

constexpr int maxSkinVertices = 1 << 18;
constexpr int maxSkinTriangles = 1 << 19;

extern const char* const skinSchema;  // the JSON Schema of its value

// After the molecule's vertices and triangles. Error: located.
void readSkin(JsonReader& root, Molecule& molecule);
// Applies the reader's rules to a skin that was made in code.
void checkSkin(const Molecule& molecule, const Where& where);
JsonValue skinJson(const Skin& skin);

}  // namespace shoal
