#include "simulate/births.h"

#include <algorithm>

#include "gpu/gl.h"

namespace shoal {

using gpu::Program;
using gpu::Traffic;

namespace {

std::vector<glm::ivec4> partsOf(const std::vector<GroupBuffers>& state) {
    std::vector<glm::ivec4> out;
    for (const GroupBuffers& group : state)
        out.emplace_back(0, int(group.parts().size()), group.parts().front().count, group.together());
    return out;
}

int groupsOf(int molecules, int together) {
    return (molecules + together - 1) / together;
}

}  // namespace

BufferBirths::BufferBirths(gpu::Context& context, const Plan& plan, const Tables& tables,
                           const std::vector<GroupBuffers>& state)
    : BirthPasses(context, plan, tables, Form::buffers, partsOf(state)), state_(&state) {}

void BufferBirths::runStep(const Program& program, size_t group, size_t range) const {
    const Living& living = *groups_[group];
    const GroupBuffers::Part& part = (*state_)[group].parts()[range];
    (*state_)[group].bindNew(program, part);
    for (const auto& [block, bits] : {std::pair("FreeBits", "free"), std::pair("DiedBits", "died")})
        if (program.declares(block)) program.storage(block, arrays_.buffer(bits));
    // a part has whole words of bits (GroupBuffers)
    program.set("firstWord", living.firstWord + part.first / 32);
    setAge(program, living);
    if (living.onGpu())
        return program.dispatchIndirect(
            arrays_.buffer("reaches"),
            (size_t(living.parts.x) + size_t(part.first / living.parts.z)) * sizeof(glm::uvec4));
    program.dispatch(groupsOf(std::clamp(reachOf(living) - part.first, 0, part.count), living.parts.w));
}

void BufferBirths::bindPlaces(const Program& bits, const Living& living) const {
    bits.set("firstWord", living.firstWord);
}

void BufferBirths::writePlaces(const Living& living, const GroupState& state) {
    std::vector<uint32_t> bits(size_t(living.words()));
    for (size_t m = 0; m < state.lives.size(); ++m)
        if (!(state.lives[m].y > 0)) bits[m / 32] |= uint32_t(1) << (m % 32);
    const auto firstWord = size_t(living.firstWord);
    arrays_.buffer("free").update(Traffic::Kind::state, firstWord * sizeof(uint32_t), bits.data(),
                                  bits.size() * sizeof(uint32_t));
    std::vector<glm::uvec4> reaches;  // all places
    for (const GroupBuffers::Part& part : (*state_)[living.group].parts())
        reaches.emplace_back(groupsOf(part.count, living.parts.w), 1, 1, 0);
    arrays_.buffer("reaches").update(Traffic::Kind::state, size_t(living.parts.x) * sizeof(glm::uvec4),
                                     reaches.data(), reaches.size() * sizeof(glm::uvec4));
}

void BufferBirths::bindSources(const Program& program, const Living& living, size_t index) const {
    std::vector<glm::ivec4> places;
    for (const DeathRun& run : living.deathRuns) {
        const GroupBuffers& source = (*state_)[run.source];
        const bool read = index < source.parts().size();
        const GroupBuffers::Part& part = source.parts()[read ? index : 0];
        places.emplace_back(part.first, read ? part.count : 0, 0, 0);
        program.texture(concat("sourceStates", run.emitter).c_str(), source.oldState(part));
        program.texture(concat("sourceRecords", run.emitter).c_str(), part.record);
    }
    if (!places.empty()) program.set("sourcePlaces", std::span<const glm::ivec4>(places));
}

void BufferBirths::spawn(const Program& program, const Living& living, int most) {
    program.set("firstWord", living.firstWord);
    size_t sourceParts = 1;
    for (const DeathRun& run : living.deathRuns)
        sourceParts = std::max(sourceParts, (*state_)[run.source].parts().size());
    const GroupBuffers& state = (*state_)[living.group];
    const int groups = groupsOf(most, birthLanes), rows = groupsOf(groups, mostGroups);
    for (size_t p = 0; p < sourceParts; ++p) {
        bindSources(program, living, p);
        for (const GroupBuffers::Part& part : state.parts()) {
            store(program, "NewState", state.currentState(part));
            store(program, "NewRecords", state.records(part));
            if (state.hasConstants()) store(program, "NewConstants", state.constants(part));
            program.set("partFirst", part.first);
            program.set("partPlaces", part.count);
            if (living.onGpu())
                program.dispatchIndirect(
                    arrays_.buffer("control"),
                    (living.group * control::words + control::birthGroups) * sizeof(uint32_t));
            else
                program.dispatch(groupsOf(groups, rows), rows);
        }
    }
}

TextureBirths::TextureBirths(gpu::Context& context, const Plan& plan, const Tables& tables,
                             const std::vector<GroupLayers>& state)
    : BirthPasses(context, plan, tables, Form::textures,
                  std::vector<glm::ivec4>(plan.groups.size(), {0, 0, 1, 1})),
      state_(&state) {}

void TextureBirths::runStep(const Program& program, size_t group, size_t) const {
    const Living& living = *groups_[group];
    const GroupLayers& state = (*state_)[group];
    setAge(program, living);
    if (living.onGpu()) {
        program.texture("control", arrays_.texture("control"));
        program.set("group", int(group));
        program.set("stateRows", state.state().height());
    }
    state.draw(program, PackedState::Output::state, reachOf(living), living.onGpu() ? 6 : 3);
}

void TextureBirths::bindPlaces(const Program& bits, const Living& living) const {
    const GroupLayers& layers = (*state_)[living.group];
    bits.texture("states", layers.state());
    bits.texture("statesBefore", layers.stateBefore());
}

void TextureBirths::spawn(const Program& program, const Living& living, int most) {
    const GroupLayers& layers = (*state_)[living.group];
    for (const DeathRun& run : living.deathRuns) {
        program.texture(concat("sourceStates", run.emitter).c_str(), (*state_)[run.source].state());
        program.texture(concat("sourceRecords", run.emitter).c_str(), (*state_)[run.source].records());
    }
    program.set("stateRows", layers.state().height());
    for (const LayerDraw& draw : layers.newborns()) {
        program.set("firstStored", draw.first);
        draw.target.bind();
        gpu::drawVertices(most, GL_POINTS);
    }
}

}  // namespace shoal
