#include "author/placed_mesh.h"

#include <algorithm>

#include "core/error.h"
#include "geometry/doubled_walls.h"

namespace shoal {

namespace {

// Vertices that no triangle has would stretch the box, and be taken for a part of the shape.
Mesh withoutStrays(Mesh mesh) {
    std::vector<int> number(mesh.positions.size(), -1);
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            number[size_t(t[i])] = 0;
    if (std::find(number.begin(), number.end(), -1) == number.end()) return mesh;
    size_t count = 0;
    for (size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0) continue;
        mesh.positions[count] = mesh.positions[v];
        mesh.normals[count] = mesh.normals[v];
        if (!mesh.colors.empty()) mesh.colors[count] = mesh.colors[v];
        if (!mesh.uvs.empty()) mesh.uvs[count] = mesh.uvs[v];
        if (!mesh.bones.empty()) mesh.bones[count] = mesh.bones[v];
        number[v] = int(count++);
    }
    mesh.positions.resize(count);
    mesh.normals.resize(count);
    mesh.colors.resize(std::min(mesh.colors.size(), count));
    mesh.uvs.resize(std::min(mesh.uvs.size(), count));
    mesh.bones.resize(std::min(mesh.bones.size(), count));
    for (glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            t[i] = number[size_t(t[i])];
    completeMesh(mesh);
    return mesh;
}

}  // namespace

Mesh placed(const Mesh& source, const FromMesh& options) {
    Mesh mesh = withoutStrays(source);
    if (options.forward) turnForward(mesh, *options.forward);
    const glm::dvec3 extent = mesh.high - mesh.low;
    const double longest = std::max({extent.x, extent.y, extent.z});
    if (!(longest > 0)) throw Error("all vertices of the mesh lie in one place");
    const double scale = options.size ? *options.size / longest : 1;
    const glm::dvec3 middle = 0.5 * (mesh.low + mesh.high);
    constexpr double farAway = 1000;  // sizes
    const bool tooFar = !options.centre && glm::length(middle) > farAway * longest;
    if (tooFar)
        mesh.notes.push_back(concat("the mesh lies ", glm::length(middle), " m from the origin, and is ",
                                    longest, " m long: its middle was put at the origin"));
    const glm::dvec3 origin = options.centre || tooFar ? middle : glm::dvec3(0);
    for (std::vector<glm::dvec3>* all : {&mesh.positions, &mesh.weldedPositions})
        for (glm::dvec3& p : *all)
            p = scale * (p - origin);
    mesh.low = scale * (mesh.low - origin);
    mesh.high = scale * (mesh.high - origin);
    const glm::dvec3 far = glm::max(glm::abs(mesh.low), glm::abs(mesh.high));
    if (std::max({far.x, far.y, far.z}) > 1e6)
        throw Error("the mesh reaches further than 1000 km from the origin: centre it, or give a size");
    return mesh;
}

Mesh withoutDoubledWalls(Mesh mesh) {
    const std::vector<char> doubled = doubledWalls(mesh);
    std::vector<glm::ivec3> kept;
    for (size_t t = 0; t < doubled.size(); ++t)
        if (!doubled[t]) kept.push_back(mesh.triangles[t]);
    if (kept.size() == mesh.triangles.size()) return mesh;
    mesh.triangles = std::move(kept);
    mesh.objects.clear();
    mesh.parts.clear();
    return mesh;
}

}  // namespace shoal
