#include "simulate/birth_passes.h"

#include <algorithm>
#include <bit>

#include "compile/generate_emitters.h"
#include "compile/pack.h"
#include "core/random.h"
#include "gpu/framebuffer.h"

namespace shoal {

using gpu::Program;
using gpu::Traffic;

// Two textures of each, beside at most seven of the group, of the 16 that any device has.
constexpr size_t mostDeathRuns = 4;
constexpr int64_t mostScheduled = 1 << 30;  // newborns of a step: none beyond finds a place

static void setPoint(const Program& program, const char* name, const glm::dvec3& point) {
    const SplitPoint split = splitPoint(point);
    const glm::vec4 parts[] = {glm::vec4(glm::vec3(split.lattice), 0), glm::vec4(glm::vec3(split.rest), 0)};
    program.set(name, std::span<const glm::vec4>(parts));
}

static int roundedUp(int64_t count, int64_t unit) {
    return int((count + unit - 1) / unit * unit);
}

// The levels of a tree over so many places: where in its array, and how many fours of nodes. Every other
// level lies in the same array, from multiples of `apart` on.
static std::vector<glm::ivec4> treeOver(int places, int apart) {
    std::vector<glm::ivec4> out;
    int firsts[2] = {0, 0};
    for (int nodes = (places + 31) / 32;; nodes = (nodes + 31) / 32) {
        int& first = firsts[out.size() % 2];
        const int fours = roundedUp((nodes + 3) / 4, 64);  // whole workgroups
        out.emplace_back(first, fours, 0, 0);
        first = roundedUp(first + fours, apart);
        if (nodes <= 32) return out;
    }
}

BirthPasses::BirthPasses(gpu::Context& context, const Plan& plan, const Tables& tables, Form form,
                         std::vector<glm::ivec4> parts)
    : plan_(&plan),
      groups_(makeGroups(parts, form)),
      table_(context.shaders() + "/births/arrays.txt", form),
      arrays_(context, table_, sizes(context.info(), form), "births"),
      tables_(&tables) {
    makeOrder();
    makePrograms(context);
}

std::vector<std::unique_ptr<BirthPasses::Living>> BirthPasses::makeGroups(
    const std::vector<glm::ivec4>& parts, Form form) const {
    // ranges of arrays begin with a row of texels
    const int apart = form == Form::textures ? stateWidth : 1;
    std::vector<std::unique_ptr<Living>> out(plan_->groups.size());
    int words = 0, deaths = 0, partCount = 0;
    for (size_t g = 0; g < plan_->groups.size(); ++g) {
        const GroupPlan& group = plan_->groups[g];
        if (!group.life) continue;
        out[g] = std::make_unique<Living>();
        Living& living = *out[g];
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
        living.tree = treeOver(group.count, apart);
        living.parts = parts[g];
        living.parts.x = partCount;
        partCount += living.parts.y;
        living.firstWord = words;
        words += roundedUp(living.words(), apart);
        living.firstDeath = deaths;
        if (group.life->feeds) deaths += roundedUp(group.count, apart);
    }
    return out;
}

gpu::ArraySizes BirthPasses::sizes(const gpu::ContextInfo& info, Form form) const {
    size_t words = 1, nodes = 1, places = 1, deaths = 1, parts = 1;
    const size_t block = size_t(info.maxStorageBlockBytes) / sizeof(uint32_t);
    for (const auto& living : groups_) {
        if (!living) continue;
        const auto need = [&](size_t wanted, size_t most, const char* what) {
            if (form == Form::buffers && wanted > most)
                throw Error(living->life.location,
                            concat("a capacity of ", living->count(), " for \"", living->plan->name,
                                   "\" is more than this context holds ", what, " of: at most ", most));
        };
        words = size_t(living->firstWord) + size_t(living->words());
        need(words * 32, block * 32, "bits");
        for (const glm::ivec4& level : living->tree)
            nodes = std::max(nodes, size_t(level.x) + size_t(level.y));
        if (living->booked()) places = std::max(places, size_t(living->count()));
        need(places, size_t(info.maxBufferTexels), "a list");
        if (living->plan->life->feeds) deaths = size_t(living->firstDeath) + size_t(living->count());
        need(deaths, std::min(block, size_t(info.maxBufferTexels)), "a list of deaths");
        parts = size_t(living->parts.x) + size_t(living->parts.y);
    }
    return {{{"word", words},
             {"node", nodes},
             {"place", places},
             {"death", deaths},
             {"group", plan_->groups.size()},
             {"part", parts}},
            0,
            std::countr_zero(unsigned(stateWidth))};
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

void BirthPasses::makePrograms(gpu::Context& context) {
    const bool textures = table_.form() == Form::textures;
    sums_ = Program(context, arrays_.passOptions("births/sums", "sums of places"));
    gpu::ProgramOptions control = arrays_.passOptions("births/control", "control of births");
    control.defines.push_back(concat("MOST_DEATH_RUNS ", mostDeathRuns));
    control.defines.push_back(concat("BIRTH_LANES ", birthLanes));
    control.defines.push_back(concat("MOST_GROUPS ", mostGroups));
    control_ = Program(context, control);
    list_ = Program(context, arrays_.passOptions("births/list", "list of deaths"));
    for (const auto& living : groups_) {
        if (!living) continue;
        gpu::ProgramOptions bits = arrays_.passOptions("births/sums", "bits of places");
        bits.defines.emplace_back("BITS");
        if (textures)
            for (const std::string& define : living->plan->layout().defines(true))
                bits.defines.push_back(define);
        living->bits = &programs_.get(context, bits);
        if (!living->emits()) continue;
        KernelOptions kernel;
        kernel.work = KernelOptions::Work::births;
        if (textures) kernel.targets = context.info().maxColorAttachments;
        kernel.software = context.info().software;
        gpu::ProgramOptions spawn = kernelProgram(*plan_, living->group, kernel);
        spawn.arrays = &table_;
        living->spawn = &programs_.get(context, spawn);
    }
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
    return std::max({markOf(living), living.marksBefore[0], living.marksBefore[1]});
}

int BirthPasses::markOf(const Living& living) const {
    if (living.listed()) return living.book.mark();
    const uint64_t used = uint64_t(living.plan->life->atStart) + living.born;
    return int(std::min(used, uint64_t(living.count())));
}

void BirthPasses::setTree(const Program& program, const Living& living) const {
    program.set("tree", std::span<const glm::ivec4>(living.tree));
    program.set("levels", living.levels());
}

// Both arrays of sums are written in turn.
void BirthPasses::sum(const Living& living, bool ofDeaths, int firstPlace, int count) {
    arrays_.use(*living.bits);
    bindPlaces(*living.bits, living);
    living.bits->set("ofDeaths", int(ofDeaths));
    living.bits->set("placeCount", living.count());
    living.bits->set("firstPlace", firstPlace);
    living.bits->set("askedFor", count);
    arrays_.run(*living.bits, 0, living.tree[0].y);
    for (size_t level = 1; level < living.tree.size(); ++level) {
        const glm::ivec4 below = living.tree[level - 1];
        arrays_.swap("sums", "sumsBelow");
        arrays_.use(sums_).set("below", glm::ivec4(below.x, below.y, int(level == 1), 0));
        arrays_.run(sums_, living.tree[level].x, living.tree[level].y);
    }
}

void BirthPasses::renew(const Living& living, Renewal renewal, int summed, int scheduled) {
    arrays_.use(control_);
    setTree(control_, living);
    control_.set("group", int(living.group));
    control_.set("renewal", int(renewal));
    control_.set("summedPlaces", summed);
    control_.set("scheduled", scheduled);
    std::vector<glm::ivec4> deaths;
    for (const DeathRun& run : living.deathRuns)
        deaths.emplace_back(int(run.source), run.each, 0, 0);
    control_.set("deathRunCount", int(deaths.size()));
    control_.set("deathRuns", std::span<const glm::ivec4>(deaths));
    control_.set("parts", living.parts);
    arrays_.run(control_, 0, int(groups_.size()));
    arrays_.swap("control", "nextControl");
}

void BirthPasses::listDeaths(const Living& living) {
    sum(living, true, 0, living.count());
    renew(living, Renewal::deaths, living.count());
    arrays_.use(list_).set("group", int(living.group));
    setTree(list_, living);
    constexpr int most = 4095 * stateWidth;  // lanes that any device takes in one dispatch, and whole rows
    for (int first = 0; first < living.count(); first += most) {
        list_.set("firstRank", first);
        arrays_.run(list_, living.firstDeath + first, std::min(most, living.count() - first));
    }
}

void BirthPasses::begin() {
    if (table_.form() == Form::textures) gpu::drawPlainly();
    arrays_.settle();
}

void BirthPasses::step(const Frame& frame, gpu::PassTimers& timers) {
    if (order_.empty()) return;
    const auto timer = timers.time("births");
    begin();
    for (const auto& living : groups_)
        if (living && living->plan->life->feeds) listDeaths(*living);
    for (const size_t g : order_)
        bear(*groups_[g], frame);
    arrays_.settle();
}

int BirthPasses::mostBorn(const Living& living, const Newborns& newborns) const {
    if (!living.onGpu()) return newborns.born;
    int64_t most = newborns.scheduled;
    for (const DeathRun& run : living.deathRuns)
        most += int64_t(run.each) * plan_->groups[run.source].count;
    return int(std::min<int64_t>(most, living.count()));
}

void BirthPasses::bear(Living& living, const Frame& frame) {
    const Newborns newborns = schedule(living, frame);
    const int most = mostBorn(living, newborns);
    if (living.onGpu()) {
        sum(living, false, 0, living.count());
        renew(living, Renewal::births, living.count(), newborns.scheduled);
    }
    if (most == 0) return;
    if (!living.listed() && table_.form() == Form::textures) {  // in buffers the newborn notice
        sum(living, false, newborns.firstPlace, most);
        renew(living, Renewal::cuts, most);
    }
    if (!newborns.places.empty())
        arrays_.write("places", Traffic::Kind::births, newborns.places.data(), newborns.places.size());
    arrays_.settle();
    arrays_.use(*living.spawn);
    setTree(*living.spawn, living);
    setNumbers(living, newborns, frame);
    tables_->bind(*living.spawn, *plan_);
    spawn(*living.spawn, living, most);
    arrays_.settle();
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
    living.marksBefore = {markOf(living), living.marksBefore[0]};
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

void BirthPasses::setNumbers(const Living& living, const Newborns& newborns, const Frame& frame) const {
    const Program& spawn = *living.spawn;
    setStepUniforms(spawn, *plan_, *living.plan, frame);
    const std::vector<glm::vec4> parameters =
        emitterParameters(living.life, living.middles, frame.time, frame.parameters.frameTime);
    spawn.set("emitterParameters", std::span<const glm::vec4>(parameters));
    spawn.set("group", int(living.group));
    spawn.set("placeCount", living.count());
    spawn.set("groupSeed", int(living.plan->life->seed));
    spawn.set("lifeSpan", glm::vec2(living.life.life));
    spawn.set("newbornScale", glm::vec2(living.life.scale));
    spawn.set("newbornSpin", glm::vec3(living.life.spin));
    spawn.set("newbornPhase", float(living.plan->phaseSpread));
    spawn.set("givenBorn", newborns.born);
    spawn.set("firstPlace", newborns.firstPlace);

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
        deaths.emplace_back(run.emitter, run.each, groups_[run.source]->firstDeath, 0);
    spawn.set("deathRuns", std::span<const glm::ivec4>(deaths));
}

void BirthPasses::write(size_t group, const GroupState& state, double time) {
    Living& living = *groups_[group];
    // the whole capacity: the other side of the state is what it was before
    const auto all = uint32_t(living.count());
    uint32_t words[control::words] = {};
    words[control::live] = uint32_t(std::count_if(state.lives.begin(), state.lives.end(),
                                                  [](const glm::vec2& life) { return life.y > 0; }));
    words[control::mark] = all;
    words[control::lost] = uint32_t(state.totals[1]);
    words[control::bornEver] = uint32_t(state.totals[0]);
    arrays_.writeElement("control", Traffic::Kind::state, group, words);
    living.marksBefore = {living.count(), living.count()};
    living.clocks = state.clocks;
    living.clocks.resize(living.life.emitters.size());
    living.born = state.totals[0];
    living.lost = living.listed() ? state.totals[1] : 0;
    if (living.booked()) {
        living.book = Places(living.allocator(), size_t(living.count()));
        living.book.restore(state.ends, state.freed, time);
    }
    writePlaces(living, state);
}

LifeCounts BirthPasses::countsOf(const Living& living) const {
    uint32_t words[control::words];
    arrays_.readElement("control", Traffic::Kind::control, living.group, words);
    LifeCounts out;
    out.capacity = living.count();
    out.live = int(words[control::live]);
    out.mark = int(words[control::mark]);
    const bool onGpu = living.allocator() == Allocator::gpu;
    out.born = onGpu ? words[control::bornEver] : living.born;
    // the ring counts the lives that it cuts short on the GPU, and births beyond its capacity here
    out.lost = (onGpu ? 0 : living.lost) + (onGpu || !living.listed() ? words[control::lost] : 0);
    return out;
}

void BirthPasses::read(size_t group, GroupState& state) const {
    const Living& living = *groups_[group];
    const LifeCounts counts = countsOf(living);
    state.clocks = living.clocks;
    state.totals = {counts.born, counts.lost};
    if (!living.booked()) return;
    state.ends = living.book.ends();
    state.freed = living.book.stack();
}

LifeCounts BirthPasses::counts(size_t group) {
    const Living& living = *groups_[group];
    if (!living.onGpu()) {
        begin();
        sum(living, false, 0, living.count());
        renew(living, Renewal::counts, living.count());
    }
    return countsOf(living);
}

bool BirthPasses::change(size_t group, const Lifecycle& life) {
    Living& living = *groups_[group];
    const Lifecycle& present = living.life;
    bool same = life.emitters.size() == present.emitters.size() && life.capacity == present.capacity &&
                life.allocator == present.allocator && life.turn == present.turn &&
                life.within.has_value() == present.within.has_value() &&
                life.afterContact.has_value() == present.afterContact.has_value() &&
                ((life.scale == glm::dvec2(1)) == (present.scale == glm::dvec2(1)));
    for (size_t e = 0; same && e < life.emitters.size(); ++e)
        same = sameText(life.emitters[e], present.emitters[e]);
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
