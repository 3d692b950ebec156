#include "author/mass_spread.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace shoal {

namespace {

class Gather {
  public:
    explicit Gather(size_t vertices) : shares_(vertices, 0) {}
    void add(const glm::dvec3& place, double amount, size_t vertex) {
        const Eigen::Vector3d p(place.x, place.y, place.z);
        total_ += amount;
        first_ += amount * p;
        second_ += amount * p * p.transpose();
        shares_[vertex] += amount;
    }
    MassSpread finish() {
        MassSpread out;
        const Eigen::Vector3d middle = first_ / total_;
        const Eigen::Matrix3d spread = second_ / total_ - middle * middle.transpose();
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
        const Eigen::Vector3d axis = solver.eigenvectors().col(2), thin = solver.eigenvectors().col(0);
        const Eigen::Vector3d& values = solver.eigenvalues();
        constexpr double alike = 0.9;
        out.axis = {axis.x(), axis.y(), axis.z()};
        out.thin = {thin.x(), thin.y(), thin.z()};
        if (values(1) > alike * values(2)) out.axis = axisAcross(out.thin);
        out.gyration = std::sqrt(std::max(0.0, solver.eigenvalues()(0)));
        // no vertex is so light that it would need short steps
        constexpr double least = 0.15;  // of the mean
        const double floor = least * total_ / double(shares_.size());
        double sum = 0;
        for (double& share : shares_)
            sum += share = std::max(share, floor);
        for (const double share : shares_)
            out.shares.push_back(share / sum);
        return out;
    }

  private:
    // An axis of the file, turned into the plane across `thin`.
    static glm::dvec3 axisAcross(const glm::dvec3& thin) {
        int least = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (std::abs(thin[axis]) < std::abs(thin[least])) least = axis;
        glm::dvec3 out(0);
        out[least] = 1;
        return glm::normalize(out - glm::dot(out, thin) * thin);
    }

    std::vector<double> shares_;
    double total_ = 0;
    Eigen::Vector3d first_ = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

size_t nearestTo(const std::vector<glm::dvec3>& places, const glm::dvec3& point) {
    size_t best = 0;
    for (size_t i = 1; i < places.size(); ++i)
        if (glm::distance(places[i], point) < glm::distance(places[best], point)) best = i;
    return best;
}

}  // namespace

MassSpread spreadOfBody(const CoarseMesh& coarse, const Inside& inside) {
    Gather gather(coarse.positions.size());
    for (const glm::dvec3& sample : inside.samples())
        gather.add(sample, 1, nearestTo(coarse.positions, sample));
    return gather.finish();
}

// `vertexOf(welded)` is the coarse vertex that a vertex stands with.
template <typename VertexOf>
static MassSpread spreadOfTriangles(const Mesh& mesh, size_t vertices, const VertexOf& vertexOf) {
    Gather gather(vertices);
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[size_t(t.x)], &b = mesh.positions[size_t(t.y)],
                         &c = mesh.positions[size_t(t.z)];
        const double third = glm::length(glm::cross(b - a, c - a)) / 6;
        for (int i = 0; i < 3; ++i) {
            const int welded = mesh.weld[size_t(t[i])];
            // where the exact second moments of a triangle lie: half way to the middle
            const glm::dvec3 place = 0.5 * mesh.positions[size_t(t[i])] + (a + b + c) / 6.0;
            gather.add(place, third, vertexOf(size_t(welded)));
        }
    }
    return gather.finish();
}

MassSpread spreadOfSheet(const Mesh& mesh) {
    return spreadOfTriangles(mesh, 1, [](size_t) { return size_t{0}; });
}

MassSpread spreadOfSheet(const Mesh& mesh, const CoarseMesh& coarse) {
    return spreadOfTriangles(mesh, coarse.positions.size(),
                             [&](size_t welded) { return size_t(coarse.map[welded]); });
}

double extentAlong(const Mesh& mesh, const glm::dvec3& axis) {
    double low = 1e300, high = -1e300;
    for (const glm::dvec3& p : mesh.weldedPositions) {
        low = std::min(low, glm::dot(p, axis));
        high = std::max(high, glm::dot(p, axis));
    }
    return high - low;
}

}  // namespace shoal
