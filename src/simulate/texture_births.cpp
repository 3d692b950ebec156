#include "simulate/texture_births.h"

#include <algorithm>

#include "gpu/gl.h"
#include "simulate/group_kernel.h"

namespace shoal {

using gpu::Format;
using gpu::Framebuffer;
using gpu::Program;
using gpu::Texture;
using gpu::Traffic;

namespace {

int rowsOf(size_t words) {
    return int((words + stateWidth - 1) / stateWidth);
}

Texture listOf(gpu::Context& context, size_t words, const char* label) {
    return Texture(context, Format::r32ui, stateWidth, std::max(1, rowsOf(words)), label);
}

void upload(const std::vector<uint32_t>& words, Texture& list) {
    const int rows = int(words.size() / stateWidth), rest = int(words.size() % stateWidth);
    const auto put = [&](int row, int width, int height) {
        if (width > 0 && height > 0)
            list.upload(Traffic::Kind::births, 0, row, width, height, &words[size_t(row) * stateWidth],
                        size_t(width) * size_t(height) * sizeof(uint32_t));
    };
    put(0, stateWidth, rows);
    put(rows, rest, 1);
}

}  // namespace

TextureBirths::TextureBirths(gpu::Context& context, const Plan& plan, const Tables& tables, int targets)
    : BirthPasses(plan, stateWidth),
      context_(&context),
      tables_(&tables),
      own_(plan.groups.size()),
      places_(context, plan),
      died_(listOf(context, diedWords_, "deaths")),
      newDied_(context, {&died_}, nullptr, "deaths") {
    for (const auto& living : groups_)
        if (living && living->emits()) make(*living, targets);
}

void TextureBirths::make(const Living& living, int targets) {
    Own& own = own_[living.group];
    if (living.listed()) {
        own.places = listOf(*context_, size_t(living.count()), "places");
        own.newPlaces = Framebuffer(*context_, {&own.places}, nullptr, "places");
    }
    own.spawn = &makeSpawn(*context_, living, targets);
}

int TextureBirths::bindStep(const Program& program, size_t group) const {
    const Living& living = *groups_[group];
    setAge(program, living);
    if (!living.onGpu()) return 3;
    program.texture("control", places_.control());
    program.set("controlBase", int(control::of(group)));
    program.set("stateRows", rowsOf(size_t(living.count())));
    return 6;
}

void TextureBirths::step(const Frame& frame, std::vector<GroupLayers>& state, gpu::PassTimers& timers) {
    if (order_.empty()) return;
    const auto timer = timers.time("births");
    gpu::drawPlainly();
    listDeaths(state);
    for (const size_t g : order_)
        spawn(*groups_[g], frame, state);
}

void TextureBirths::listDeaths(const std::vector<GroupLayers>& state) {
    for (const auto& living : groups_) {
        if (!living || !living->plan->life->feeds) continue;
        places_.sum(living->group, state[living->group], 0, living->count());
        places_.putDeaths();
        places_.listDeaths(newDied_, int(living->diedAt / stateWidth), rowsOf(size_t(living->count())));
    }
}

int TextureBirths::allocate(const Living& living, const Newborns& newborns, const GroupLayers& state) {
    Own& own = own_[living.group];
    if (living.onGpu()) {
        int64_t most = newborns.scheduled;
        for (const DeathRun& run : living.deathRuns)
            most += int64_t(run.each) * plan_->groups[run.source].count;
        most = std::min<int64_t>(most, living.count());
        places_.sum(living.group, state, 0, living.count());
        places_.putBirths(newborns.scheduled, deathsOf(living), true);
        if (most > 0) places_.listPlaces(own.newPlaces, rowsOf(size_t(most)));
        return int(most);
    }
    if (newborns.born == 0) return 0;
    if (!living.listed()) {
        places_.sum(living.group, state, newborns.firstPlace, newborns.born);
        places_.putCuts();
        return newborns.born;
    }
    upload(newborns.places, own.places);
    return newborns.born;
}

void TextureBirths::bindBirths(const Program& program, const Living& living,
                               const std::vector<GroupLayers>& state) const {
    if (living.listed()) program.texture("places", own_[living.group].places);
    program.texture("control", places_.control());
    if (!living.deathRuns.empty()) program.texture("died", died_);
    tables_->bind(program, *plan_);
    for (const DeathRun& run : living.deathRuns) {
        program.texture(concat("sourceStates", run.emitter).c_str(), state[run.source].state());
        program.texture(concat("sourceRecords", run.emitter).c_str(), state[run.source].records());
    }
}

void TextureBirths::spawn(Living& living, const Frame& frame, std::vector<GroupLayers>& state) {
    const Newborns newborns = schedule(living, frame);
    GroupLayers& layers = state[living.group];
    const int most = allocate(living, newborns, layers);
    if (most == 0) return;
    const Program& program = *own_[living.group].spawn;
    program.use();
    setNumbers(program, living, newborns, frame);
    program.set("stateRows", layers.state().height());
    bindBirths(program, living, state);
    for (const LayerDraw& draw : layers.newborns()) {
        program.set("firstStored", draw.first);
        draw.target.bind();
        gpu::drawVertices(most, GL_POINTS);
    }
}

void TextureBirths::write(size_t group, const GroupState& state, double time) {
    places_.writeControl(group, begin(*groups_[group], state, time));
}

void TextureBirths::read(size_t group, GroupState& state) const {
    uint32_t words[control::words];
    places_.readControl(group, words);
    readBooks(*groups_[group], words, state);
}

LifeCounts TextureBirths::counts(size_t group, const GroupLayers& state) {
    const Living& living = *groups_[group];
    if (!living.onGpu()) {
        gpu::drawPlainly();
        places_.sum(group, state, 0, living.count());
        places_.putBirths(0, deathsOf(living), false);
    }
    uint32_t words[control::words];
    places_.readControl(group, words);
    return countsOf(living, words);
}

}  // namespace shoal
