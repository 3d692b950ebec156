// Universal Scene Description as text (.usda): meshes, points and instances whose places are sampled in time,
// static models, a camera, and materials as UsdPreviewSurface. Metres, Y up.
//
// A stage is one file, or a folder of one file a frame behind NAME.usda that names them as value clips, for
// runs that are too large for one.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/file.h"
#include "exchange/drawn_mesh.h"

namespace shoal::exchange {

// A moving thing at one time. Arrays that are empty are not written.
struct UsdSample {
    std::vector<glm::dvec3> points;  // m; of instances their middles
    std::vector<glm::vec3> normals, velocities;
    std::vector<glm::quat> turns;   // of instances
    std::vector<uint32_t> corners;  // only where the number of molecules changes
    std::vector<glm::vec2> uvs;     // likewise
    std::vector<glm::vec3> colors;  // only where looks change
    std::vector<float> opacities;   // likewise
    std::vector<float> widths;      // likewise; m, of points
};

// How something moves.
struct UsdMoving {
    glm::dvec3 origin{0};      // m: samples are written relative to it, where places are far from 0
    bool changes = false;      // the number of molecules does: samples say corners and coordinates
    bool looksChange = false;  // samples say colours, opacities and widths
    // Scales of instances: each is the mesh, turned and moved; empty: there are none.
    std::vector<float> instances;
    std::vector<glm::vec3> colors;  // of instances, linear RGB, in place of the mesh's
};

class UsdStage {
  public:
    // `target`: a name that ends in .usda, or a folder. Images lie beside the file. Error: cannot be written.
    UsdStage(const std::filesystem::path& target, double frameRate);
    ~UsdStage();  // without finish(): none of its files stays

    // Adds a mesh that does not move.
    void add(const DrawnMesh& mesh);
    void add(const Camera& camera);
    // Adds something that moves, by its topology; without corners points. Returns its number.
    size_t addMoving(const DrawnMesh& mesh, const UsdMoving& how);
    void sample(size_t moving, int frame, const UsdSample& sample);  // frames in order
    void endFrame(int frame);
    // Error: disk full; no file of the stage is left.
    void finish();
    const std::vector<std::string>& written() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace shoal::exchange
