#include "geometry/close_holes.h"

#include <map>
#include <set>

namespace shoal {

namespace {

// The sides that no triangle passes the other way, turned to go on around the hole: from each welded vertex
// to the next. Vertices where several go on are left out.
std::map<int, int> bordersOf(const Mesh& mesh) {
    std::map<std::pair<int, int>, int> sides;
    for (const glm::ivec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            ++sides[{mesh.weld[size_t(t[i])], mesh.weld[size_t(t[(i + 1) % 3])]}];
    std::map<int, int> out;
    std::set<int> several;
    for (const auto& [side, count] : sides) {
        const auto other = sides.find({side.second, side.first});
        if (side.first == side.second || count <= (other == sides.end() ? 0 : other->second)) continue;
        if (!out.emplace(side.second, side.first).second) several.insert(side.second);
    }
    for (const int vertex : several)
        out.erase(vertex);
    return out;
}

}  // namespace

int closeHoles(Mesh& mesh, double mostArea) {
    std::map<int, int> next = bordersOf(mesh);
    std::vector<int> cornerOf(mesh.weldedPositions.size());
    for (size_t corner = 0; corner < mesh.weld.size(); ++corner)
        cornerOf[size_t(mesh.weld[corner])] = int(corner);
    const auto place = [&](int vertex) { return mesh.weldedPositions[size_t(vertex)]; };
    int holes = 0;
    while (!next.empty()) {
        std::vector<int> loop;
        int vertex = next.begin()->first;
        for (auto found = next.find(vertex); found != next.end(); found = next.find(vertex)) {
            loop.push_back(vertex);
            vertex = found->second;
            next.erase(found);
        }
        if (vertex != loop.front() || loop.size() < 3) continue;  // it does not come back
        glm::dvec3 middle(0);
        for (const int corner : loop)
            middle += place(corner) / double(loop.size());
        double area = 0;
        for (size_t i = 0; i < loop.size(); ++i)
            area += 0.5 * glm::length(glm::cross(place(loop[i]) - middle,
                                                 place(loop[(i + 1) % loop.size()]) - middle));
        if (area > mostArea) continue;
        const int centre = int(mesh.positions.size());
        const size_t like = size_t(cornerOf[size_t(loop.front())]);
        mesh.positions.push_back(middle);
        mesh.normals.push_back(glm::dvec3(0));
        if (!mesh.colors.empty()) mesh.colors.push_back(mesh.colors[like]);
        if (!mesh.uvs.empty()) mesh.uvs.push_back(mesh.uvs[like]);
        if (!mesh.bones.empty()) mesh.bones.push_back(mesh.bones[like]);
        for (size_t i = 0; i < loop.size(); ++i)
            mesh.triangles.emplace_back(cornerOf[size_t(loop[i])],
                                        cornerOf[size_t(loop[(i + 1) % loop.size()])], centre);
        ++holes;
    }
    if (holes > 0) completeMesh(mesh);
    return holes;
}

}  // namespace shoal
