#include "simulate/school_passes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal {

using gpu::Program;

namespace {

constexpr double endless = 1e9;                          // m
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

// Error: more molecules or entries than a context holds.
static const Plan& checked(const Plan& plan, size_t most) {
    const auto wanted = size_t(std::max(plan.school.bodyCount, plan.school.entries));
    if (wanted <= most) return plan;
    throw Error(plan.school.members[0].school.location,
                concat("a school of ", wanted, " molecules is more than this context holds: at most ", most));
}

SchoolPasses::SchoolPasses(gpu::Context& context, const Plan& plan, const Tables& tables, Form form,
                           size_t most)
    : context_(&context),
      plan_(&checked(plan, most)),
      school_(&plan.school),
      table_(context.shaders() + "/school/arrays.txt", form),
      rowBits_(rowBits(size_t(std::max({school_->bodyCount, school_->entries, school_->keys + 1})))),
      arrays_(context, table_,
              {{{"body", size_t(school_->bodyCount)},
                {"entry", size_t(school_->entries)},
                {"key", size_t(school_->keys)}},
               0,
               rowBits_},
              "school"),
      tables_(&tables) {
    gpu::ProgramOptions keys = optionsOf("school/keys", "school keys", nullptr);
    keys.defines.push_back(concat("GRIDS ", school_->grids.size()));
    keys_ = Program(*context_, keys);
    order_ = Program(*context_, optionsOf("school/order", "school order", nullptr));
    for (const SchoolBodies& bodies : school_->bodies) {
        const GroupPlan& group = plan_->groups[bodies.group];
        gpu::ProgramOptions body = optionsOf("school/bodies", concat("bodies of ", group.name), &group);
        body.generated = {{"generated/body.glsl", bodies.text}};
        bodyPrograms_.push_back(&programs_.get(*context_, body));
    }
    for (const SchoolMember& member : school_->members)
        makeSteer(member);
}

gpu::ProgramOptions SchoolPasses::optionsOf(const std::string& file, const std::string& label,
                                            const GroupPlan* group) const {
    gpu::ProgramOptions out = arrays_.passOptions(file, label);
    out.defines.insert(out.defines.end(), {concat("BODY_ELEMENTS ", bodyElements),
                                           concat("STEERING_ELEMENTS ", steeringElements)});
    if (group)
        for (const std::string& define : group->layout().defines(hasTextures()))
            out.defines.push_back(define);
    return out;
}

void SchoolPasses::step(const Frame& frame, gpu::PassTimers& timers) {
    if (hasTextures()) gpu::drawPlainly();
    {
        const auto timer = timers.time("school grid");
        arrays_.settle();
        for (size_t b = 0; b < school_->bodies.size(); ++b)
            findBodies(b);
        sortKeys();
        arrays_.use(order_);
        if (!hasTextures()) order_.set("keyCount", school_->keys);
        arrays_.run(order_, 0, school_->entries);
    }
    const auto timer = timers.time("school steer");
    for (size_t m = 0; m < school_->members.size(); ++m)
        steer(m, frame);
    arrays_.settle();
}

void SchoolPasses::makeSteer(const SchoolMember& member) {
    const GroupPlan& group = plan_->groups[member.group];
    gpu::ProgramOptions options = optionsOf("school/steer", concat("steering of ", group.name), &group);
    options.defines.push_back(concat("TARGETS ", member.targetGrids.size()));
    options.defines.push_back(concat("CLOCK_PERIOD float(", clockPeriodOf(group), ")"));
    if (group.needs.avoids) options.defines.push_back("WALLS");
    options.generated = {{"generated/colliders.glsl", plan_->colliders.source}};
    members_.push_back({&programs_.get(*context_, options), member.school});
}

// m: what is looked for within a radius needs cells as wide.
double SchoolPasses::cellOf(size_t grid) const {
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

glm::ivec4 SchoolPasses::rangeOf(size_t g) const {
    const SchoolGrid& grid = school_->grids[g];
    return {grid.firstEntry, grid.entries, grid.firstKey, grid.keys};
}

void SchoolPasses::findBodies(size_t index) {
    const SchoolBodies& bodies = school_->bodies[index];
    const Program& program = arrays_.use(*bodyPrograms_[index]);
    program.set("origin", glm::vec3(school_->origin));
    const PackedState& state = stateOf(bodies.group);
    const std::vector<MoleculeRange> ranges = state.ranges();
    for (size_t r = 0; r < ranges.size(); ++r) {
        const int first = bodies.first + ranges[r].first;
        state.bindRead(program, r);
        program.set("firstBody", first);
        arrays_.run(program, first, ranges[r].count);
    }
}

const Program& SchoolPasses::useKeys() const {
    std::vector<glm::ivec4> ranges;
    std::vector<glm::vec4> sizes;
    for (size_t g = 0; g < school_->grids.size(); ++g) {
        const SchoolGrid& grid = school_->grids[g];
        ranges.emplace_back(grid.firstEntry, school_->bodiesOf(grid.group).first, grid.firstKey, grid.keys);
        sizes.emplace_back(float(1 / cellOf(g)), 0, 0, 0);
    }
    arrays_.use(keys_);
    keys_.set("gridRanges", std::span<const glm::ivec4>(ranges));
    keys_.set("cellSizes", std::span<const glm::vec4>(sizes));
    return keys_;
}

const Program& SchoolPasses::useSteer(size_t member, const Frame& frame) const {
    arrays_.use(*members_[member].steer);
    setRules(member, frame);
    return *members_[member].steer;
}

void SchoolPasses::setRules(size_t index, const Frame& frame) const {
    const SchoolMember& member = school_->members[index];
    const School& school = members_[index].school;
    const Program& program = *members_[index].steer;
    std::vector<glm::ivec4> grids;
    std::vector<glm::vec4> rules;
    const auto add = [&](size_t g, double radius, double strength) {
        grids.push_back(rangeOf(g));
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
    tables_->bind(program, *plan_);
}

bool SchoolPasses::change(size_t group, const School& school) {
    for (size_t m = 0; m < members_.size(); ++m) {
        if (school_->members[m].group != group) continue;
        const School& present = members_[m].school;
        const bool walls = plan_->groups[group].needs.avoids;
        if (!sameTargets(present.flees, school.flees) || !sameTargets(present.hunts, school.hunts))
            return false;
        if (!walls && school.walls > 0 && present.walls == 0) return false;
        members_[m].school = school;
        return true;
    }
    return false;
}

}  // namespace shoal
