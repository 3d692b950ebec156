#include "render/slab_draws.h"

#include "gpu/barrier.h"
#include "gpu/gl.h"
#include "render/lighting.h"

namespace shoal {

static constexpr int lanes = 64;
static constexpr size_t drawBytes = 8 * sizeof(uint32_t);

static gpu::ProgramOptions findingDraws(const DrawOrder& order) {
    gpu::ProgramOptions options;
    options.compute = "render/slab_draws.comp";
    options.defines = order.defines();
    options.defines.push_back(concat("LANES ", lanes));
    options.label = "slab draws";
    return options;
}

SlabDraws::SlabDraws(gpu::Context& context, const std::string& shaderRoot, int slabs, const DrawOrder& order,
                     const DrawStream& stream)
    : slabs_(slabs),
      stream_(stream),
      program_(context, shaderRoot, findingDraws(order)),
      draws_(context, gpu::Buffer::Use::storage, nullptr, size_t(slabs) * drawBytes, "slab draws"),
      drawTexels_(context, draws_, gpu::Texel::uint1, "slab draws") {}

void SlabDraws::update(const DrawOrder& order, const DepthSlabs& slabs) {
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
    program_.use();
    order.bind(program_);
    slabs.bind(program_);
    program_.set("slabCount", slabs_);
    program_.set("moleculeCount", order.count());
    program_.set("corners", stream_.corners);
    program_.set("batch", stream_.batch);
    program_.storage("Draws", 0, draws_, 0, draws_.bytes());
    program_.dispatch((slabs_ + lanes - 1) / lanes);
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::draw});
}

void SlabDraws::bind(const gpu::Program& program) const {
    program.texture("slabDraws", unit::slabDraws, drawTexels_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws_.id());
}

void SlabDraws::draw(int slab) const {
    const auto* at =
        reinterpret_cast<const void*>(size_t(slab) * drawBytes);  // OpenGL's way to say an offset
    if (stream_.indexed)
        glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, at);
    else
        glDrawArraysIndirect(GL_POINTS, at);
}

}  // namespace shoal
