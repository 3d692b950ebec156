#include "simulate/contact/contact.h"

#include <algorithm>

#include "simulate/contact/readback.h"

namespace shoal {

using gpu::Program;

Contact::Contact(gpu::Context& context, const Plan& plan, const Tables& tables, ContactState& state,
                 std::optional<bool> asOnGpu)
    : data_(context, plan, tables, state, asOnGpu), grid_(data_), finder_(data_), solver_(data_) {
    if (data_.rests) rest_.emplace(data_);
}

void Contact::begin(const Frame& frame) {
    if (rest_) rest_->begin(frame);
}

void Contact::step(const Frame& frame, gpu::PassTimers& timers) {
    const int before = data_.arrays.dispatches();
    constexpr std::pair<const char*, const char*> sides[] = {
        {"slots", "oldSlots"},     {"counts", "oldCounts"},       {"lists", "oldLists"},
        {"anchors", "oldAnchors"}, {"warmStart", "oldWarmStart"}, {"colliders", "oldColliders"},
        {"dropped", "oldDropped"}};
    for (const auto& [name, old] : sides)
        if (data_.textures) data_.arrays.swap(name, old);
    {
        const auto timer = timers.time("contact grid");
        grid_.build(frame, rest_ && rest_->wakes());
    }
    const double stepTime = frame.parameters.frameTime;
    // what gravity adds in two steps is no bounce
    const ContactStep times = {stepTime, 2 * glm::length(frame.parameters.gravity) * stepTime, frame.h};
    {
        const auto timer = timers.time("contact search");
        finder_.run(times);
    }
    const auto timer = timers.time("contact response");
    solver_.run(times);
    if (rest_) rest_->run(times);
    if (!data_.textures) dispatches_ = data_.arrays.dispatches() - before + grid_.sortDispatches();
}

void Contact::bindLoads(const Program& program, size_t group, int firstMolecule) const {
    const ContactGroup* contact = data_.contact->find(group);
    if (!contact || !data_.remembers) return;
    program.set("firstSphere", contact->firstSphere + firstMolecule * contact->spheresOf);
    if (data_.textures)
        program.texture("contactLoads", data_.arrays.texture("loads"));
    else
        program.texture("contactLoads", data_.arrays.view("loads"));
    if (rest_ && data_.contact->mayRest(data_.plan->groups[group]))
        program.set("probes", int(rest_->probes(size_t(contact - data_.contact->groups.data()))));
}

uint32_t Contact::dropped() const {
    return droppedContacts(data_);
}

std::vector<std::pair<int, int>> Contact::found() const {
    return foundPairs(data_);
}

ContactMemory Contact::memory() const {
    return readMemory(data_);
}

void Contact::remember(const ContactMemory& memory) {
    writeMemory(data_, memory);
}

}  // namespace shoal
