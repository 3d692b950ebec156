#include "render/draw_order.h"

#include "gpu/barrier.h"
#include "gpu/gl.h"
#include "render/lighting.h"
#include "render/molecule_state.h"

namespace shoal {

static constexpr int keyLanes = 64;

DrawOrder::DrawOrder(gpu::Context& context, const std::string& shaderRoot, const GroupPlan& group,
                     size_t index, DrawSort sort, int spreadFrames)
    : context_(&context),
      shaderRoot_(shaderRoot),
      name_(group.name),
      index_(index),
      count_(group.count),
      vertexCount_(group.vertexCount),
      rows_(group.texture.firstRow, group.texture.slabRows, group.texture.firstRecordRow, 0),
      layout_(group.layout()),
      sort_(sort),
      spreadFrames_(spreadFrames) {
    const auto count = size_t(count_);
    if (sort == DrawSort::spread || !context.info().computeShaders) {
        const auto kind =
            sort == DrawSort::spread ? NetworkSort::Kind::oddEvenMerge : NetworkSort::Kind::bitonic;
        network_ = std::make_unique<NetworkSort>(context, shaderRoot, kind, count);
        return;
    }
    if (sort == DrawSort::frame) radix_ = std::make_unique<RadixSort>(context, shaderRoot, count);
    pairs_ = gpu::Buffer(context, gpu::Buffer::Use::storage, nullptr, count * sizeof(KeyIndex), "draw order");
    pairTexels_ = gpu::BufferTexture(context, pairs_, gpu::Texel::uint2, "draw order");
}

std::vector<std::string> DrawOrder::defines() const {
    if (!network_) return {"ORDER_BUFFER"};
    if (network_->kind() == NetworkSort::Kind::bitonic) return {"ORDER_PAIRED"};
    return {};
}

void DrawOrder::bind(const gpu::Program& program) const {
    if (network_)
        program.texture("order", unit::order, network_->pairs());
    else
        program.texture("order", unit::order, pairTexels_);
}

const gpu::Program& DrawOrder::keysProgram(const StateView& state) {
    gpu::Program& program = keys_[state.textures ? 0 : 1];
    if (program) return program;
    gpu::ProgramOptions options;
    options.defines = defines();
    for (const std::string& define : stateDefines(state, layout_))
        options.defines.push_back(define);
    if (network_) {
        options.vertex = "passes/fullscreen.vert";
        options.fragment = "render/order_keys.frag";
    } else {
        options.defines.push_back(concat("LANES ", keyLanes));
        options.compute = "render/order_keys.comp";
    }
    options.label = name_ + " (order)";
    program = gpu::Program(*context_, shaderRoot_, options);
    return program;
}

void DrawOrder::setKeys(const StateView& state, const Eye& eye, bool keepOrder) {
    const GroupBuffers::Part* part = nullptr;
    if (state.buffers) {
        const std::vector<GroupBuffers::Part>& parts = (*state.buffers)[index_].parts();
        if (parts.size() > 1)
            throw Error(concat("group \"", name_, "\" is too large to be drawn in order: its state fills ",
                               parts.size(), " storage blocks of this context"));
        part = &parts[0];
    }
    const gpu::Program& program = keysProgram(state);
    if (network_) network_->drawInto(network_->target());
    program.use();
    eye.origin.apply(program);
    bindState(program, state, index_, rows_, part);
    program.set("forward", -eye.viewToScene[2]);
    program.set("vertexCount", vertexCount_);
    program.set("moleculeCount", count_);
    if (network_) {
        bind(program);
        program.set("keepOrder", int(keepOrder));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        network_->flip();
        return;
    }
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});  // the last picture has read the order
    program.storage("Pairs", 0, pairs_, 0, pairs_.bytes());
    program.dispatch((count_ + keyLanes - 1) / keyLanes);
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
}

void DrawOrder::update(const StateView& state, const Eye& eye) {
    const bool goesOn = sort_ == DrawSort::spread && begun_;
    setKeys(state, eye, goesOn);
    if (goesOn) return network_->advance();
    if (sort_ == DrawSort::none) return;
    if (radix_)
        radix_->sort(pairs_, size_t(count_), 32);
    else
        network_->sort();
    if (sort_ != DrawSort::spread) return;
    network_->beginSpread(spreadFrames_);
    begun_ = true;
}

std::vector<KeyIndex> DrawOrder::download() const {
    if (network_) return network_->download();
    std::vector<KeyIndex> out(static_cast<size_t>(count_));
    pairs_.download(gpu::Traffic::Kind::state, 0, out.data(), out.size() * sizeof(KeyIndex));
    return out;
}

}  // namespace shoal
