#include "simulate/births.h"

#include <algorithm>

namespace shoal {

using gpu::Buffer;
using gpu::Program;
using gpu::Traffic;

// Storage offsets are multiples of so many words on any device.
constexpr size_t wordsApart = 64;

Births::Births(gpu::Context& context, const Plan& plan, const Tables& tables,
               const std::vector<GroupBuffers>& state, const std::vector<int>& together, size_t listWords)
    : BirthPasses(plan, wordsApart),
      context_(&context),
      tables_(&tables),
      buffers_(plan.groups.size()),
      lists_(context, plan.groups.size(), size_t(mostPlaces(plan))),
      listWords_(std::max(listWords / wordsApart, size_t(1)) * wordsApart) {
    for (const auto& living : groups_)
        if (living) make(*living, state[living->group], together[living->group]);
    if (diedWords_ > 0)
        died_ = Buffer(context, Buffer::Use::storage, nullptr, diedWords_ * sizeof(uint32_t), "deaths");
}

void Births::make(const Living& living, const GroupBuffers& state, int together) {
    const GroupPlan& group = *living.plan;
    Buffers& buffers = buffers_[living.group];
    const size_t parts = state.parts().size();
    buffers.stepGroups =
        Buffer(*context_, Buffer::Use::storage, nullptr, parts * sizeof(glm::uvec4), "workgroups of a step");
    buffers.set = {group.count, living.group,       together, state.parts().front().count,
                   int(parts),  &buffers.stepGroups};
    const size_t bytes = PlaceLists::bytesOf(size_t(group.count));
    const auto block = size_t(context_->info().maxStorageBlockBytes);
    if (bytes > block)
        throw Error(
            group.life->cycle.location,
            concat("a capacity of ", group.count, " for \"", group.name,
                   "\" is more than this context holds bits of in one storage block: at most ", 8 * block));
    buffers.free = Buffer(*context_, Buffer::Use::storage, nullptr, bytes, "free places");
    if (group.life->feeds) {
        const std::vector<uint8_t> none(bytes);
        buffers.died = Buffer(*context_, Buffer::Use::storage, none.data(), bytes, "died");
    }
    buffers.ranges = rangesOf(size_t(group.count));
    if (!living.emits()) return;
    if (living.listed())
        buffers.places = Buffer(*context_, Buffer::Use::storage, nullptr,
                                size_t(group.count) * sizeof(uint32_t), "places");
    buffers.spawn = &makeSpawn(*context_, living, {});
}

std::vector<ListRange> Births::rangesOf(size_t words) const {
    std::vector<ListRange> out;
    for (size_t first = 0; first < words; first += listWords_)
        out.push_back({first, std::min(listWords_, words - first)});
    return out;
}

void Births::bindStep(const Program& program, size_t group, const GroupBuffers::Part& part) const {
    const Buffers& own = buffers_[group];
    const auto bind = [&](const char* block, const Buffer& bits) {
        constexpr size_t placesOfByte = 8;
        const size_t offset = size_t(part.first) / placesOfByte;  // whole words (GroupBuffers)
        const bool last = part.first + part.count == own.set.places;
        program.storage(block, bits, offset,
                        last ? bits.bytes() - offset : size_t(part.count) / placesOfByte);
    };
    bind("FreeBits", own.free);
    if (own.died) bind("DiedBits", own.died);
    setAge(program, *groups_[group]);
}

void Births::dispatchStep(const Program& program, size_t group, const GroupBuffers::Part& part) const {
    const PlaceSet& set = buffers_[group].set;
    if (groups_[group]->onGpu())
        return program.dispatchIndirect(*set.stepGroups,
                                        size_t(part.first / set.partPlaces) * sizeof(glm::uvec4));
    const int reach = std::clamp(reachOf(*groups_[group]) - part.first, 0, part.count);
    program.dispatch((reach + set.stepLanes - 1) / set.stepLanes);
}

void Births::step(const Frame& frame, std::vector<GroupBuffers>& state, gpu::PassTimers& timers) {
    if (order_.empty()) return;
    const auto timer = timers.time("births");
    settleBirths();
    for (const auto& living : groups_)
        if (living && living->plan->life->feeds)
            lists_.listDeaths(buffers_[living->group].set, buffers_[living->group].died, died_,
                              living->diedAt, buffers_[living->group].ranges);
    for (const size_t g : order_)
        spawn(*groups_[g], frame, state);
    settleBirths();
}

void Births::countPlaces(const Living& living, int scheduled, bool allocates) {
    lists_.countPlaces(buffers_[living.group].set, buffers_[living.group].free, scheduled, deathsOf(living),
                       allocates);
}

void Births::bindBirths(const Living& living) const {
    const Buffers& own = buffers_[living.group];
    const Program& program = *own.spawn;
    program.storage("FreeBits", own.free);
    program.storage("Control", lists_.control());
    tables_->bind(program, *plan_);
}

void Births::bindSources(const Living& living, const ListRange& deaths, size_t index,
                         const std::vector<GroupBuffers>& state) const {
    const Program& program = *buffers_[living.group].spawn;
    program.storage("Died", died_, deaths.first * sizeof(uint32_t), deaths.count * sizeof(uint32_t));
    program.set("firstDied", int(deaths.first));
    program.set("diedCount", int(deaths.count));
    std::vector<glm::ivec4> places;
    for (const DeathRun& run : living.deathRuns) {
        const GroupBuffers& source = state[run.source];
        const bool read = index < source.parts().size();
        const GroupBuffers::Part& part = source.parts()[read ? index : 0];
        places.emplace_back(part.first, read ? part.count : 0, 0, 0);
        program.texture(concat("sourceStates", run.emitter).c_str(), source.oldState(part));
        program.texture(concat("sourceRecords", run.emitter).c_str(), part.record);
    }
    program.set("sourcePlaces", std::span<const glm::ivec4>(places));
}

// In most cases one dispatch: of the list, the state or both there may be more than it can reach.
void Births::dispatchBirths(const Living& living, int born, const GroupBuffers& state) const {
    const Buffers& own = buffers_[living.group];
    const Program& program = *own.spawn;
    const int groups = (std::max(born, 0) + birthLanes - 1) / birthLanes;
    const int rows = (groups + control::mostGroups - 1) / control::mostGroups;
    for (const ListRange& range : own.ranges) {
        if (born >= 0 && range.first >= size_t(born)) break;
        if (living.listed())
            program.storage("Places", own.places, range.first * sizeof(uint32_t),
                            range.count * sizeof(uint32_t));
        program.set("firstNewborn", int(range.first));
        program.set("newbornCount", int(range.count));
        for (const GroupBuffers::Part& part : state.parts()) {
            store(program, "NewState", state.currentState(part));
            store(program, "NewRecords", state.records(part));
            if (state.hasConstants()) store(program, "NewConstants", state.constants(part));
            program.set("partFirst", part.first);
            program.set("partPlaces", part.count);
            if (living.onGpu())
                program.dispatchIndirect(
                    lists_.control(), (control::of(living.group) + control::birthGroups) * sizeof(uint32_t));
            else
                program.dispatch((groups + rows - 1) / rows, rows);
        }
    }
    settleBirths();
}

void Births::spawn(Living& living, const Frame& frame, std::vector<GroupBuffers>& state) {
    const Newborns newborns = schedule(living, frame);
    Buffers& own = buffers_[living.group];
    if (living.onGpu()) {
        countPlaces(living, newborns.scheduled, true);
        if (newborns.scheduled == 0 && living.deathRuns.empty()) return;
        lists_.listPlaces(own.set, own.free, own.places, own.ranges);
    }
    if (newborns.born == 0) return;
    if (!newborns.places.empty())
        own.places.update(Traffic::Kind::births, 0, newborns.places.data(),
                          newborns.places.size() * sizeof(uint32_t));
    own.spawn->use();
    setNumbers(*own.spawn, living, newborns, frame);
    bindBirths(living);
    if (living.deathRuns.empty()) return dispatchBirths(living, newborns.born, state[living.group]);
    size_t parts = 1;
    for (const DeathRun& run : living.deathRuns)
        parts = std::max(parts, state[run.source].parts().size());
    for (const ListRange& deaths : rangesOf(diedWords_)) {
        for (size_t p = 0; p < parts; ++p) {
            bindSources(living, deaths, p, state);
            dispatchBirths(living, newborns.born, state[living.group]);
        }
    }
}

void Births::write(size_t group, const GroupState& state, double time) {
    Living& living = *groups_[group];
    Buffers& own = buffers_[group];
    std::vector<uint32_t> bits(own.free.bytes() / sizeof(uint32_t));
    for (size_t m = 0; m < state.lives.size(); ++m)
        if (!(state.lives[m].y > 0)) bits[m / 32] |= uint32_t(1) << (m % 32);
    own.free.update(Traffic::Kind::state, 0, bits.data(), own.free.bytes());
    lists_.writeControl(group, begin(living, state, time).data());
    std::vector<glm::uvec4> steps;  // of all places
    for (int p = 0; p < own.set.partCount; ++p) {
        const int here = std::min(own.set.partPlaces, own.set.places - p * own.set.partPlaces);
        steps.emplace_back((here + own.set.stepLanes - 1) / own.set.stepLanes, 1, 1, 0);
    }
    own.stepGroups.update(Traffic::Kind::state, 0, steps.data(), own.stepGroups.bytes());
}

void Births::read(size_t group, GroupState& state) const {
    uint32_t words[control::words];
    lists_.readControl(group, words);
    readBooks(*groups_[group], words, state);
}

LifeCounts Births::counts(size_t group) {
    const Living& living = *groups_[group];
    if (!living.onGpu()) {
        settleBirths();
        countPlaces(living, 0, false);
    }
    uint32_t words[control::words];
    lists_.readControl(group, words);
    return countsOf(living, words);
}

}  // namespace shoal
