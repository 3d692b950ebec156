#include "simulate/school.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/buffer.h"

namespace shoal {

using gpu::Barrier;
using gpu::Program;
using gpu::Texel;

namespace {

constexpr size_t lanes = 64;     // of a workgroup, as the shaders say
constexpr double endless = 1e9;  // m

void settled() {
    gpu::barrier({Barrier::textureFetch, Barrier::storage});
}

void dispatch(const Program& program, int count) {
    program.dispatch(int((size_t(count) + lanes - 1) / lanes));
}

void checkLimits(const gpu::ContextInfo& info, const SchoolPlan& school, const Location& location) {
    const size_t block = size_t(info.maxStorageBlockBytes) / 16, texels = size_t(info.maxBufferTexels);
    const size_t most = std::min({block / bodyElements, texels / bodyElements,
                                  size_t(info.maxWorkGroupsX) * lanes, RadixSort::most(info), texels / 4});
    const auto wanted = size_t(std::max(school.bodyCount, school.entries));
    if (wanted <= most) return;
    throw Error(location,
                concat("a school of ", wanted, " molecules is more than this context holds: at most ", most));
}

constexpr double wanderPeriod = 512 * std::numbers::pi;  // s, of shaders/physics/school.glsl

// s: after which all muscles are where they were; without any, a long time.
double clockPeriodOf(const GroupPlan& group) {
    return group.musclePeriod > 0 ? group.musclePeriod : 1e5;
}

bool sameTargets(const std::vector<SchoolTarget>& a, const std::vector<SchoolTarget>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const SchoolTarget& x, const SchoolTarget& y) { return x.group == y.group; });
}

}  // namespace

Schooling::Schooling(gpu::Context& context, const std::string& shaderRoot, const Plan& plan,
                     const Tables& tables, gpu::ProgramCache* cache)
    : context_(&context),
      plan_(&plan),
      school_(&plan.school),
      tables_(&tables),
      sort_((checkLimits(context.info(), plan.school, plan.school.members[0].school.location), context),
            shaderRoot, size_t(plan.school.entries), cache) {
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
    makePrograms(shaderRoot, cache);
    for (const SchoolMember& member : school_->members)
        makeSteer(member, shaderRoot, cache);
}

void Schooling::makePrograms(const std::string& shaderRoot, gpu::ProgramCache* cache) {
    const auto make = [&](const char* file) {
        gpu::ProgramOptions options;
        options.compute = concat("school/", file, ".comp");
        options.label = concat("school ", file);
        options.cache = cache;
        return Program(*context_, shaderRoot, options);
    };
    keys_ = make("keys");
    order_ = make("order");
    for (const SchoolBodies& bodies : school_->bodies) {
        const GroupPlan& group = plan_->groups[bodies.group];
        gpu::ProgramOptions options;
        options.label = concat("bodies of ", group.name);
        options.defines = group.layout().defines();
        options.generated = {{"generated/body.glsl", bodies.text}};
        options.compute = "school/body.comp";
        options.cache = cache;
        bodyPrograms_.push_back(&programs_.get(*context_, shaderRoot, options));
    }
}

void Schooling::makeSteer(const SchoolMember& member, const std::string& shaderRoot,
                          gpu::ProgramCache* cache) {
    const GroupPlan& group = plan_->groups[member.group];
    gpu::ProgramOptions options;
    options.compute = "school/steer.comp";
    options.label = concat("steering of ", group.name);
    options.cache = cache;
    options.defines = {concat("TARGETS ", member.targetGrids.size()),
                       concat("CLOCK_PERIOD float(", clockPeriodOf(group), ")")};
    if (group.needs.avoids) options.defines.push_back("WALLS");
    options.generated = {{"generated/colliders.glsl", plan_->collideSource}};
    members_.push_back({&programs_.get(*context_, shaderRoot, options), member.school});
}

// m: what is looked for within a radius needs cells as wide.
double Schooling::cellOf(size_t grid) const {
    for (size_t m = 0; m < members_.size(); ++m) {
        const SchoolMember& member = school_->members[m];
        const School& school = members_[m].school;
        if (member.grid == grid) return school.radius;
        for (size_t t = 0; t < member.targetGrids.size(); ++t)
            if (member.targetGrids[t] == grid)
                return t < school.flees.size() ? school.flees[t].radius
                                               : school.hunts[t - school.flees.size()].radius;
    }
    return 1;
}

void Schooling::findBodies(const std::vector<GroupBuffers>& state) {
    for (size_t b = 0; b < bodyPrograms_.size(); ++b) {
        const SchoolBodies& bodies = school_->bodies[b];
        const Program& program = *bodyPrograms_[b];
        program.use();
        program.set("origin", glm::vec3(school_->origin));
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
    keys_.use();
    keys_.texture("bodies", 0, bodiesRead_);
    keys_.storage("Pairs", 0, pairs_);
    for (size_t g = 0; g < school_->grids.size(); ++g) {
        const SchoolGrid& grid = school_->grids[g];
        keys_.set("entries", grid.entries);
        keys_.set("firstEntry", grid.firstEntry);
        keys_.set("firstBody", school_->bodiesOf(grid.group).first);
        keys_.set("firstKey", grid.firstKey);
        keys_.set("keys", grid.keys);
        keys_.set("inverseCell", float(1 / cellOf(g)));
        dispatch(keys_, grid.entries);
    }
    settled();
}

void Schooling::order() {
    sort_.sort(pairs_, size_t(school_->entries), school_->keyBits());
    settled();
    order_.use();
    order_.texture("sorted", 0, pairsRead_);
    order_.texture("bodies", 1, bodiesRead_);
    order_.set("count", school_->entries);
    order_.set("keyCount", school_->keys);
    order_.storage("Starts", 0, starts_);
    order_.storage("Places", 1, places_);
    order_.storage("Velocities", 2, velocities_);
    dispatch(order_, school_->entries);
    settled();
}

void Schooling::setRules(size_t index, const Frame& frame) {
    const SchoolMember& member = school_->members[index];
    const School& school = members_[index].school;
    const Program& program = *members_[index].steer;
    std::vector<glm::ivec4> grids;
    std::vector<glm::vec4> rules;
    const auto add = [&](size_t g, double radius, double strength) {
        const SchoolGrid& grid = school_->grids[g];
        grids.emplace_back(grid.firstEntry, grid.entries, grid.firstKey, grid.keys);
        rules.emplace_back(float(1 / cellOf(g)), float(radius), float(strength), 0);
    };
    add(member.grid, school.radius, 0);
    for (size_t t = 0; t < school.flees.size(); ++t)
        add(member.targetGrids[t], school.flees[t].radius, -school.flees[t].strength);
    for (size_t t = 0; t < school.hunts.size(); ++t)
        add(member.targetGrids[school.flees.size() + t], school.hunts[t].radius, school.hunts[t].strength);
    program.set("grids", std::span<const glm::ivec4>(grids));
    program.set("gridRules", std::span<const glm::vec4>(rules));
    program.set("others",
                glm::vec4(school.separationRadius, school.separation, school.alignment, school.cohesion));
    program.set("speeds", glm::vec4(school.slowest, school.cruise, school.fastest, school.acceleration));
    program.set("habits", glm::vec4(std::tan(school.steepest), school.turn, school.reaction, school.wander));
    program.set("muscles", glm::vec4(member.length > 0 ? school.bend / member.length : 0, school.beat,
                                     school.fins, member.keel ? 2 / school.reaction : 0));
    program.set("hasBody", int(member.length > 0));
    const GroupPlan& group = plan_->groups[member.group];
    program.set("drag", float(group.drag.tangent * frame.parameters.drag));
    // seen: all but a cone about straight back
    program.set("blindCosine", float(school.blind < 1.5707963 ? std::cos(school.blind) : 0));
    const double base = school_->origin.y;
    const glm::dvec2 depth = school.depth.value_or(glm::dvec2(-endless, endless));
    program.set("depth",
                glm::vec4(depth.x - base, depth.y - base, school.depth ? school.depthStrength : 0, 0));
    glm::dvec3 low(-endless), high(endless);
    double radius = 0;
    if (school.home && school.home->box) {
        low = school.home->box->low - school_->origin;
        high = school.home->box->high - school_->origin;
    } else if (school.home) {
        low = school.home->center - school_->origin;
        radius = school.home->radius;
    }
    program.set("homeLow", glm::vec4(low, school.home ? school.home->strength : 0));
    program.set("homeHigh", glm::vec4(high, radius));
    program.set("time", float(std::fmod(frame.time, wanderPeriod)));
    program.set("duration", float(frame.parameters.frameTime));
    program.set("firstBody", school_->bodiesOf(member.group).first);
    if (!group.needs.avoids) return;
    constexpr double near = 64;  // m: what a float holds to a few micrometres
    const glm::dvec3 way = glm::abs(school_->origin);
    const bool isNear = std::max({way.x, way.y, way.z}) < near;
    program.set("wallAnchor", glm::vec3(isNear ? glm::dvec3(0) : school_->origin));
    program.set("origin", glm::vec3(isNear ? school_->origin : glm::dvec3(0)));
    program.set("walls", glm::vec2(school.walls, school.look));
    const std::vector<glm::vec4> parameters = colliderParameters(*plan_, group, frame);
    program.set("colliderParameters", std::span<const glm::vec4>(parameters));
    if (tables_->sampleTexels) program.texture("samples", 5, tables_->sampleTexels);
}

void Schooling::steer(size_t index, const Frame& frame, const std::vector<GroupBuffers>& state) {
    const SchoolMember& member = school_->members[index];
    const Program& program = *members_[index].steer;
    program.use();
    program.texture("bodies", 0, bodiesRead_);
    program.texture("sorted", 1, pairsRead_);
    program.texture("starts", 2, startsRead_);
    program.texture("places", 3, placesRead_);
    program.texture("velocities", 4, velocitiesRead_);
    setRules(index, frame);
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
    for (size_t m = 0; m < members_.size(); ++m)
        steer(m, frame, state);
    settled();
}

bool Schooling::change(size_t group, const School& school) {
    for (size_t m = 0; m < members_.size(); ++m) {
        if (school_->members[m].group != group) continue;
        const School& now = members_[m].school;
        const bool walls = plan_->groups[group].needs.avoids;
        if (!sameTargets(now.flees, school.flees) || !sameTargets(now.hunts, school.hunts)) return false;
        if (!walls && school.walls > 0 && now.walls == 0) return false;
        members_[m].school = school;
        return true;
    }
    return false;
}

}  // namespace shoal
