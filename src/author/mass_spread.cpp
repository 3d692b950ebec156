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
        const Eigen::Vector3d axis = solver.eigenvectors().col(2);
        out.axis = {axis.x(), axis.y(), axis.z()};
        out.gyration = std::sqrt(std::max(0.0, solver.eigenvalues()(0)));
        // no vertex is so light that it would need short steps
        constexpr double least = 0.4;  // of the mean
        const double floor = least * total_ / double(shares_.size());
        double sum = 0;
        for (double& share : shares_)
            sum += share = std::max(share, floor);
        for (const double share : shares_)
            out.shares.push_back(share / sum);
        return out;
    }

  private:
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

MassSpread spreadOfSheet(const Mesh& mesh, const CoarseMesh& coarse) {
    Gather gather(coarse.positions.size());
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3 &a = mesh.positions[size_t(t.x)], &b = mesh.positions[size_t(t.y)],
                         &c = mesh.positions[size_t(t.z)];
        const double third = glm::length(glm::cross(b - a, c - a)) / 6;
        for (int i = 0; i < 3; ++i) {
            const int welded = mesh.weld[size_t(t[i])];
            // where the exact second moments of a triangle lie: half way to the middle
            const glm::dvec3 place = 0.5 * mesh.positions[size_t(t[i])] + (a + b + c) / 6.0;
            gather.add(place, third, size_t(coarse.map[size_t(welded)]));
        }
    }
    return gather.finish();
}

}  // namespace shoal
