// The order in which the molecules of a blended group are drawn: from back to front, by the depth of their
// middles along the view. Made and kept on the GPU; nothing of it crosses the bus. By the same order skins
// are drawn with as many triangles as their distance asks for.
//
// Several blended groups take turns in slabs of depth: everything of the farthest slab first, whatever its
// group. Within a group the order stays exact; of two groups, what lies in one slab may be drawn the wrong
// way round.
//
// Pairs of src/sort: the key is the depth as a whole number, the farthest first; the index is the molecule.
//   frame    numbered and sorted anew in every frame: by radix in compute, below OpenGL 4.3 bitonic. Exact.
//   spread   the first frame sorts; every other gives the last order new depths, and takes its share of
//            the passes of odd-even merge sort (Latta, "Building a million particle system",
//            section 3.4.4). Late by up to spreadFrames frames.
//   none     numbered, with depths: for who asks how far a molecule is
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "compile/plan.h"
#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "molecule/molecule.h"
#include "render/view.h"
#include "simulate/state_view.h"
#include "sort/network_sort.h"
#include "sort/radix_sort.h"

namespace shoal {

// How programs that draw or order the molecules of a group reach its state, on any path.
struct StateReader {
    size_t index;  // of the group in the plan
    BufferLayout layout;

    StateReader(const GroupPlan& plan, size_t group);
    // Returns the defines of a program that includes state/molecule.glsl.
    std::vector<std::string> defines(const StateView& state) const;
    // `part`: of the group's buffers; null where the state is not in buffers. Texture units 0 to 3.
    void bind(const gpu::Program& program, const StateView& state, const GroupBuffers::Part* part) const;
};

class DrawOrder {
  public:
    // `index` of the group in the plan. Error: more molecules than the context can sort, with how many it
    // can.
    DrawOrder(gpu::Context& context, const GroupPlan& group, size_t index, DrawSort sort, int spreadFrames);

    // For the programs that read the order (shaders/render/order.glsl).
    std::vector<std::string> defines() const;
    void bind(const gpu::Program& program) const;

    // Updates the order to the state as `eye` sees it. Changes the framebuffer and what fragment passes
    // change. Error: the group is in several pieces, because its state is larger than a storage block.
    void update(const StateView& state, const Eye& eye);

    std::vector<KeyIndex> download() const;  // for tests
    int count() const { return count_; }
    bool sorted() const { return sort_ != DrawSort::none; }
    bool exact() const { return radix_ != nullptr; }  // sorted in every frame, in a buffer

  private:
    const gpu::Program& keysProgram(const StateView& state);
    void setKeys(const StateView& state, const Eye& eye, bool keepOrder);

    gpu::Context* context_;
    std::string name_;
    StateReader reader_;
    int count_, vertexCount_;
    DrawSort sort_;
    int spreadFrames_;
    bool begun_ = false;
    std::array<gpu::Program, StateView::forms> keys_;  // made when first needed
    gpu::Buffer pairs_;                                // with compute, unless spread
    gpu::BufferTexture pairTexels_;
    std::unique_ptr<RadixSort> radix_;
    std::unique_ptr<NetworkSort> network_;  // else
};

class DepthSlabs {
  public:
    // Every slab is to hold about as many molecules of the group with this order.
    DepthSlabs(gpu::Context& context, int count, const DrawOrder& order);

    void update(const DrawOrder& order);  // of the group that it was made for; changes the framebuffer
    void bind(const gpu::Program& program) const;
    int count() const { return bounds_.width(); }
    const gpu::Texture& bounds() const { return bounds_; }

  private:
    gpu::Texture bounds_;  // texel s: first key of slab s, first one past it
    gpu::Framebuffer target_;
    gpu::Program program_;
};

// The contents of one instance of a draw call.
struct DrawStream {
    int corners = 1;       // indices, or vertices where there are none
    bool indexed = false;  // triangles; else points
    int batch = 1;         // molecules
    int first = 0;         // index
    double error = 0;      // m, of a level of detail (geometry/mesh_levels.h)
};

// One indirect draw a slab of depth, of those molecules of a sorted group that lie in it: found on the GPU
// (OpenGL 4.3), so that no vertex of another slab is touched.
class SlabDraws {
  public:
    // `streams`: one for all slabs, or one each.
    SlabDraws(gpu::Context& context, int slabs, const DrawOrder& order, std::vector<DrawStream> streams);

    int slabs() const { return slabs_; }
    // `bounds`: texel s holds the first key of slab s and the first one past it.
    void update(const DrawOrder& order, const gpu::Texture& bounds);
    void bind(const gpu::Program& program) const;  // shaders/render/drawn.glsl, SLAB_DRAWS
    void draw(int slab) const;                     // the vertex array is bound

  private:
    int slabs_;
    std::vector<DrawStream> streams_;
    gpu::Program program_;
    gpu::Buffer draws_;  // shaders/render/slab_draws.comp
    gpu::BufferTexture drawTexels_;
};

// Draws each molecule of a group with as few triangles as its depth allows.
class LevelDraws {
  public:
    static constexpr double mostError = 0.1;        // pixels of a picture
    static constexpr double mostShadowError = 0.3;  // texels of a shadow map, which shows no normals

    // The coarsest of `levels` that a shadow map of so many texels a metre does not tell from the finest.
    static size_t levelInShadow(const std::vector<DrawStream>& levels, double texelsPerMeter);

    // `scale`: of the largest molecule. Error: DrawOrder's.
    LevelDraws(gpu::Context& context, const GroupPlan& group, size_t index,
               const std::vector<DrawStream>& levels, double scale);

    // Updates the draws to the state as `eye` sees it; changes what DrawOrder::update() does.
    void update(const StateView& state, const Eye& eye);
    const DrawOrder& order() const { return order_; }
    const SlabDraws& draws() const { return draws_; }

  private:
    std::vector<double> errors_;  // m, of each slab but the last, the coarsest first
    double radius_;               // m, of a molecule
    DrawOrder order_;
    gpu::Texture bounds_;
    SlabDraws draws_;
};

}  // namespace shoal
