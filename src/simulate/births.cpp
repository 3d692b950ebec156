#include "simulate/births.h"

#include <algorithm>

namespace shoal {

using gpu::Buffer;
using gpu::Program;
using gpu::Traffic;

static void checkPlaces(const gpu::ContextInfo& info, const GroupPlan& group, int together) {
    const size_t bytes = size_t(group.layout().stateElements()) * sizeof(glm::vec4);
    const size_t most = std::min(size_t(info.maxStorageBlockBytes) / bytes,
                                 size_t(info.maxBufferTexels) / size_t(group.layout().stateElements()));
    const auto lanes = size_t(group.layout().lanes());
    const size_t reach = std::min(most, size_t(info.maxWorkGroupsX) * size_t(together));
    if (group.layout().padded(size_t(group.count)) <= reach) return;
    throw Error(group.life->cycle.location,
                concat("a capacity of ", group.count, " for \"", group.name,
                       "\" is more than this context holds in one storage block of ",
                       info.maxStorageBlockBytes >> 20, " MiB and one dispatch of ", info.maxWorkGroupsX,
                       " workgroups: at most ", reach / lanes * lanes));
}

// Storage offsets are multiples of so many words on any device.
constexpr size_t wordsApart = 64;

Births::Births(gpu::Context& context, const std::string& shaderRoot, const Plan& plan, const Tables& tables,
               const std::vector<int>& together, gpu::ProgramCache* cache)
    : BirthPasses(plan, wordsApart),
      context_(&context),
      tables_(&tables),
      buffers_(plan.groups.size()),
      lists_(context, shaderRoot, plan.groups.size(), size_t(mostPlaces(plan)), cache) {
    for (const auto& living : groups_)
        if (living) make(*living, shaderRoot, together[living->group], cache);
    if (diedWords_ > 0)
        died_ = Buffer(context, Buffer::Use::storage, nullptr, diedWords_ * sizeof(uint32_t), "deaths");
}

void Births::make(const Living& living, const std::string& shaderRoot, int together,
                  gpu::ProgramCache* cache) {
    const GroupPlan& group = *living.plan;
    checkPlaces(context_->info(), group, together);
    Buffers& buffers = buffers_[living.group];
    buffers.set = {group.count, living.group, together};
    const size_t bytes = PlaceLists::bytesOf(size_t(group.count));
    buffers.free = Buffer(*context_, Buffer::Use::storage, nullptr, bytes, "free places");
    if (group.life->feeds) {
        const std::vector<uint8_t> none(bytes);
        buffers.died = Buffer(*context_, Buffer::Use::storage, none.data(), bytes, "died");
    }
    if (!living.emits()) return;
    if (living.listed())
        buffers.places = Buffer(*context_, Buffer::Use::storage, nullptr,
                                group.layout().padded(size_t(group.count)) * sizeof(uint32_t), "places");
    buffers.spawn = &makeSpawn(*context_, shaderRoot, living, {}, cache);
}

void Births::bindStep(const Program& program, size_t group) const {
    program.storage("FreeBits", 4, buffers_[group].free);
    if (buffers_[group].died) program.storage("DiedBits", 5, buffers_[group].died);
    setAge(program, *groups_[group]);
}

void Births::dispatchStep(const Program& program, size_t group) const {
    if (groups_[group]->onGpu())
        return program.dispatchIndirect(lists_.control(),
                                        (control::of(group) + control::stepGroups) * sizeof(uint32_t));
    const int together = buffers_[group].set.stepLanes;
    program.dispatch((reachOf(*groups_[group]) + together - 1) / together);
}

void Births::step(const Frame& frame, std::vector<GroupBuffers>& state, gpu::PassTimers& timers) {
    if (order_.empty()) return;
    const auto timer = timers.time("births");
    settleBirths();
    for (const auto& living : groups_)
        if (living && living->plan->life->feeds)
            lists_.listDeaths(buffers_[living->group].set, buffers_[living->group].died, died_,
                              living->diedAt);
    for (const size_t g : order_)
        spawn(*groups_[g], frame, state);
    settleBirths();
}

void Births::countPlaces(const Living& living, int scheduled, bool allocates) {
    lists_.countPlaces(buffers_[living.group].set, buffers_[living.group].free, scheduled, deathsOf(living),
                       allocates);
}

void Births::bindBirths(const Living& living, std::vector<GroupBuffers>& state) const {
    const Buffers& own = buffers_[living.group];
    const Program& program = *own.spawn;
    const GroupBuffers& buffers = state[living.group];
    const GroupBuffers::Part& part = buffers.parts().front();
    store(program, "NewState", 0, buffers.currentState(part));
    store(program, "NewRecords", 1, buffers.records(part));
    if (buffers.hasConstants()) store(program, "NewConstants", 2, buffers.constants(part));
    if (living.listed()) program.storage("Places", 3, own.places);
    program.storage("FreeBits", 4, own.free);
    if (!living.deathRuns.empty()) program.storage("Died", 5, died_);
    program.storage("Control", 6, lists_.control());
    if (program.uses("samples") && tables_->sampleTexels)
        program.texture("samples", 3, tables_->sampleTexels);
    tables_->bindNoiseTiles(program, *plan_);
    int unit = 4;
    for (const DeathRun& run : living.deathRuns) {
        const GroupBuffers& source = state[run.source];
        const GroupBuffers::Part& sourcePart = source.parts().front();
        program.texture(concat("sourceStates", run.emitter).c_str(), unit++, source.oldState(sourcePart));
        program.texture(concat("sourceRecords", run.emitter).c_str(), unit++, sourcePart.record);
    }
}

void Births::spawn(Living& living, const Frame& frame, std::vector<GroupBuffers>& state) {
    const Newborns newborns = schedule(living, frame);
    Buffers& own = buffers_[living.group];
    if (living.onGpu()) {
        countPlaces(living, newborns.scheduled, true);
        if (newborns.scheduled == 0 && living.deathRuns.empty()) return;
        lists_.listPlaces(own.set, own.free, own.places);
    }
    if (newborns.born == 0) return;
    if (!newborns.places.empty())
        own.places.update(Traffic::Kind::births, 0, newborns.places.data(),
                          newborns.places.size() * sizeof(uint32_t));
    own.spawn->use();
    setNumbers(*own.spawn, living, newborns, frame);
    bindBirths(living, state);
    if (living.onGpu())
        own.spawn->dispatchIndirect(lists_.control(),
                                    (control::of(living.group) + control::birthGroups) * sizeof(uint32_t));
    else
        own.spawn->dispatch((newborns.born + birthLanes - 1) / birthLanes);
    settleBirths();
}

void Births::write(size_t group, const GroupState& state, double time) {
    Living& living = *groups_[group];
    Buffers& own = buffers_[group];
    std::vector<uint32_t> bits(own.free.bytes() / sizeof(uint32_t));
    for (size_t m = 0; m < state.lives.size(); ++m)
        if (!(state.lives[m].y > 0)) bits[m / 32] |= uint32_t(1) << (m % 32);
    own.free.update(Traffic::Kind::state, 0, bits.data(), own.free.bytes());
    const int together = own.set.stepLanes;
    const int groups = (living.count() + together - 1) / together;
    lists_.writeControl(group, begin(living, state, time, groups).data());
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
