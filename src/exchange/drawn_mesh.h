// Meshes that other programs take of what a scene draws: skins or triangles of molecules, points, models.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "exchange/looks.h"
#include "geometry/mesh.h"
#include "molecule/skin.h"
#include "scene/scene.h"

namespace shoal::exchange {

// Arrays have a value a vertex, or are empty.
struct DrawnMesh {
    std::string name;
    glm::dvec3 origin{0};              // m, of the scene: what positions are relative to
    std::vector<glm::vec3> positions;  // m
    std::vector<glm::vec3> normals;    // unit
    std::vector<glm::vec2> uvs;        // (0, 0) lower left, as in molecules and models
    std::vector<glm::vec2>
        columns;  // second coordinates, (0, 0) upper left: where an animation texture is read
    std::vector<glm::vec3> colors;  // linear RGB in [0, 1]
    std::vector<float> opacities;   // multiply the material's
    std::vector<float> sizes;       // m, diameters of points
    std::vector<uint32_t> corners;  // three a triangle; empty: points

    // Corners that look alike; images are numbers in `images`.
    struct Piece {
        size_t first = 0, count = 0;
        SurfaceMaterial material;
    };
    std::vector<Piece> pieces;
    std::vector<Image> images;
};

// A group's molecules: which mesh each is drawn as, and where that lies when the molecule moves.
class GroupMesh {
  public:
    // Error: the material's image is missing or not a PNG.
    explicit GroupMesh(const Group& group);

    const std::string& name() const { return group_->name; }
    size_t verticesEach() const { return uvs_.size(); }
    bool points() const { return corners_.empty(); }
    bool looksChange() const { return exchange::looksChange(*group_); }

    // Adds a molecule, as large as it has grown, to `positions` (m, of the scene) and `normals`.
    void place(const MoleculeState& molecule, std::vector<glm::dvec3>& positions,
               std::vector<glm::vec3>& normals) const;
    // Adds its velocities (m/s), from the simulated vertices'; those of skins without what lifts them off
    // turning.
    void addVelocities(std::span<const glm::dvec3> simulated, std::vector<glm::vec3>& velocities) const;
    // Returns those molecules as one mesh, without positions and normals.
    DrawnMesh mesh(std::span<const MoleculeState> molecules) const;
    // As it is at rest, about the molecule's origin.
    std::vector<glm::dvec3> restPlaces() const;
    // Linear RGB.
    glm::vec3 colorOf(const MoleculeState& molecule) const { return looksOf(*group_, molecule).color; }

  private:
    const Group* group_;
    std::vector<uint32_t> corners_;
    std::vector<glm::vec2> uvs_;
    std::vector<SkinFrame> frames_;
    SurfaceMaterial material_;
    std::vector<Image> images_;
};

DrawnMesh modelMesh(const Model& model);

// A collider as it is drawn for an eye (m) at a time (s), which a plane's disc lies about; without positions:
// it shows as its model, or not at all.
DrawnMesh colliderMesh(const Collider& collider, const glm::dvec3& eye, double time);

// Columns: right, up, towards the eye.
glm::dmat3 directionsOf(const Camera& camera);

// A whole number of metres in the middle of positions that lie far from the origin, else 0: floats hold what
// is relative to it.
glm::dvec3 originOf(const std::vector<glm::dvec3>& positions);

// Fills a mesh's origin and positions.
void recentre(DrawnMesh& mesh, const std::vector<glm::dvec3>& positions);

}  // namespace shoal::exchange
