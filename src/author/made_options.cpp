// What is refused of the options of makeMolecule() before any work.
#include "author/from_mesh.h"
#include "core/error.h"

namespace shoal {

void checkOptions(const FromMesh& o) {
    const auto above = [](const char* what, const std::optional<double>& value, double most,
                          const char* unit) {
        if (value && !(*value > 0 && *value <= most))
            throw Error(what, ": expected a number above 0, at most ", most, unit, ", found ", *value);
    };
    above("size", o.size, 1e5, " m");
    above("mass", o.mass, 1e9, " kg");
    above("density", o.density, 1e5, " kg/m^3");
    above("modulus", o.modulus, 1e12, " Pa");
    above("thickness", o.thickness, 1, " m");
    above("frequency", o.frequency, 1e5, " Hz");
    if (o.damping && !(*o.damping >= 0 && *o.damping <= 2))
        throw Error("damping: expected a ratio from 0 to 2, found ", *o.damping);
    if (!o.material.empty()) {
        try {
            scaledMaterial(o.material);
        } catch (const Error& error) {
            throw Error("material: ", error.message());
        }
    }
    if (o.frequency && (o.modulus || o.thickness))
        throw Error("frequency: expected either a frequency or a ", o.modulus ? "modulus" : "thickness",
                    ", found both");
    if (o.mass && o.density) throw Error("mass: expected either a mass or a density, found both");
    const int64_t asked = o.rings ? 4 * int64_t(*o.rings) : o.vertices.value_or(usualMadeVertices);
    if (o.skinTriangles && *o.skinTriangles < 4)
        throw Error("skin-triangles: expected at least 4, found ", *o.skinTriangles);
    if (o.skinTriangles && !o.skin)
        throw Error("skin-triangles: expected either triangles of the skin or no skin, found both");
    if (o.rings && *o.rings < 2) throw Error("rings: expected at least 2, found ", *o.rings);
    if (!o.rings && asked < leastMadeVertices)
        throw Error("vertices: expected at least ", leastMadeVertices, ", found ", asked);
    if (asked > mostMadeVertices)
        throw Error(o.rings ? "rings" : "vertices", ": a molecule of ", asked,
                    " vertices takes too long to make: at most ", mostMadeVertices,
                    o.rings ? concat(", which are ", mostMadeVertices / 4, " rings") : "");
    if (o.rings && (o.springs == FromMesh::Springs::lattice || o.springs == FromMesh::Springs::cage))
        throw Error("rings: expected either rings or a ",
                    o.springs == FromMesh::Springs::cage ? "cage" : "lattice", ", found both");
}

}  // namespace shoal
