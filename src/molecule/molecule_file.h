// Molecule files: strict JSON in the format "shoal-molecule-1" (molecules/molecule.schema.json).
//
//   { "format": "shoal-molecule-1", "name": "pair",
//     "defaults": { "mass": 0.1, "stiffness": 50, "damping": 0.1 },
//     "vertices":  [ { "position": [0, 0, 0], "uv": [0, 0], "pinned": true }, { "position": [1, 0, 0] } ],
//     "springs":   [ { "a": 0, "b": 1, "restLength": 1,
//                      "actuation": { "amplitude": 0.2, "frequency": 2, "phase": 0 } } ],
//     "bends":     [ { "a": 0, "b": 1, "c": 2, "d": 3, "stiffness": 1e-4 } ],
//     "triangles": [],
//     "skin":      { "weights": [[0, 0.5, 1, 0.5], ...], "uvs": [[0, 0], ...], "triangles": [[0, 1, 2]] },
//     "material":  { "color": [0.2, 0.5, 0.1], "texture": "leaf.png" } }
//
// Metres, kilograms, N/m, N s/m; of bends N m, N m s. A vertex needs a mass and a spring a stiffness, its own
// or from the defaults; damping is 0 and restLength the drawn distance unless given.
#pragma once

#include <string>

#include "core/image.h"
#include "molecule/molecule.h"

namespace shoal {

constexpr int maxMoleculeVertices = 65536;
constexpr int maxMoleculeSprings = 1 << 20;  // and bends
constexpr int maxMoleculeTriangles = 1 << 20;
constexpr int maxSkinVertices = 1 << 18;
constexpr int maxSkinTriangles = 1 << 19;

// Error: located, for whatever is missing, mistyped, out of range, repeated or unknown.
Molecule readMolecule(const std::string& file);
Molecule parseMolecule(const std::string& text, const std::string& file);

// The image that the material names, beside the molecule's file.
// Error: none such, or no PNG; located at the molecule's key.
Image readTexture(const Molecule& molecule);

// Reads back as the same molecule. Defaults carry the mass, stiffness and damping that most elements share.
std::string writeMolecule(const Molecule& molecule);

}  // namespace shoal
