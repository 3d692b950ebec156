#include "simulate/contact/rest.h"

#include <algorithm>

#include "simulate/fused_kernel.h"

namespace shoal {

using gpu::Program;

ContactRest::ContactRest(ContactData& data) : data_(&data) {
    for (const ContactGroup& group : data.contact->groups) {
        Group& made = groups_.emplace_back();
        if (data.contact->mayRest(data.planOf(group)))
            made.rest = data.groupStage(group, "contact/rest/rest");
    }
    loadChange_ = data.stage("contact/rest/load_change");
}

void ContactRest::begin(const Frame& frame) {
    wakes_ = frame.restarts;
    for (size_t g = 0; g < groups_.size(); ++g) {
        std::vector<glm::vec4> numbers =
            stepNumbers(*data_->plan, data_->planOf(data_->contact->groups[g]), frame);
        groups_[g].probes = numbers != groups_[g].numbers;
        groups_[g].numbers = std::move(numbers);
    }
}

// m/s: the change of velocity from which on what rests wakes, a tenth of what gravity adds in a step but at
// least the scene's `rest`.
float ContactRest::wakeSpeed(const ContactStep& times) const {
    return float(std::max(times.restSpeed / 20, *data_->contact->settings.rest));
}

void ContactRest::run(const ContactStep& times) {
    data_->withResponse(loadChange_, times).set("wakeSpeed", wakeSpeed(times));
    data_->arrays.runIndirect(loadChange_, "markGroups", ContactData::markedGroups);
    data_->forParts([&](size_t g, size_t p, const MoleculeRange& part) {
        if (!groups_[g].rest) return;
        const ContactGroup& group = data_->contact->groups[g];
        const Program& program = data_->withPart(groups_[g].rest, group, p);
        program.set("stepTime", float(times.step));
        program.set("restTime", float(ContactPlan::restTime));
        program.set("restDistance", float(*data_->contact->settings.rest * ContactPlan::restTime));
        program.set("wakeSpeed", wakeSpeed(times));
        program.set("probes", int(groups_[g].probes));
        program.set("wakes", int(wakes_));
        data_->arrays.run(program, data_->spheresOf(group, part).first, part.count);
    });
    data_->arrays.settle();
}

}  // namespace shoal
