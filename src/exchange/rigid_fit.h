// A group's molecules as one shape at rest that turns and moves.
#pragma once

#include <vector>

#include "exchange/animation_texture.h"
#include "exchange/drawn_mesh.h"

namespace shoal::exchange {

class RigidFit {
  public:
    // `scales`: of `count` molecules, or empty for those that are as large as the mesh.
    RigidFit(const GroupMesh& mesh, std::vector<float> scales, int count);

    // Returns the rigid motion that brings the rest shape nearest to the drawn molecule m.
    RigidMotion motion(size_t m, const std::vector<glm::dvec3>& places);

    const std::vector<glm::dvec3>& rest() const { return rest_; }  // m, about its middle
    const std::vector<glm::vec3>& normals() const { return normals_; }
    const std::vector<float>& scales() const { return scales_; }
    double worst() const { return worst_; }  // m, how far a place lay off at the most

  private:
    std::vector<glm::dvec3> rest_;
    std::vector<glm::vec3> normals_;
    std::vector<float> scales_;
    double worst_ = 0;
};

}  // namespace shoal::exchange
