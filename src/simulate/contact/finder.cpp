#include "simulate/contact/finder.h"

#include <algorithm>

namespace shoal {

using gpu::Program;

ContactFinder::ContactFinder(ContactData& data) : data_(&data) {
    const bool isExact = data.contact->settings.search == ContactSearch::exact;
    const std::string ahead = concat("AHEAD ", data.counted ? 4 : 1);
    if (!isExact) {
        const std::vector<std::string> second = {"SECOND_GRID"}, none;
        find_ = data.stage("contact/search/neighbors", data.staggers && data.textures ? second : none);
        if (data.staggers && !data.textures) findStaggered_ = data.stage("contact/search/neighbors", second);
    }
    if (isExact) find_ = data.stage("contact/search/find", {ahead}, data.rests ? "find_awake" : "find");
    if (!data.rests) return;
    findResting_ = data.stage("contact/search/find", {ahead, "MARKED"}, "find_marked");
    awake_ = data.stage("contact/rest/awake");
    wake_ = data.stage("contact/rest/wake");
}

void ContactFinder::find(const Program& program, const ContactStep& times) {
    data_->use(program).set("count", data_->contact->spheres);
    program.set("cell", float(data_->contact->cell));
    program.set("keyMask", data_->keyMask());
    if (data_->contact->settings.search == ContactSearch::exact)
        program.set("reach", float(data_->contact->reach));
    ContactData::setTimes(program, times);
    if (data_->textures) return data_->runAll(program);
    program.set("listStride", int(data_->padded));
    program.set("last", int(!findStaggered_ || &program == &findStaggered_));
    if (data_->rests)
        data_->arrays.runIndirect(
            program, "markGroups",
            &program == &findResting_ ? ContactData::markedGroups : ContactData::awakeGroups);
    else
        data_->runAll(program);
}

// As many contacts away from an impact as an impulse gets in a step, but no more than there are bits for.
void ContactFinder::wake() {
    const int furthest = std::min(data_->contact->settings.iterations, 24);
    for (int away = 0; away <= furthest; ++away) {
        data_->use(wake_).set("count", data_->contact->spheres);
        wake_.set("listStride", int(data_->padded));
        wake_.set("contactsAway", away);
        wake_.set("last", int(away == furthest));
        data_->arrays.runIndirect(wake_, "markGroups", ContactData::struckGroups);
    }
}

void ContactFinder::run(const ContactStep& times) {
    if (data_->rests) {
        data_->use(awake_).set("count", data_->contact->spheres);
        awake_.set("listStride", int(data_->padded));
        data_->runAll(awake_);
    }
    find(find_, times);
    if (data_->rests) {
        wake();
        find(findResting_, times);
    }
    if (findStaggered_) find(findStaggered_, times);
}

}  // namespace shoal
