#include "simulate/texture_school.h"

#include <algorithm>
#include <bit>

#include "gpu/gl.h"

namespace shoal {

using gpu::Format;
using gpu::Framebuffer;
using gpu::Program;
using gpu::Texture;

// As wide as high, or half as high.
static int rowBitsOf(const SchoolPlan& school) {
    const int numbers = std::max({school.bodyCount, school.entries, school.keys + 1});
    return (int(std::bit_width(unsigned(numbers - 1))) + 1) / 2;
}

// Keys are up to twice as many as molecules.
static size_t mostOf(const gpu::ContextInfo& info) {
    const size_t side = std::bit_floor(unsigned(info.maxTextureSize));
    return std::min(side * side / 2 - 1, NetworkSort::most(info, NetworkSort::Kind::bitonic));
}

TextureSchool::TextureSchool(gpu::Context& context, const Plan& plan, const Tables& tables)
    : SchoolPasses(context, plan, tables, rowBitsOf(plan.school)),
      rowBits_(rowBitsOf(plan.school)),
      sort_((checkCount(plan.school, mostOf(context.info())), context), NetworkSort::Kind::bitonic,
            size_t(plan.school.entries), 2 << rowBits_, NetworkSort::Ties::byIndex) {
    const auto texture = [&](Format format, int numbers, const char* label, int layers = 0) {
        return Texture(context, format, 1 << rowBits_, rowsOf(numbers), label, layers);
    };
    bodies_ = texture(Format::rgba32f, school_->bodyCount, "school bodies", bodyElements);
    startsOf_ = texture(Format::r32ui, school_->keys + 1, "school cells");
    places_ = texture(Format::rgba32f, school_->entries, "school places");
    velocities_ = texture(Format::rgba32f, school_->entries, "school velocities");
    slotSteering_ = texture(Format::rgba32f, school_->entries, "school steering", steeringElements);
    arrays_.add("bodies", bodies_);
    arrays_.add("starts", startsOf_);
    arrays_.add("places", places_);
    arrays_.add("velocities", velocities_);
    arrays_.add("steered", slotSteering_);
    newBodies_ = Framebuffer(context, {{&bodies_}}, nullptr, "school bodies");
    newSlotSteering_ = Framebuffer(context, {{&slotSteering_}}, nullptr, "school steering");
    newStarts_ = Framebuffer(context, {{&startsOf_}}, nullptr, "school cells");
    newOrder_ = Framebuffer(context, {{&places_}, {&velocities_}}, nullptr, "school order");
    makePrograms();
    gpu::ProgramOptions starts = optionsOf("", "school starts", nullptr);
    starts.fragment = "sort/starts.frag";
    starts_ = Program(context, starts);
    gpu::ProgramOptions steered = optionsOf("steered", "school steering", nullptr);
    steered.defines.push_back(concat("STATE_WIDTH ", stateWidth));
    steered_ = Program(context, steered);
}

void TextureSchool::give(const Program& program) const {
    arrays_.bind(program);
    if (program.uses("sorted")) program.texture("sorted", sort_.pairs());
}

void TextureSchool::draw(const Framebuffer& target, int firstRow, int rows) const {
    target.bind(0, firstRow, target.width(), rows);
    gpu::drawVertices(3);
}

void TextureSchool::findBodies(const std::vector<GroupLayers>& state) {
    for (size_t b = 0; b < school_->bodies.size(); ++b) {
        const SchoolBodies& bodies = school_->bodies[b];
        const int count = plan_->groups[bodies.group].count;
        const Program& program = useBody(b);
        program.texture("oldState", state[bodies.group].state());
        program.texture("oldRecords", state[bodies.group].records());
        program.set("groupMolecules", count);
        program.set("firstBody", bodies.first);
        const int first = bodies.first >> rowBits_;
        draw(newBodies_, first, rowsOf(bodies.first + count) - first);
    }
}

void TextureSchool::order() {
    const Program& keys = useKeys();
    give(keys);
    sort_.drawInto(sort_.target());
    gpu::drawVertices(3);
    sort_.flip();
    sort_.sort();
    starts_.use();
    give(starts_);
    starts_.set("count", school_->entries);
    draw(newStarts_, 0, newStarts_.height());
    const Program& order = useOrder();
    give(order);
    draw(newOrder_, 0, newOrder_.height());
}

void TextureSchool::steer(size_t index, const Frame& frame, GroupLayers& state) {
    const Program& program = useSteer(index, frame);
    give(program);
    program.texture("steering", state.steering());
    const SchoolMember& member = school_->members[index];
    const glm::ivec4 range = rangeOf(member.grid);
    const int first = range.x >> rowBits_;
    draw(newSlotSteering_, first, rowsOf(range.x + range.y) - first);
    steered_.use();
    give(steered_);
    steered_.set("grid", range);
    steered_.set("inverseCell", float(1 / cellOf(member.grid)));
    steered_.set("firstBody", school_->bodiesOf(member.group).first);
    steered_.set("entries", school_->entries);
    draw(state.newSteering(), 0, state.newSteering().height());
    state.flipSteering();
}

void TextureSchool::step(const Frame& frame, std::vector<GroupLayers>& state, gpu::PassTimers& timers) {
    gpu::drawPlainly();
    {
        const auto timer = timers.time("school grid");
        findBodies(state);
        order();
    }
    const auto timer = timers.time("school steer");
    for (size_t m = 0; m < school_->members.size(); ++m)
        steer(m, frame, state[school_->members[m].group]);
}

}  // namespace shoal
