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

// The JSON Schema of its value.
inline constexpr const char* skinSchema = R"({"type": "object", "additionalProperties": false,
    "required": ["weights", "triangles"], "properties": {
        "comment": {"$ref": "#/$defs/comment"},
        "weights": {"description": "For each vertex of the skin: a vertex of the molecule and its weight, up to 8 times; the weights add up to 1.",
            "type": "array", "maxItems": 262144,
            "items": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 16}},
        "uvs": {"description": "Texture coordinates, as many; all (0, 0) when absent.",
            "type": "array", "maxItems": 262144,
            "items": {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}},
        "offsets": {"description": "How far each stands off along the molecule's normal, as many; all 0 when absent. [m]",
            "type": "array", "maxItems": 262144, "items": {"type": "number"}},
        "triangles": {"description": "Three vertices of the skin each, anticlockwise seen from the front.",
            "type": "array", "minItems": 1, "maxItems": 524288,
            "items": {"type": "array", "items": {"type": "integer", "minimum": 0}, "minItems": 3, "maxItems": 3}}}})";

// After the molecule's vertices and triangles. Error: located.
void readSkin(JsonReader& root, Molecule& molecule);
// The same rules for one that was made in code.
void checkSkin(const Molecule& molecule, const Where& where);
JsonValue skinJson(const Skin& skin);

}  // namespace shoal
