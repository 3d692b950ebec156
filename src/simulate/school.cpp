#include "simulate/school.h"

#include <algorithm>
#include <bit>

namespace shoal {

using gpu::Program;

namespace {

size_t mostInBuffers(const gpu::ContextInfo& info) {
    constexpr size_t lanes = 64;  // of a workgroup, as the shaders say
    const size_t block = size_t(info.maxStorageBlockBytes) / 16, texels = size_t(info.maxBufferTexels);
    return std::min({block / bodyElements, texels / bodyElements, size_t(info.maxWorkGroupsX) * lanes,
                     RadixSort::most(info), texels / 4});
}

// Keys are up to twice as many as molecules.
size_t mostInTextures(const gpu::ContextInfo& info) {
    const size_t side = std::bit_floor(unsigned(info.maxTextureSize));
    return std::min(side * side / 2 - 1, NetworkSort::most(info, NetworkSort::Kind::bitonic));
}

}  // namespace

BufferSchool::BufferSchool(gpu::Context& context, const Plan& plan, const Tables& tables,
                           const std::vector<GroupBuffers>& state)
    : SchoolPasses(context, plan, tables, Form::buffers, mostInBuffers(context.info())),
      sort_(context, size_t(plan.school.entries)),
      state_(&state) {}

void BufferSchool::sortKeys() {
    arrays_.run(useKeys(), 0, school_->entries);
    sort_.sort(arrays_.buffer("sorted"), size_t(school_->entries),
               int(std::bit_width(unsigned(school_->keys - 1))));
    arrays_.settle();
}

void BufferSchool::steer(size_t index, const Frame& frame) {
    const SchoolMember& member = school_->members[index];
    const Program& program = useSteer(index, frame);
    program.storage("Steering", (*state_)[member.group].steering());
    arrays_.run(program, 0, school_->grids[member.grid].entries);
}

TextureSchool::TextureSchool(gpu::Context& context, const Plan& plan, const Tables& tables,
                             std::vector<GroupLayers>& state)
    : SchoolPasses(context, plan, tables, Form::textures, mostInTextures(context.info())),
      sort_(context, NetworkSort::Kind::bitonic, size_t(plan.school.entries), 2 << rowBits_,
            NetworkSort::Ties::byIndex),
      state_(&state) {
    starts_ = Program(context, optionsOf("sort/starts", "school starts", nullptr));
    gpu::ProgramOptions steered = optionsOf("school/steer", "school steering", nullptr);
    steered.defines.emplace_back("MOLECULES");
    steered.defines.push_back(concat("STATE_WIDTH ", stateWidth));
    steered_ = Program(context, steered);
}

void TextureSchool::sortKeys() {
    useKeys().set("numbers", school_->entries);
    sort_.drawInto(sort_.target());
    gpu::drawVertices(3);
    sort_.flip();
    sort_.sort();
    arrays_.lend("sorted", sort_.pairs());
    arrays_.use(starts_).set("count", school_->entries);
    arrays_.run(starts_, 0, school_->keys + 1);
}

void TextureSchool::steer(size_t index, const Frame& frame) {
    GroupLayers& state = (*state_)[school_->members[index].group];
    const Program& program = useSteer(index, frame);
    program.texture("steering", state.steering());
    const SchoolMember& member = school_->members[index];
    const glm::ivec4 range = rangeOf(member.grid);
    arrays_.run(program, range.x, range.y);
    arrays_.use(steered_).set("grid", range);
    steered_.set("inverseCell", float(1 / cellOf(member.grid)));
    steered_.set("firstBody", school_->bodiesOf(member.group).first);
    steered_.set("entries", school_->entries);
    state.newSteering().bind();
    gpu::drawVertices(3);
    state.flipSteering();
}

}  // namespace shoal
