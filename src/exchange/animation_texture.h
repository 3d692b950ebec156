// Vertex animation textures: an image in which a row is a moment and a column a vertex, which a shader of a
// game engine reads instead of simulating. The layout is OpenVAT's (openvat.org), with one row a frame and
// normals packed:
//
//   rows 0 to F - 1, from the top   how far the vertex lies from the mesh, in [0, 1] between Min and Max
//   rows F to 2F - 1                its normal, 0.5 + 0.5 n
//   NAME-remap_info.json            Min, Max (m) and F
//
// Vectors are in Blender's axes, as OpenVAT's are: x, -z and y of ours. The mesh's second texture coordinates
// are the middle of its column in the first row.
//
// A rigid texture has a column a molecule: rows 0 to F - 1 say where its middle lies (m, between Min and
// Max), rows F to 2F - 1 its rotation as a quaternion x, y, z, w, 0.5 + 0.5 q, all in our axes. The mesh has
// every molecule as it is at rest, about its middle.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/gtc/quaternion.hpp>

#include "core/file.h"

namespace shoal::exchange {

enum class TexelFormat {
    png16,      // 16 bits a channel
    halfFloat,  // OpenEXR
    wholeFloat
};

// Between two numbers that a texel tells apart, by the span of all; of floats near the upper end.
constexpr double texelStep(TexelFormat format) {
    return format == TexelFormat::png16 ? 1.0 / 65535 : format == TexelFormat::halfFloat ? 0x1p-11 : 0x1p-24;
}

// The values of a frame: one a column each.
struct AnimationFrame {
    std::vector<glm::vec3> offsets;  // m
    std::vector<glm::vec4> turns;    // normals, w 0; or quaternions x, y, z, w
};

// Gathers frames in a file, so that none stays in memory, and writes the image once all bounds are known.
class AnimationTexture {
  public:
    static constexpr size_t mostColumns = 16384, mostRows = 16384;

    // `columns` at most mostColumns. Error: `target`, the image to write, cannot be written.
    AnimationTexture(const std::filesystem::path& target, size_t columns);

    void add(const AnimationFrame& frame);  // Error: disk full
    size_t frames() const { return frames_; }
    AnimationFrame frame(size_t i) const;  // as it was added

    // Rows of all frames, then of all turns; `rigid`: turns have four channels. Error: disk full; nothing
    // half-written stays.
    void write(TexelFormat format, bool rigid);
    glm::vec3 low() const { return low_; }  // m, of all offsets
    glm::vec3 high() const { return high_; }

  private:
    void read(size_t frame) const;  // into row_

    std::filesystem::path target_;
    size_t columns_, frames_ = 0;
    glm::vec3 low_, high_;
    FilePointer spool_;
    mutable std::vector<float> row_;  // of the spool
};

// Turns a vector of ours into Blender's axes.
inline glm::vec3 toBlender(const glm::vec3& v) {
    return {v.x, -v.z, v.y};
}

// The rotation and the middle that carry `rest` nearest to `places`, by least squares [Horn 1987].
struct RigidMotion {
    glm::dquat turn{1, 0, 0, 0};
    glm::dvec3 middle{0}, restMiddle{0};  // m
    double worst = 0;                     // m, how far a place lies off it at the most
    double squares = 0;                   // m^2, the sum of all such distances squared
};
RigidMotion rigidMotion(std::span<const glm::dvec3> rest, std::span<const glm::dvec3> places);

}  // namespace shoal::exchange
