#include "geometry/mesh_levels.h"

#include <algorithm>
#include <cmath>

#include <meshoptimizer.h>
#include <Eigen/Dense>

#include "geometry/closest_point.h"

namespace shoal {

namespace {

// Returns the positions with a bend along the thinnest direction, of a radius as large as the mesh.
std::vector<glm::vec3> bent(const std::vector<glm::dvec3>& positions) {
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : positions)
        middle += p / double(positions.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    double radius = 0;
    for (const glm::dvec3& p : positions) {
        const Eigen::Vector3d from(p.x - middle.x, p.y - middle.y, p.z - middle.z);
        spread += from * from.transpose();
        radius = std::max(radius, from.norm());
    }
    const Eigen::Vector3d thin =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);  // of the smallest
    const glm::dvec3 axis(thin.x(), thin.y(), thin.z());
    std::vector<glm::vec3> out;
    for (const glm::dvec3& p : positions) {
        const glm::dvec3 along = p - middle - glm::dot(p - middle, axis) * axis;
        const double lift = radius > 0 ? glm::dot(along, along) / (4 * radius) : 0;
        out.emplace_back(p - middle + lift * axis);
    }
    return out;
}

// Where on the triangle (a, b, c) a point of it lies: its shares of the corners.
glm::dvec3 sharesOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& p) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double all = glm::dot(normal, normal);
    if (!(all > 0)) return {1, 0, 0};
    const double toB = glm::dot(glm::cross(p - a, c - a), normal) / all;
    const double toC = glm::dot(glm::cross(b - a, p - a), normal) / all;
    return {1 - toB - toC, toB, toC};
}

// Returns the error by the normals, m.
double shadingError(const std::vector<glm::dvec3>& positions, const std::vector<glm::dvec3>& normals,
                    const std::vector<uint32_t>& corners) {
    Mesh level;
    level.weldedPositions = positions;
    for (size_t i = 0; i < positions.size(); ++i)
        level.weld.push_back(int(i));
    double edges = 0;
    for (size_t i = 0; i < corners.size(); i += 3) {
        level.triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
        edges += glm::distance(positions[corners[i]], positions[corners[i + 1]]);
    }
    const ClosestPoints nearest(level);
    constexpr size_t samples = 1000;
    double sum = 0, count = 0;
    for (size_t i = 0; i < positions.size(); i += positions.size() / samples + 1) {
        const ClosestPoint found = nearest.find(positions[i]);
        if (found.triangle < 0) continue;
        const glm::ivec3 t = level.triangles[size_t(found.triangle)];
        const auto place = [&](int k) { return positions[size_t(t[k])]; };
        const glm::dvec3 shares = sharesOf(place(0), place(1), place(2), found.point);
        glm::dvec3 normal(0);
        for (int k = 0; k < 3; ++k)
            normal += shares[k] * normals[size_t(t[k])];
        if (!(glm::length(normal) > 0)) continue;
        const glm::dvec3 off = glm::normalize(normal) - normals[i];
        sum += glm::dot(off, off);
        ++count;
    }
    return count > 0 ? std::sqrt(sum / count) * edges / double(level.triangles.size()) : 0;
}

}  // namespace

std::vector<uint32_t> collapseEdges(const std::vector<uint32_t>& corners,
                                    const std::vector<glm::vec3>& positions, size_t triangles,
                                    double* error) {
    std::vector<uint32_t> out(corners.size());
    constexpr float anyError = 1e10f;
    const auto* floats = &positions[0].x;
    float relative = 0;
    out.resize(meshopt_simplify(out.data(), corners.data(), corners.size(), floats, positions.size(),
                                sizeof(glm::vec3), std::min(3 * triangles, corners.size()), anyError, 0,
                                &relative));
    if (error)
        *error =
            double(relative) * double(meshopt_simplifyScale(floats, positions.size(), sizeof(glm::vec3)));
    return out;
}

std::vector<MeshLevel> levelsOf(const std::vector<glm::dvec3>& positions,
                                const std::vector<glm::dvec3>& normals,
                                const std::vector<uint32_t>& corners) {
    constexpr size_t fewest = 8;  // triangles
    constexpr double ratio = 0.4;
    std::vector<MeshLevel> out{{corners, 0}};
    const std::vector<glm::vec3> places = bent(positions);
    for (;;) {
        const size_t last = out.back().corners.size();
        MeshLevel level;
        level.corners =
            collapseEdges(corners, places, std::max(size_t(ratio * double(last / 3)), fewest), &level.error);
        constexpr double least = 0.7;  // of the triangles: above, another level saves nothing
        if (level.corners.empty() || double(level.corners.size()) > least * double(last)) return out;
        level.error =
            std::max({out.back().error, level.error, shadingError(positions, normals, level.corners)});
        out.push_back(std::move(level));
    }
}

}  // namespace shoal
