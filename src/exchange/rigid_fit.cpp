#include "exchange/rigid_fit.h"

#include <algorithm>

namespace shoal::exchange {

RigidFit::RigidFit(const GroupMesh& mesh, std::vector<float> scales, int count) : scales_(std::move(scales)) {
    scales_.resize(size_t(count), 1);
    const std::vector<glm::dvec3> places = mesh.restPlaces();
    mesh.place({places, {}}, rest_, normals_);
    glm::dvec3 middle(0);
    for (const glm::dvec3& x : rest_)
        middle += x / double(rest_.size());
    for (glm::dvec3& x : rest_)
        x -= middle;
}

RigidMotion RigidFit::motion(size_t m, const std::vector<glm::dvec3>& places) {
    std::vector<glm::dvec3> scaled;
    for (const glm::dvec3& x : rest_)
        scaled.push_back(double(scales_[m]) * x);
    const RigidMotion out = rigidMotion(scaled, places);
    worst_ = std::max(worst_, out.worst);
    return out;
}

}  // namespace shoal::exchange
