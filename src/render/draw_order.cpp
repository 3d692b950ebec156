#include "render/draw_order.h"

#include <bit>

#include "gpu/buffer.h"
#include "gpu/gl.h"
#include "gpu/shader_source.h"
#include "render/lighting.h"

namespace shoal {

static constexpr int lanes = 64;

StateReader::StateReader(const GroupPlan& plan, size_t group) : index(group), layout(plan.layout()) {}

std::vector<std::string> StateReader::defines(const StateView& state) const {
    if (!state.textures) return layout.defines(state.layers != nullptr);
    return {"TEXTURES", concat("STATE_WIDTH ", stateWidth)};
}

void StateReader::bind(const gpu::Program& program, const StateView& state,
                       const GroupBuffers::Part* part) const {
    if (state.textures) {
        const TextureState& textures = *state.textures;
        program.texture("positions", textures.position.read(index));
        program.texture("velocities", textures.velocity.read(index));
        program.texture("records", textures.record.read(index));
        program.texture("constants", textures.constant);
        if (textures.normal) program.texture("normals", textures.normal);
        const TextureState::Rows& rows = textures.rowsOf(index);
        program.set("groupRows", glm::ivec4(rows.firstRow, rows.slabRows, rows.firstRecordRow, 0));
        return;
    }
    if (state.layers) {
        const GroupLayers& layers = (*state.layers)[index];
        program.texture("states", layers.state());
        program.texture("records", layers.records());
        if (layers.hasNormals()) program.texture("normals", layers.normals());
        return;
    }
    const GroupBuffers& buffers = (*state.buffers)[index];
    program.texture("states", buffers.oldState(*part));
    program.texture("records", part->record);
    if (buffers.hasNormals()) program.texture("normals", part->normal);
}

// ---- The order

DrawOrder::DrawOrder(gpu::Context& context, const GroupPlan& group, size_t index, DrawSort sort,
                     int spreadFrames)
    : context_(&context),
      name_(group.name),
      reader_(group, index),
      count_(group.count),
      vertexCount_(group.vertexCount),
      sort_(sort),
      spreadFrames_(spreadFrames) {
    const auto count = size_t(count_);
    if (sort == DrawSort::spread || !context.info().computeShaders) {
        const auto kind =
            sort == DrawSort::spread ? NetworkSort::Kind::oddEvenMerge : NetworkSort::Kind::bitonic;
        network_ = std::make_unique<NetworkSort>(context, kind, count);
        return;
    }
    if (sort == DrawSort::frame) radix_ = std::make_unique<RadixSort>(context, count);
    pairs_ = gpu::Buffer(context, gpu::Buffer::Use::storage, nullptr, count * sizeof(KeyIndex), "draw order");
    pairTexels_ = gpu::BufferTexture(context, pairs_, gpu::Texel::uint2, "draw order");
}

std::vector<std::string> DrawOrder::defines() const {
    if (!network_) return {"ORDER_BUFFER"};
    return {gpu::constant("ORDER_PAIRED", network_->kind() == NetworkSort::Kind::bitonic)};
}

void DrawOrder::bind(const gpu::Program& program) const {
    if (network_)
        program.texture("order", network_->pairs());
    else
        program.texture("order", pairTexels_);
}

const gpu::Program& DrawOrder::keysProgram(const StateView& state) {
    gpu::Program& program = keys_[state.form()];
    if (program) return program;
    gpu::ProgramOptions options;
    options.defines = defines();
    for (const std::string& define : reader_.defines(state))
        options.defines.push_back(define);
    if (network_) {
        options.vertex = "passes/fullscreen.vert";
        options.fragment = "render/order_keys.frag";
    } else {
        options.defines.push_back(concat("LANES ", lanes));
        options.compute = "render/order_keys.comp";
    }
    options.label = name_ + " (order)";
    program = gpu::Program(*context_, options);
    return program;
}

void DrawOrder::setKeys(const StateView& state, const Eye& eye, bool keepOrder) {
    const GroupBuffers::Part* part = nullptr;
    if (state.buffers) {
        const std::vector<GroupBuffers::Part>& parts = (*state.buffers)[reader_.index].parts();
        if (parts.size() > 1)
            throw Error(concat("group \"", name_, "\" is too large to be drawn in order: its state fills ",
                               parts.size(), " storage blocks of this context"));
        part = &parts[0];
    }
    const gpu::Program& program = keysProgram(state);
    if (network_) network_->drawInto(network_->target());
    program.use();
    eye.origin.apply(program);
    reader_.bind(program, state, part);
    program.set("forward", -eye.viewToScene[2]);
    program.set("vertexCount", vertexCount_);
    program.set("moleculeCount", count_);
    if (network_) {
        bind(program);
        program.set("keepOrder", int(keepOrder));
        gpu::drawVertices(3);
        network_->flip();
        return;
    }
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});  // the last picture has read the order
    program.storage("Pairs", pairs_);
    program.dispatch((count_ + lanes - 1) / lanes);
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

// ---- Slabs

DepthSlabs::DepthSlabs(gpu::Context& context, int count, const DrawOrder& order)
    : bounds_(context, gpu::Format::rg32ui, count, 1, "depth slabs"),
      target_(context, {&bounds_}, nullptr, "depth slabs"),
      program_(context, {"passes/fullscreen.vert", "render/slabs.frag", order.defines(), {}, "depth slabs"}) {
}

void DepthSlabs::update(const DrawOrder& order) {
    for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST})
        glDisable(state);
    target_.bind();
    program_.use();
    order.bind(program_);
    program_.set("moleculeCount", order.count());
    program_.set("slabCount", count());
    gpu::drawVertices(3);
}

void DepthSlabs::bind(const gpu::Program& program) const {
    program.texture("slabs", bounds_);
}

static constexpr size_t drawBytes = 8 * sizeof(uint32_t);

static gpu::ProgramOptions findingDraws(const DrawOrder& order, size_t streams) {
    gpu::ProgramOptions options;
    options.compute = "render/slab_draws.comp";
    options.defines = order.defines();
    options.defines.push_back(concat("LANES ", lanes));
    options.defines.push_back(concat("STREAMS ", streams));
    options.label = "slab draws";
    return options;
}

SlabDraws::SlabDraws(gpu::Context& context, int slabs, const DrawOrder& order,
                     std::vector<DrawStream> streams)
    : slabs_(slabs),
      streams_(std::move(streams)),
      program_(context, findingDraws(order, streams_.size())),
      draws_(context, gpu::Buffer::Use::storage, nullptr, size_t(slabs) * drawBytes, "slab draws"),
      drawTexels_(context, draws_, gpu::Texel::uint1, "slab draws") {}

void SlabDraws::update(const DrawOrder& order, const gpu::Texture& bounds) {
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::storage});
    program_.use();
    order.bind(program_);
    program_.texture("slabs", bounds);
    program_.set("slabCount", slabs_);
    program_.set("moleculeCount", order.count());
    std::vector<glm::ivec4> streams;
    for (const DrawStream& stream : streams_)
        streams.emplace_back(stream.corners, stream.first, stream.batch, 0);
    program_.set("streams", std::span<const glm::ivec4>(streams));
    program_.storage("Draws", draws_);
    program_.dispatch((slabs_ + lanes - 1) / lanes);
    gpu::barrier({gpu::Barrier::textureFetch, gpu::Barrier::command});
}

void SlabDraws::bind(const gpu::Program& program) const {
    program.texture("slabDraws", drawTexels_);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws_.id());
}

void SlabDraws::draw(int slab) const {
    const auto* offset =
        reinterpret_cast<const void*>(size_t(slab) * drawBytes);  // OpenGL's way to say an offset
    gpu::beginPass();
    if (streams_[0].indexed)
        glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, offset);
    else
        glDrawArraysIndirect(GL_POINTS, offset);
}

// ---- Levels of detail

size_t LevelDraws::levelInShadow(const std::vector<DrawStream>& levels, double texelsPerMeter) {
    size_t level = 0;
    while (level + 1 < levels.size() && levels[level + 1].error * texelsPerMeter <= mostShadowError)
        ++level;
    return level;
}

LevelDraws::LevelDraws(gpu::Context& context, const GroupPlan& group, size_t index,
                       const std::vector<DrawStream>& levels, double scale)
    : radius_(scale * group.size),
      order_(context, group, index, DrawSort::frame, 0),
      bounds_(context, gpu::Format::rg32ui, int(levels.size()), 1, "levels of detail"),
      draws_(context, int(levels.size()), order_, {levels.rbegin(), levels.rend()}) {
    for (size_t i = levels.size() - 1; i > 0; --i)
        errors_.push_back(scale * levels[i].error);
}

// As shaders/render/order_key.glsl has it.
static uint32_t keyOf(double depth) {
    const uint32_t bits = std::bit_cast<uint32_t>(float(-depth));
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

void LevelDraws::update(const StateView& state, const Eye& eye) {
    order_.update(state, eye);
    std::vector<glm::uvec2> bounds(errors_.size() + 1, glm::uvec2(0, ~0u));
    for (size_t s = 0; s < errors_.size(); ++s)
        bounds[s].y = bounds[s + 1].x = keyOf(radius_ + errors_[s] * double(eye.pixelsPerMeter) / mostError);
    bounds_.upload(gpu::Traffic::Kind::parameters, 0, 0, int(bounds.size()), 1, bounds.data(),
                   bounds.size() * sizeof(glm::uvec2));
    draws_.update(order_, bounds_);
}

}  // namespace shoal
