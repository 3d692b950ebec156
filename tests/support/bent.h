// A closed mesh of many triangles, and what happens to it when it is bent or twisted.
#pragma once

#include <cmath>
#include <numbers>

#include "geometry/mesh.h"

namespace shoal::test {

// A closed, smooth mesh of 2 sides (rows - 1) triangles: a belly, a narrow neck and a knob; 1.2 m along z.
inline Mesh club(int sides, int rows) {
    Mesh mesh;
    const auto point = [&](double t, double angle) {
        const double radius =
            std::pow(std::sin(std::numbers::pi * t), 0.7) *
            (0.20 + 0.09 * std::cos(5.5 * t) + 0.02 * std::cos(3 * angle) * std::sin(9 * t));
        return glm::dvec3(radius * std::cos(angle), 0.7 * radius * std::sin(angle) + 0.05 * std::sin(4 * t),
                          1.2 * (0.5 - t));
    };
    for (int row = 1; row < rows; ++row)
        for (int side = 0; side < sides; ++side)
            mesh.positions.push_back(point(double(row) / rows, 2 * std::numbers::pi * side / sides));
    const int first = int(mesh.positions.size()), last = first + 1;
    mesh.positions.push_back(point(0, 0));
    mesh.positions.push_back(point(1, 0));
    for (int side = 0; side < sides; ++side) {
        const int next = (side + 1) % sides;
        for (int row = 0; row + 2 < rows; ++row) {
            const int a = row * sides + side, b = row * sides + next;
            mesh.triangles.push_back({a, a + sides, b});
            mesh.triangles.push_back({b, a + sides, b + sides});
        }
        const int end = (rows - 2) * sides;
        mesh.triangles.push_back({first, side, next});
        mesh.triangles.push_back({last, end + next, end + side});
    }
    mesh.objects = {{"club", 0, int(mesh.triangles.size())}};
    completeMesh(mesh);
    return mesh;
}

// The axis along z becomes an arc in the xz plane: `angle` rad from one end to the other, `length` m long.
inline glm::dvec3 bent(const glm::dvec3& p, double angle, double length) {
    const double radius = length / angle, turn = p.z / radius;
    return {radius - (radius - p.x) * std::cos(turn), p.y, (radius - p.x) * std::sin(turn)};
}

inline glm::dvec3 twisted(const glm::dvec3& p, double angle, double length) {
    const double turn = angle * p.z / length, c = std::cos(turn), s = std::sin(turn);
    return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

// How far a skin is from the shape that it should have.
struct SkinFigures {
    int flipped = 0;         // triangles that face away from where they should
    double volumeError = 0;  // relative
    double distance = 0;     // m, of a vertex from its place, at most
};

inline SkinFigures compareSkin(const std::vector<glm::dvec3>& skin, const std::vector<glm::dvec3>& shape,
                               const std::vector<glm::ivec3>& triangles) {
    SkinFigures out;
    double volume = 0, wanted = 0;
    for (const glm::ivec3& t : triangles) {
        const auto area = [&](const std::vector<glm::dvec3>& at) {
            return glm::cross(at[size_t(t.y)] - at[size_t(t.x)], at[size_t(t.z)] - at[size_t(t.x)]);
        };
        if (glm::dot(area(skin), area(shape)) <= 0) ++out.flipped;
        volume += glm::dot(area(skin), skin[size_t(t.x)]) / 6;
        wanted += glm::dot(area(shape), shape[size_t(t.x)]) / 6;
    }
    out.volumeError = std::abs(volume / wanted - 1);
    for (size_t i = 0; i < skin.size(); ++i)
        out.distance = std::max(out.distance, glm::distance(skin[i], shape[i]));
    return out;
}

}  // namespace shoal::test
