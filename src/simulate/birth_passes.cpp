#include "simulate/birth_passes.h"

#include <algorithm>

#include "compile/generate_emitters.h"
#include "compile/pack.h"
#include "core/random.h"

namespace shoal {

using gpu::Program;

constexpr int64_t mostScheduled = 1 << 30;  // newborns of a step: none beyond finds a place

static void setPoint(const Program& program, const char* name, const glm::dvec3& point) {
    const SplitPoint split = splitPoint(point);
    const glm::vec4 parts[] = {glm::vec4(glm::vec3(split.lattice), 0), glm::vec4(glm::vec3(split.rest), 0)};
    program.set(name, std::span<const glm::vec4>(parts));
}

BirthPasses::BirthPasses(const Plan& plan, size_t apart) : plan_(&plan), groups_(plan.groups.size()) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& group = plan.groups[g];
        if (!group.life) continue;
        groups_[g] = std::make_unique<Living>();
        Living& living = *groups_[g];
        living.plan = &group;
        living.group = g;
        living.life = group.life->cycle;
        living.middles = group.life->middles;
        for (size_t e = 0; e < living.life.emitters.size(); ++e)
            if (group.life->sources[e] != LifePlan::noSource)
                living.deathRuns.push_back(
                    {group.life->sources[e], int(e), living.life.emitters[e].perDeath});
        if (living.deathRuns.size() > mostDeathRuns)
            throw Error(living.life.location,
                        concat("\"", group.name, "\" is born from the deaths of ", living.deathRuns.size(),
                               " groups; at most ", mostDeathRuns, " are possible"));
        living.diedAt = diedWords_;
        if (group.life->feeds) diedWords_ += (size_t(group.count) + apart - 1) / apart * apart;
    }
    makeOrder();
}

// Orders the groups that emit: emitters from a group's deaths read the dead in their places, so they come
// before that group emits into these.
void BirthPasses::makeOrder() {
    std::vector<bool> done(groups_.size());
    const auto visit = [&](const auto& self, size_t g) -> void {
        if (done[g]) return;
        done[g] = true;
        for (size_t other = 0; other < groups_.size(); ++other) {
            if (!groups_[other]) continue;
            for (const DeathRun& run : groups_[other]->deathRuns)
                if (run.source == g) self(self, other);
        }
        if (groups_[g] && groups_[g]->emits()) order_.push_back(g);
    };
    for (size_t g = 0; g < groups_.size(); ++g)
        visit(visit, g);
}

const Program& BirthPasses::makeSpawn(gpu::Context& context, const Living& living,
                                      std::optional<int> targets) {
    KernelOptions kernel;
    kernel.work = KernelOptions::Work::births;
    kernel.targets = targets;
    kernel.software = context.info().software;
    gpu::ProgramOptions program = kernelProgram(*plan_, living.group, kernel);
    return programs_.get(context, program);
}

void BirthPasses::setAge(const Program& step, const Living& living) const {
    if (living.life.within) {
        setPoint(step, "livesAbove", living.life.within->low);
        setPoint(step, "livesBelow", living.life.within->high);
    }
    if (living.life.afterContact) step.set("afterContact", float(*living.life.afterContact));
}

int BirthPasses::reachOf(const Living& living) const {
    if (!living.emits() || living.onGpu()) return living.count();
    return std::max(markOf(living), living.markBefore);
}

int BirthPasses::markOf(const Living& living) const {
    if (living.listed()) return living.book.mark();
    const uint64_t used = uint64_t(living.plan->life->atStart) + living.born;
    return int(std::min(used, uint64_t(living.count())));
}

std::vector<glm::ivec4> BirthPasses::deathsOf(const Living& living) const {
    std::vector<glm::ivec4> out;
    for (const DeathRun& run : living.deathRuns)
        out.emplace_back(int(control::of(run.source)), run.each, 0, 0);
    return out;
}

BirthPasses::Newborns BirthPasses::schedule(Living& living, const Frame& frame) {
    Newborns out;
    for (size_t e = 0; e < living.life.emitters.size(); ++e)
        addRuns(living.life.emitters[e], int(e), living.plan->life->seed, frame.time, frame.end,
                living.clocks[e], out.runs);
    int64_t asked = 0;
    for (const BirthRun& run : out.runs)
        asked += run.count;
    out.scheduled = int(std::min(asked, mostScheduled));
    if (living.onGpu()) {
        out.born = -1;
        return out;
    }
    living.markBefore = markOf(living);
    if (living.listed()) {
        takePlaces(living, frame.end, out);
        return out;
    }
    out.born = std::min(out.scheduled, living.count());
    out.firstPlace = int((uint64_t(living.plan->life->atStart) + living.born) % uint64_t(living.count()));
    living.lost += uint64_t(out.scheduled - out.born);
    living.born += uint64_t(out.born);
    return out;
}

void BirthPasses::takePlaces(Living& living, double end, Newborns& newborns) {
    living.book.freeUntil(end);
    for (const BirthRun& run : newborns.runs) {
        for (int j = 0; j < run.count; ++j) {
            const uint32_t seed = hash(hash(living.plan->life->seed, uint32_t(run.emitter)),
                                       uint32_t(run.ordinal) + uint32_t(j)) >>
                                  8;
            const int turn = j / run.each;
            const double moment = run.random ? uniformFrom(hash(seed, bornTime)) : turn;
            const double dies = run.first + run.interval * moment + lifeOf(living.life.life, seed);
            uint32_t place = 0;
            if (!living.book.take(dies, place)) {
                living.lost += uint64_t(run.count - j);
                break;
            }
            newborns.places.push_back(place);
        }
    }
    newborns.born = int(newborns.places.size());
    living.born += newborns.places.size();
}

void BirthPasses::setNumbers(const Program& spawn, const Living& living, const Newborns& newborns,
                             const Frame& frame) const {
    setStepUniforms(spawn, *plan_, *living.plan, frame);
    const std::vector<glm::vec4> parameters =
        emitterParameters(living.life, living.middles, frame.time, frame.parameters.frameTime);
    spawn.set("emitterParameters", std::span<const glm::vec4>(parameters));
    spawn.set("controlBase", int(control::of(living.group)));
    spawn.set("placeCount", living.count());
    spawn.set("groupSeed", int(living.plan->life->seed));
    spawn.set("lifeSpan", glm::vec2(living.life.life));
    spawn.set("newbornScale", glm::vec2(living.life.scale));
    spawn.set("newbornSpin", glm::vec3(living.life.spin));
    spawn.set("newbornPhase", float(living.plan->phaseSpread));
    spawn.set("givenBorn", newborns.born);
    if (!living.listed()) spawn.set("firstPlace", newborns.firstPlace);

    const size_t most = size_t(std::max(1, mostRuns(living.life)));
    std::vector<glm::ivec4> numbers(most);
    std::vector<glm::vec4> times(most);
    int64_t first = 0;
    for (size_t r = 0; r < newborns.runs.size(); ++r) {
        const BirthRun& run = newborns.runs[r];
        numbers[r] = {int(std::min(first, mostScheduled)), run.emitter, int(uint32_t(run.ordinal)),
                      run.random ? 0 : run.each};
        times[r] = glm::vec4(float(run.first - frame.time), float(run.interval), 0, 0);
        first += run.count;
    }
    spawn.set("runCount", int(newborns.runs.size()));
    spawn.set("runs", std::span<const glm::ivec4>(numbers));
    spawn.set("runTimes", std::span<const glm::vec4>(times));
    if (living.deathRuns.empty()) return;
    std::vector<glm::ivec4> deaths;
    for (const DeathRun& run : living.deathRuns)
        deaths.emplace_back(run.emitter, run.each, int(groups_[run.source]->diedAt), 0);
    spawn.set("deathRuns", std::span<const glm::ivec4>(deaths));
}

std::vector<uint32_t> BirthPasses::begin(Living& living, const GroupState& state, double time) {
    // the whole capacity: the other side of the state is what it was before
    const auto all = uint32_t(living.count());
    std::vector<uint32_t> words(control::words);
    words[control::live] = uint32_t(std::count_if(state.lives.begin(), state.lives.end(),
                                                  [](const glm::vec2& life) { return life.y > 0; }));
    words[control::mark] = all;
    words[control::lost] = uint32_t(state.totals[1]);
    words[control::bornEver] = uint32_t(state.totals[0]);
    words[control::birthGroups + 1] = words[control::birthGroups + 2] = 1;
    living.markBefore = int(all);
    living.clocks = state.clocks;
    living.clocks.resize(living.life.emitters.size());
    living.born = state.totals[0];
    living.lost = living.listed() ? state.totals[1] : 0;
    if (living.booked()) {
        living.book = Places(living.allocator(), size_t(living.count()));
        living.book.restore(state.ends, state.freed, time);
    }
    return words;
}

uint64_t BirthPasses::bornOf(const Living& living, const uint32_t* words) {
    return living.allocator() == Allocator::gpu ? words[control::bornEver] : living.born;
}

// The ring counts the lives that it cuts short on the GPU, and births beyond its capacity here.
uint64_t BirthPasses::lostOf(const Living& living, const uint32_t* words) {
    if (living.allocator() == Allocator::gpu) return words[control::lost];
    return living.listed() ? living.lost : living.lost + words[control::lost];
}

void BirthPasses::readBooks(const Living& living, const uint32_t* words, GroupState& state) const {
    state.clocks = living.clocks;
    state.totals = {bornOf(living, words), lostOf(living, words)};
    if (!living.booked()) return;
    state.ends = living.book.ends();
    state.freed = living.book.stack();
}

LifeCounts BirthPasses::countsOf(const Living& living, const uint32_t* words) const {
    LifeCounts out;
    out.capacity = living.count();
    out.live = int(words[control::live]);
    out.mark = int(words[control::mark]);
    out.born = bornOf(living, words);
    out.lost = lostOf(living, words);
    return out;
}

bool BirthPasses::change(size_t group, const Lifecycle& life) {
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
    for (DeathRun& run : living.deathRuns)
        run.each = life.emitters[size_t(run.emitter)].perDeath;
    return true;
}

}  // namespace shoal
