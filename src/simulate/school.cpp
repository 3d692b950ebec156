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
    const auto add = [&](gpu::Array& array, const char* name, size_t texels, Texel texel) {
        array = gpu::Array(context, texels, texel, concat("school ", name).c_str());
        arrays_.add(name, array);
    };
    const auto entries = size_t(school_->entries);
    add(bodies_, "bodies", size_t(school_->bodyCount) * bodyElements, Texel::float4);
    add(sorted_, "sorted", entries, Texel::uint2);
    add(starts_, "starts", size_t(school_->keys) + 1, Texel::uint1);
    add(places_, "places", entries, Texel::float4);
    add(velocities_, "velocities", entries, Texel::float4);
    makePrograms();
}

void Schooling::findBodies(const std::vector<GroupBuffers>& state) {
    for (size_t b = 0; b < school_->bodies.size(); ++b) {
        const SchoolBodies& bodies = school_->bodies[b];
        const Program& program = useBody(b);
        arrays_.bind(program);
        for (const GroupBuffers::Part& part : state[bodies.group].parts()) {
            program.texture("oldState", state[bodies.group].oldState(part));
            program.texture("oldRecords", part.record);
            program.set("partMolecules", part.count);
            program.set("firstBody", bodies.first + part.first);
            dispatch(program, part.count);
        }
    }
    settled();
}

void Schooling::makeKeys() {
    const Program& program = useKeys();
    arrays_.bind(program);
    dispatch(program, school_->entries);
    settled();
}

void Schooling::order() {
    sort_.sort(sorted_.buffer, size_t(school_->entries), school_->keyBits());
    settled();
    const Program& program = useOrder();
    arrays_.bind(program);
    program.set("keyCount", school_->keys);
    dispatch(program, school_->entries);
    settled();
}

void Schooling::steer(size_t index, const Frame& frame, const std::vector<GroupBuffers>& state) {
    const SchoolMember& member = school_->members[index];
    const Program& program = useSteer(index, frame);
    arrays_.bind(program);
    program.storage("Steering", state[member.group].steering());
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
