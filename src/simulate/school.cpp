#include "simulate/school.h"

#include <algorithm>

namespace shoal {

using gpu::Barrier;
using gpu::Program;
using gpu::Texel;

namespace {

constexpr size_t lanes = 64;  // of a workgroup, as the shaders say

void settled() {
    gpu::barrier({Barrier::textureFetch, Barrier::storage});
}

void dispatch(const Program& program, int count) {
    program.dispatch(int((size_t(count) + lanes - 1) / lanes));
}

size_t mostOf(const gpu::ContextInfo& info) {
    const size_t block = size_t(info.maxStorageBlockBytes) / 16, texels = size_t(info.maxBufferTexels);
    return std::min({block / bodyElements, texels / bodyElements, size_t(info.maxWorkGroupsX) * lanes,
                     RadixSort::most(info), texels / 4});
}

}  // namespace

Schooling::Schooling(gpu::Context& context, const Plan& plan, const Tables& tables)
    : SchoolPasses(context, plan, tables, {}),
      sort_((checkCount(plan.school, mostOf(context.info())), context), size_t(plan.school.entries)) {
    const auto buffer = [&](size_t words, const char* label) {
        return gpu::Buffer(context, gpu::Buffer::Use::storage, nullptr, words * 4, label);
    };
    const auto read = [&](const gpu::Buffer& from, Texel texel, const char* label) {
        return gpu::BufferTexture(context, from, texel, label);
    };
    const auto entries = size_t(school_->entries);
    bodies_ = buffer(size_t(school_->bodyCount) * bodyElements * 4, "school bodies");
    pairs_ = buffer(entries * 2, "school keys");
    starts_ = buffer(size_t(school_->keys) + 1, "school cells");
    places_ = buffer(entries * 4, "school places");
    velocities_ = buffer(entries * 4, "school velocities");
    bodiesRead_ = read(bodies_, Texel::float4, "school bodies");
    pairsRead_ = read(pairs_, Texel::uint2, "school keys");
    startsRead_ = read(starts_, Texel::uint1, "school cells");
    placesRead_ = read(places_, Texel::float4, "school places");
    velocitiesRead_ = read(velocities_, Texel::float4, "school velocities");
    makePrograms();
}

void Schooling::findBodies(const std::vector<GroupBuffers>& state) {
    for (size_t b = 0; b < school_->bodies.size(); ++b) {
        const SchoolBodies& bodies = school_->bodies[b];
        const Program& program = useBody(b);
        program.storage("Bodies", 0, bodies_);
        for (const GroupBuffers::Part& part : state[bodies.group].parts()) {
            program.texture("oldState", 0, state[bodies.group].oldState(part));
            program.texture("oldRecords", 1, part.record);
            program.set("partMolecules", part.count);
            program.set("firstBody", bodies.first + part.first);
            dispatch(program, part.count);
        }
    }
    settled();
}

void Schooling::makeKeys() {
    const Program& program = useKeys();
    program.texture("bodies", 0, bodiesRead_);
    program.storage("Pairs", 0, pairs_);
    dispatch(program, school_->entries);
    settled();
}

void Schooling::order() {
    sort_.sort(pairs_, size_t(school_->entries), school_->keyBits());
    settled();
    const Program& program = useOrder();
    program.texture("sorted", 0, pairsRead_);
    program.texture("bodies", 1, bodiesRead_);
    program.set("keyCount", school_->keys);
    program.storage("Starts", 0, starts_);
    program.storage("Places", 1, places_);
    program.storage("Velocities", 2, velocities_);
    dispatch(program, school_->entries);
    settled();
}

void Schooling::steer(size_t index, const Frame& frame, const std::vector<GroupBuffers>& state) {
    const SchoolMember& member = school_->members[index];
    const Program& program = useSteer(index, frame);
    program.texture("bodies", 0, bodiesRead_);
    program.texture("sorted", 1, pairsRead_);
    program.texture("starts", 2, startsRead_);
    program.texture("places", 3, placesRead_);
    program.texture("velocities", 4, velocitiesRead_);
    program.storage("Steering", 0, state[member.group].steering());
    dispatch(program, school_->grids[member.grid].entries);
}

void Schooling::step(const Frame& frame, const std::vector<GroupBuffers>& state, gpu::PassTimers& timers) {
    {
        const auto timer = timers.time("school grid");
        settled();
        findBodies(state);
        makeKeys();
        order();
    }
    const auto timer = timers.time("school steer");
    for (size_t m = 0; m < school_->members.size(); ++m)
        steer(m, frame, state);
    settled();
}

}  // namespace shoal
