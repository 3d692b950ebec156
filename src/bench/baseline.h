// The method of the `euler` passes, written for the CPU by hand: the baseline of `shoal bench`.
//
// A fixed workload: uniform wind, plain drag and gravity taken exactly, damped springs, one ground plane.
//   v += h F(x, v) / m;  v = exact drag and gravity;  x += h v;  contact (shaders/physics/collide.glsl)
// Every molecule is read and written once a frame, whatever the number of substeps.
//
// Layout. `scalar` keeps an array of vertices per molecule and loops over springs, as one writes it without
// SIMD in mind. `avx2` and `avx512` put one molecule in each lane: blocks of 8 or 16 molecules, in a block
//   6 vectors a vertex: x, y, z, vx, vy, vz;  then 3 vectors: the anchors.
// Positions are relative to a molecule's anchor as on the GPU (shaders/physics/anchor.glsl).
// Quad, cross and fish have their springs unrolled at compile time; other molecules take loops.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "molecule/molecule.h"

namespace shoal::bench {

struct BaselineStep {
    float h = 1.0f / 240;  // s, of a substep
    int substeps = 4;
    glm::vec3 gravity{0}, wind{0};                  // m/s^2, m/s
    float decay = 0;                                // 1 - exp(-gamma h)
    float phi = 1.0f / 240;                         // decay / gamma, s; h where gamma = 0
    float stiffness = 1, damping = 1;               // factors on every spring
    glm::vec3 planePoint{0}, planeNormal{0, 1, 0};  // unit normal towards the free side
    float restitution = 0.2f, friction = 0.5f;
    float thickness = 0.002f;  // m: vertices rest this far from the plane
};

enum class Simd { scalar, avx2, avx512 };
const char* name(Simd simd);
bool available(Simd simd);  // compiled in, and this processor has it
Simd bestSimd();            // of those that are available

// No pins and no muscles: the workload has neither.
bool fitsBaseline(const Molecule& molecule);

class Baseline {
  public:
    // The molecule must fit; count and threads are at least 1; `simd` must be available.
    // Threads beside the caller's own are tied to one core each; the caller's is for the time of a frame.
    Baseline(const Molecule& molecule, int count, Simd simd, int threads);
    ~Baseline();
    Baseline(Baseline&&) noexcept;
    Baseline& operator=(Baseline&&) noexcept;

    // m and m/s in world coordinates; vertex v of molecule m at m * vertexCount + v.
    void set(std::span<const glm::vec3> positions, std::span<const glm::vec3> velocities);
    void get(std::vector<glm::vec3>& positions, std::vector<glm::vec3>& velocities) const;

    void frame(const BaselineStep& step);

    bool unrolled() const;            // the molecule's springs are known at compile time
    size_t bytesPerMolecule() const;  // of state, read and written once a frame

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace shoal::bench
