#include "simulate/births.h"

#include <algorithm>

#include "compile/generate_emitters.h"
#include "compile/pack.h"
#include "core/random.h"

namespace shoal {

using gpu::Buffer;
using gpu::Program;
using gpu::Traffic;

namespace {

void setPoint(const Program& program, const char* name, const glm::dvec3& point) {
    const SplitPoint split = splitPoint(point);
    const glm::vec4 parts[] = {glm::vec4(glm::vec3(split.lattice), 0), glm::vec4(glm::vec3(split.rest), 0)};
    program.set(name, std::span<const glm::vec4>(parts));
}

void checkPlaces(const gpu::ContextInfo& info, const GroupPlan& group) {
    const size_t bytes = size_t(group.layout().stateElements()) * sizeof(glm::vec4);
    const size_t most = std::min(size_t(info.maxStorageBlockBytes) / bytes,
                                 size_t(info.maxBufferTexels) / size_t(group.layout().stateElements()));
    const auto lanes = size_t(group.layout().lanes());
    const size_t reach = std::min(most, size_t(info.maxWorkGroupsX) * lanes);
    if (group.layout().padded(size_t(group.count)) <= reach) return;
    throw Error(group.life->cycle.location,
                concat("a capacity of ", group.count, " for \"", group.name,
                       "\" is more than this context holds in one storage block of ",
                       info.maxStorageBlockBytes >> 20, " MiB and one dispatch of ", info.maxWorkGroupsX,
                       " workgroups: at most ", reach / lanes * lanes));
}

}  // namespace

// Storage offsets are multiples of so many words on any device.
static size_t apart(size_t words) {
    return (words + 63) / 64 * 64;
}

static size_t mostPlaces(const Plan& plan) {
    size_t most = 0;
    for (const GroupPlan& group : plan.groups)
        if (group.life) most = std::max(most, size_t(group.count));
    return most;
}

Births::Births(gpu::Context& context, const std::string& shaderRoot, const Plan& plan, const Tables& tables,
               gpu::ProgramCache* cache)
    : context_(&context),
      plan_(&plan),
      tables_(&tables),
      groups_(plan.groups.size()),
      lists_(context, shaderRoot, plan.groups.size(), mostPlaces(plan), cache) {
    size_t died = 0;
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        if (!plan.groups[g].life) continue;
        make(g, shaderRoot, cache);
        Living& living = *groups_[g];
        living.diedAt = died;
        if (living.died) died += apart(size_t(living.plan->count));
    }
    order();
    if (died > 0) died_ = Buffer(context, Buffer::Use::storage, nullptr, died * sizeof(uint32_t), "deaths");
}

void Births::make(size_t g, const std::string& shaderRoot, gpu::ProgramCache* cache) {
    const GroupPlan& group = plan_->groups[g];
    checkPlaces(context_->info(), group);
    groups_[g] = std::make_unique<Living>();
    Living& living = *groups_[g];
    living.plan = &group;
    living.life = group.life->cycle;
    living.middles = group.life->middles;
    living.set = {group.count, g, group.layout().lanes()};
    const size_t bytes = PlaceLists::bytesOf(size_t(group.count));
    living.free = Buffer(*context_, Buffer::Use::storage, nullptr, bytes, "free places");
    if (group.life->feeds) {
        const std::vector<uint8_t> none(bytes);
        living.died = Buffer(*context_, Buffer::Use::storage, none.data(), bytes, "died");
    }
    if (!group.life->emits()) return;
    if (living.listed())
        living.places = Buffer(*context_, Buffer::Use::storage, nullptr,
                               group.layout().padded(size_t(group.count)) * sizeof(uint32_t), "places");
    for (size_t e = 0; e < living.life.emitters.size(); ++e)
        if (group.life->sources[e] != LifePlan::noSource)
            living.deathRuns.push_back({group.life->sources[e], int(e), living.life.emitters[e].perDeath});
    if (living.deathRuns.size() > mostDeathRuns)
        throw Error(living.life.location,
                    concat("\"", group.name, "\" is born from the deaths of ", living.deathRuns.size(),
                           " groups; at most ", mostDeathRuns, " are possible"));
    KernelOptions kernel;
    kernel.work = KernelOptions::Work::births;
    kernel.software = context_->info().software;
    gpu::ProgramOptions program = kernelProgram(*plan_, g, kernel);
    program.cache = cache;
    living.spawn = &programs_.get(*context_, shaderRoot, program);
    living.spawn->use();
    if (group.needs.fields)
        living.spawn->set("givenFieldParameters", std::span<const glm::vec4>(plan_->fieldParameters));
}

// Orders the groups that emit: emitters from a group's deaths read the dead in their places, so they come
// before that group emits into these.
void Births::order() {
    std::vector<bool> done(groups_.size());
    const auto visit = [&](const auto& self, size_t g) -> void {
        if (done[g]) return;
        done[g] = true;
        for (size_t other = 0; other < groups_.size(); ++other) {
            if (!groups_[other]) continue;
            for (const Living::DeathRun& run : groups_[other]->deathRuns)
                if (run.source == g) self(self, other);
        }
        if (groups_[g] && groups_[g]->spawn) order_.push_back(g);
    };
    for (size_t g = 0; g < groups_.size(); ++g)
        visit(visit, g);
}

void Births::bindStep(const Program& program, size_t group) const {
    const Living& living = *groups_[group];
    program.storage("FreeBits", 4, living.free);
    if (living.died) program.storage("DiedBits", 5, living.died);
    if (living.life.within) {
        setPoint(program, "livesAbove", living.life.within->low);
        setPoint(program, "livesBelow", living.life.within->high);
    }
    if (living.life.afterContact) program.set("afterContact", float(*living.life.afterContact));
}

void Births::dispatchStep(const Program& program, size_t group, int own) const {
    const Living& living = *groups_[group];
    if (living.spawn && living.onGpu())
        return program.dispatchIndirect(
            lists_.control(), (PlaceLists::controlAt(group) + control::stepGroups) * sizeof(uint32_t));
    program.dispatch((reachOf(living) + own - 1) / own);
}

// Returns how many places a step covers: as many as the one before needed, because what died one step ago is
// still alive on the other side of the state.
int Births::reachOf(const Living& living) const {
    if (!living.spawn || living.onGpu()) return living.plan->count;
    return std::max(markOf(living), living.markBefore);
}

int Births::markOf(const Living& living) const {
    if (living.listed()) return living.book.mark();
    const uint64_t used = uint64_t(living.plan->life->atStart) + living.born;
    return int(std::min(used, uint64_t(living.plan->count)));
}

void Births::step(const Frame& frame, std::vector<GroupBuffers>& state, gpu::PassTimers& timers) {
    if (order_.empty()) return;
    const auto timer = timers.time("births");
    settleBirths();
    for (size_t g = 0; g < groups_.size(); ++g)
        if (groups_[g] && groups_[g]->died)
            lists_.listDeaths(groups_[g]->set, groups_[g]->died, died_, groups_[g]->diedAt);
    for (const size_t g : order_)
        spawn(g, frame, state);
    settleBirths();
}

void Births::countPlaces(const Living& living, int scheduled, bool allocates) {
    std::vector<glm::ivec4> deaths;
    for (const Living::DeathRun& run : living.deathRuns)
        deaths.emplace_back(int(PlaceLists::controlAt(run.source)), run.each, 0, 0);
    lists_.countPlaces(living.set, living.free, scheduled, deaths, allocates);
}

int Births::takePlaces(Living& living, const std::vector<BirthRun>& runs, double end) {
    living.markBefore = living.book.mark();
    living.book.freeUntil(end);
    std::vector<uint32_t> places;
    for (const BirthRun& run : runs) {
        for (int j = 0; j < run.count; ++j) {
            const uint32_t seed = hash(hash(living.plan->life->seed, uint32_t(run.emitter)),
                                       uint32_t(run.ordinal) + uint32_t(j)) >>
                                  8;
            const int turn = j / run.each;
            const double moment = run.random ? double(hash(seed, bornTime) >> 8) / 16777216.0 : turn;
            const double dies = run.first + run.interval * moment + lifeOf(living.life.life, seed);
            uint32_t place = 0;
            if (!living.book.take(dies, place)) {
                living.lost += uint64_t(run.count - j);
                break;
            }
            places.push_back(place);
        }
    }
    living.born += places.size();
    if (!places.empty())
        living.places.update(Traffic::Kind::births, 0, places.data(), places.size() * sizeof(uint32_t));
    return int(places.size());
}

void Births::setRuns(const Living& living, const std::vector<BirthRun>& runs, double begin) const {
    const size_t most = size_t(std::max(1, mostRuns(living.life)));
    std::vector<glm::ivec4> numbers(most);
    std::vector<glm::vec4> times(most);
    int first = 0;
    for (size_t r = 0; r < runs.size(); ++r) {
        const BirthRun& run = runs[r];
        numbers[r] = {first, run.emitter, int(uint32_t(run.ordinal)), run.random ? 0 : run.each};
        times[r] = glm::vec4(float(run.first - begin), float(run.interval), 0, 0);
        first += run.count;
    }
    const Program& program = *living.spawn;
    program.set("runCount", int(runs.size()));
    program.set("runs", std::span<const glm::ivec4>(numbers));
    program.set("runTimes", std::span<const glm::vec4>(times));
    if (living.deathRuns.empty()) return;
    std::vector<glm::ivec4> deaths;
    for (const Living::DeathRun& run : living.deathRuns)
        deaths.emplace_back(run.emitter, run.each, int(groups_[run.source]->diedAt), 0);
    program.set("deathRuns", std::span<const glm::ivec4>(deaths));
}

void Births::setNumbers(size_t group, const Frame& frame) const {
    const Living& living = *groups_[group];
    const Program& program = *living.spawn;
    setStepUniforms(program, *plan_, *living.plan, frame);
    const std::vector<glm::vec4> parameters =
        emitterParameters(living.life, living.middles, frame.time, frame.parameters.frameTime);
    program.set("emitterParameters", std::span<const glm::vec4>(parameters));
    program.set("controlBase", int(PlaceLists::controlAt(group)));
    program.set("placeCount", living.plan->count);
    program.set("groupSeed", int(living.plan->life->seed));
    program.set("lifeSpan", glm::vec2(living.life.life));
    program.set("newbornScale", glm::vec2(living.life.scale));
    program.set("newbornSpin", glm::vec3(living.life.spin));
    program.set("newbornPhase", float(plan_->groups[group].phaseSpread));
}

void Births::bindBirths(size_t group, std::vector<GroupBuffers>& state) const {
    const Living& living = *groups_[group];
    const Program& program = *living.spawn;
    const GroupBuffers& buffers = state[group];
    const GroupBuffers::Part& part = buffers.parts().front();
    store(program, "NewState", 0, buffers.currentState(part));
    store(program, "NewRecords", 1, buffers.records(part));
    if (buffers.hasConstants()) store(program, "NewConstants", 2, buffers.constants(part));
    if (living.listed()) program.storage("Places", 3, living.places);
    program.storage("FreeBits", 4, living.free);
    if (!living.deathRuns.empty()) program.storage("Died", 5, died_);
    program.storage("Control", 6, lists_.control());
    if (program.uses("samples") && tables_->sampleTexels)
        program.texture("samples", 3, tables_->sampleTexels);
    int unit = 4;
    for (const Living::DeathRun& run : living.deathRuns) {
        const GroupBuffers& source = state[run.source];
        const GroupBuffers::Part& sourcePart = source.parts().front();
        program.texture(concat("sourceStates", run.emitter).c_str(), unit++, source.oldState(sourcePart));
        program.texture(concat("sourceRecords", run.emitter).c_str(), unit++, sourcePart.record);
    }
}

void Births::spawn(size_t group, const Frame& frame, std::vector<GroupBuffers>& state) {
    Living& living = *groups_[group];
    const double begin = frame.time, end = frame.end;
    std::vector<BirthRun> runs;
    for (size_t e = 0; e < living.life.emitters.size(); ++e)
        addRuns(living.life.emitters[e], int(e), living.plan->life->seed, begin, end, living.clocks[e], runs);
    int64_t asked = 0;
    for (const BirthRun& run : runs)
        asked += run.count;
    const int scheduled = int(std::min<int64_t>(asked, 1 << 30));
    int born = 0;
    if (living.onGpu()) {
        countPlaces(living, scheduled, true);
        if (scheduled == 0 && living.deathRuns.empty()) return;
        lists_.listPlaces(living.set, living.free, living.places);
    } else if (living.listed()) {
        born = takePlaces(living, runs, end);
    } else {
        living.markBefore = markOf(living);
        born = std::min(scheduled, living.plan->count);
        living.lost += uint64_t(scheduled - born);
    }
    if (!living.onGpu() && born == 0) return;
    living.spawn->use();
    setNumbers(group, frame);
    setRuns(living, runs, begin);
    bindBirths(group, state);
    living.spawn->set("givenBorn", living.onGpu() ? -1 : born);
    if (living.onGpu()) {
        living.spawn->dispatchIndirect(
            lists_.control(), (PlaceLists::controlAt(group) + control::birthGroups) * sizeof(uint32_t));
    } else {
        if (!living.listed()) {
            living.spawn->set("firstPlace", int((uint64_t(living.plan->life->atStart) + living.born) %
                                                uint64_t(living.plan->count)));
            living.born += uint64_t(born);
        }
        living.spawn->dispatch((born + birthLanes - 1) / birthLanes);
    }
    settleBirths();
}

void Births::write(size_t group, const GroupState& state, double time) {
    Living& living = *groups_[group];
    std::vector<uint32_t> bits(living.free.bytes() / sizeof(uint32_t));
    uint32_t live = 0;
    for (size_t m = 0; m < state.lives.size(); ++m) {
        if (state.lives[m].y > 0)
            ++live;
        else
            bits[m / 32] |= uint32_t(1) << (m % 32);
    }
    living.free.update(Traffic::Kind::state, 0, bits.data(), living.free.bytes());
    // the whole capacity: the other side of the state is what it was before
    const auto all = uint32_t(living.plan->count);
    std::vector<uint32_t> words(control::words);
    words[control::live] = live;
    words[control::mark] = all;
    words[control::lost] = uint32_t(state.totals[1]);
    words[control::bornEver] = uint32_t(state.totals[0]);
    words[control::stepGroups] = (all + uint32_t(living.set.stepLanes) - 1) / uint32_t(living.set.stepLanes);
    for (const size_t xyz : {control::birthGroups, control::stepGroups})
        words[xyz + 1] = words[xyz + 2] = 1;
    lists_.writeControl(group, words.data());
    living.markBefore = int(all);
    living.clocks = state.clocks;
    living.clocks.resize(living.life.emitters.size());
    living.born = state.totals[0];
    living.lost = living.listed() ? state.totals[1] : 0;
    if (!living.spawn || living.onGpu() || !living.listed()) return;
    living.book = Places(living.allocator(), size_t(living.plan->count));
    living.book.restore(state.ends, state.freed, time);
}

uint64_t Births::bornOf(const Living& living, const uint32_t* words) {
    return living.onGpu() ? words[control::bornEver] : living.born;
}

// The ring counts the lives that it cuts short on the GPU, and births beyond its capacity here.
uint64_t Births::lostOf(const Living& living, const uint32_t* words) {
    if (living.onGpu()) return words[control::lost];
    return living.listed() ? living.lost : living.lost + words[control::lost];
}

void Births::read(size_t group, GroupState& state) const {
    const Living& living = *groups_[group];
    state.clocks = living.clocks;
    uint32_t words[control::words];
    lists_.readControl(group, words);
    state.totals = {bornOf(living, words), lostOf(living, words)};
    if (!living.spawn || living.onGpu() || !living.listed()) return;
    state.ends = living.book.ends();
    state.freed = living.book.stack();
}

LifeCounts Births::counts(size_t group) {
    const Living& living = *groups_[group];
    if (!living.onGpu() || !living.spawn) {
        settleBirths();
        countPlaces(living, 0, false);
    }
    uint32_t words[control::words];
    lists_.readControl(group, words);
    LifeCounts out;
    out.capacity = living.plan->count;
    out.live = int(words[control::live]);
    out.mark = int(words[control::mark]);
    out.born = bornOf(living, words);
    out.lost = lostOf(living, words);
    return out;
}

bool Births::change(size_t group, const Lifecycle& life) {
    Living& living = *groups_[group];
    const Lifecycle& now = living.life;
    bool same = life.emitters.size() == now.emitters.size() && life.capacity == now.capacity &&
                life.allocator == now.allocator && life.turn == now.turn &&
                life.within.has_value() == now.within.has_value() &&
                life.afterContact.has_value() == now.afterContact.has_value() &&
                ((life.scale == glm::dvec2(1)) == (now.scale == glm::dvec2(1)));
    for (size_t e = 0; same && e < life.emitters.size(); ++e)
        same = sameText(life.emitters[e], now.emitters[e]);
    if (!same) return false;
    for (size_t e = 0; e < life.emitters.size(); ++e)
        if (life.emitters[e].from != Emitter::From::surface)
            living.middles[e] = placeOf(life.emitters[e], {}).middle;
    living.life = life;
    for (Living::DeathRun& run : living.deathRuns)
        run.each = life.emitters[size_t(run.emitter)].perDeath;
    return true;
}

}  // namespace shoal
