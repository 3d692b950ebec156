#include "simulate/checkpoint_head.h"

#include <utility>

namespace shoal::checkpoint {

namespace {

// Which vertices the springs join, and their rest lengths; from the plan's table (compile/plan.h).
uint64_t shapeOf(const Plan& plan, const GroupPlan& group) {
    Checksum sum;
    for (int v = 0; v < group.vertexCount; ++v) {
        const glm::vec4 spans = plan.topology[size_t(group.topologyBase + v)];
        sum.add(spans.y);
        for (size_t s = 0; s < size_t(spans.y); ++s) {
            const glm::vec4 spring = plan.topology[size_t(spans.x) + 2 * s];
            sum.add(spring.x);
            sum.add(spring.w);
        }
    }
    if (group.life) {
        sum.add(uint32_t(group.life->cycle.allocator));
        sum.add(uint32_t(group.life->cycle.emitters.size()));
    }
    return sum.sum();
}

uint64_t instancesOf(const GroupPlan& group) {
    Checksum sum;
    const auto add = [&](const auto& values) { sum.add(values.data(), values.size() * sizeof values[0]); };
    add(group.constants.seeds);
    add(group.constants.scales);
    add(group.constants.phases);
    return sum.sum();
}

}  // namespace

std::vector<GroupHead> groupsOf(const Plan& plan) {
    std::vector<GroupHead> out;
    for (const GroupPlan& group : plan.groups)
        out.push_back({group.name, group.count, group.vertexCount, group.springCount, shapeOf(plan, group),
                       instancesOf(group)});
    return out;
}

uint64_t forcesAt(const Plan& plan, double time) {
    Frame frame;
    frame.time = time;
    frame.parameters = parametersOf(plan);
    frame.h = frame.parameters.frameTime / frame.parameters.substeps;
    Checksum sum;
    const auto add = [&](const auto& values) { sum.add(values.data(), values.size() * sizeof values[0]); };
    sum.add(plan.gravity.x);
    sum.add(plan.gravity.y);
    sum.add(plan.gravity.z);
    add(plan.topology);
    add(plan.samples);
    add(plan.fields.source);
    add(plan.colliders.source);
    add(fieldParameters(plan, frame));
    for (const GroupPlan& group : plan.groups) {
        for (const double value :
             {group.drag.normal, group.drag.tangent, group.stiffness, group.damping, group.phaseSpread})
            sum.add(value);
        add(group.muscles);
        add(group.forces.source);
        add(forceParameters(plan, group, frame));
        if (!group.colliderParameters.empty()) add(colliderParameters(plan, group, frame));
    }
    return sum.sum();
}

std::string difference(const std::vector<GroupHead>& saved, const std::vector<GroupHead>& here) {
    if (saved.size() != here.size())
        return concat("it had ", saved.size(), saved.size() == 1 ? " group" : " groups", ", this one has ",
                      here.size());
    for (size_t g = 0; g < saved.size(); ++g) {
        const GroupHead &was = saved[g], &ours = here[g];
        if (was.name != ours.name)
            return concat("its group ", g + 1, " was \"", was.name, "\", here it is \"", ours.name, "\"");
        const std::string group = concat("its group \"", was.name, "\" had ");
        if (was.count != ours.count) return concat(group, was.count, " molecules, here it has ", ours.count);
        if (was.vertexCount != ours.vertexCount)
            return concat(group, "molecules of ", was.vertexCount, " vertices, here they have ",
                          ours.vertexCount);
        if (was.springCount != ours.springCount)
            return concat(group, "molecules of ", was.springCount, " springs, here they have ",
                          ours.springCount);
        if (was.shape != ours.shape)
            return concat(group,
                          "springs between other vertices or of other rest lengths, or was born otherwise");
        if (was.instances != ours.instances)
            return concat(group, "other seeds, sizes or muscle phases: another --seed or other ranges");
    }
    return {};
}

namespace {

class Packer {
  public:
    template <typename T>
    void operator()(const T& value) {
        static_assert(std::is_arithmetic_v<T>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void operator()(const std::string& text) {
        (*this)(uint32_t(text.size()));
        bytes += text;
    }
    std::string bytes;
};

class Unpacker {
  public:
    Unpacker(const std::string& bytes, const Location& location) : bytes_(bytes), location_(location) {}
    template <typename T>
    void operator()(T& value) {
        static_assert(std::is_arithmetic_v<T>);
        std::memcpy(&value, piece(sizeof value), sizeof value);
    }
    void operator()(std::string& text) {
        uint32_t length = 0;
        (*this)(length);
        text.assign(piece(length), length);
    }
    bool atEnd() const { return at_ == bytes_.size(); }

  private:
    const char* piece(size_t bytes) {
        if (bytes > bytes_.size() - at_) throw Error(location_, "is damaged: its head does not fit together");
        return bytes_.data() + std::exchange(at_, at_ + bytes);
    }
    const std::string& bytes_;
    const Location& location_;
    size_t at_ = 0;
};

// The parts of a head in the file's order, to a Packer or from an Unpacker. `groups`: how many there are.
template <typename Archive, typename AnyHead, typename Count>
void visitStart(Archive& archive, AnyHead& head, Count& groups) {
    archive(head.time);
    archive(head.step);
    archive(head.forces);
    archive(head.frames);
    archive(head.spheres);
    archive(head.contacts);
    archive(head.walls);
    archive(groups);
    for (auto* parameters : {&head.parameters, &head.own}) {
        for (auto* number : numbersOf(*parameters))
            archive(*number);
        static_assert(sizeof parameters->substeps == sizeof(int32_t));
        archive(parameters->substeps);
    }
}

template <typename Archive, typename AnyGroup>
void visitGroup(Archive& archive, AnyGroup& group) {
    archive(group.name);
    archive(group.count);
    archive(group.vertexCount);
    archive(group.springCount);
    archive(group.shape);
    archive(group.instances);
    archive(group.keeps);
}

}  // namespace

std::string pack(const Head& head) {
    Packer out;
    const auto groups = uint32_t(head.groups.size());
    visitStart(out, head, groups);
    for (const GroupHead& group : head.groups)
        visitGroup(out, group);
    return out.bytes;
}

Head unpack(const std::string& bytes, const Location& location) {
    Unpacker in(bytes, location);
    Head head;
    uint32_t groups = 0;
    visitStart(in, head, groups);
    for (uint32_t g = 0; g < groups; ++g)
        visitGroup(in, head.groups.emplace_back());
    if (!in.atEnd()) throw Error(location, "is damaged: its head does not fit together");
    return head;
}

}  // namespace shoal::checkpoint
