// The meshes by which the error in space is measured: thin and long, clamped at one end.
#pragma once

#include <cmath>
#include <functional>

#include "unit/from_mesh.h"

namespace shoal::test {

// Flat, along +Z from 0 to `length`; `half(s)`: half its width, m, at the share s of its length.
inline Mesh flatMesh(double length, int along, int across, const std::function<double(double)>& half) {
    Mesh mesh;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i <= across; ++i) {
            const double s = double(j) / along;
            mesh.positions.emplace_back(half(s) * (2.0 * i / across - 1), 0, length * s);
            mesh.uvs.emplace_back(double(i) / across, s);
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < across; ++i) {
            const int a = j * (across + 1) + i, b = a + across + 1;
            mesh.triangles.push_back({a, b, a + 1});
            mesh.triangles.push_back({a + 1, b, b + 1});
        }
    completeMesh(mesh);
    return mesh;
}

// A sheet of 200 by 50 mm.
inline Mesh sheetMesh() {
    return flatMesh(0.2, 80, 20, [](double) { return 0.025; });
}

// A leaf of 120 by 50 mm on a stalk of 6 mm.
inline Mesh leafMesh() {
    return flatMesh(0.12, 96, 20, [](double s) {
        return std::max(0.003 * (1 - s),
                        0.025 * std::pow(std::sin(std::numbers::pi * std::pow(s, 0.8)), 0.8));
    });
}

// Round, along +Z, 200 mm by 20 mm.
inline Mesh rodMesh() {
    Mesh mesh;
    constexpr int around = 32, along = 80;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            mesh.positions.emplace_back(0.01 * std::cos(angle), 0.01 * std::sin(angle), 0.2 * j / along);
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = around * j + i, b = around * j + (i + 1) % around;
            mesh.triangles.push_back({a, b, b + around});
            mesh.triangles.push_back({a, b + around, a + around});
        }
    for (const int end : {0, along}) {
        const int first = around * end, middle = int(mesh.positions.size());
        mesh.positions.emplace_back(0, 0, 0.2 * end / along);
        for (int i = 0; i < around; ++i) {
            const int a = first + i, b = first + (i + 1) % around;
            mesh.triangles.push_back(end == 0 ? glm::ivec3(middle, b, a) : glm::ivec3(middle, a, b));
        }
    }
    completeMesh(mesh);
    return mesh;
}

}  // namespace shoal::test
