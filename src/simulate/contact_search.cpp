// The passes of the grid and of the search of contact on the fused path.
#include <algorithm>

#include "simulate/molecule_contact.h"

namespace shoal {

using gpu::Program;

void MoleculeContact::setWalls(const Program& program, const ContactGroup& group, const Frame& frame) const {
    const std::vector<glm::vec4> parameters = colliderParameters(*plan_, plan_->groups[group.group], frame);
    program.set("colliderParameters", std::span<const glm::vec4>(parameters));
    if (tables_->sampleTexels) program.texture("samples", tables_->sampleTexels);
}

void MoleculeContact::makeKeys(bool staggered, const Frame& frame, Buffers& state) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part,
                        const SphereRange& range) {
        const ContactGroup& group = contact_->groups[g];
        const Program& program = with(groups_[g].spheres);
        program.texture("oldState", buffers.oldState(part));
        program.texture("oldRecords", part.record);
        program.texture("shapes", groups_[g].shapes.texture);
        if (buffers.hasConstants()) program.texture("constants", part.constant);
        if (walls_ && plan_->groups[group.group].needs.collide) setWalls(program, group, frame);
        program.storage("Keys", (counted_ ? arrivals_ : staggered ? staggered_ : pairs_).buffer);
        program.set("label", int(uint32_t(g) << 26) + part.first);
        program.set("keys", keyMask() + 1);
        program.set("cell", float(contact_->cell));
        program.set("givenRadius", float(group.radius));
        program.set("cellShift", glm::vec3(staggered ? float(contact_->cell / 2) : 0.0f));
        program.set("onlyKeys", int(staggered));
        program.set("contactStep", float(frame.parameters.frameTime));
        if (rests()) program.set("wakes", int(wakes_));
        dispatch(program, setSpheres(program, range));
    });
    settled();
}

void MoleculeContact::sortKeys(bool staggered) {
    if (!counted_) {
        dispatches_ += 3 * sort_->passes(size_t(contact_->spheres), contact_->tableBits);
        sort_->sort((staggered ? staggered_ : pairs_).buffer, size_t(contact_->spheres), contact_->tableBits);
        return;
    }
    with(starts_).set("keys", keyMask() + 1);
    ++dispatches_;
    starts_.dispatch(int((size_t(keyMask()) + cellTile) / cellTile));
    settled();
    with(collect_).set("keys", keyMask() + 1);
    collect_.set("count", contact_->spheres);
    dispatch(collect_, size_t(contact_->spheres));
    settled();
}

void MoleculeContact::order(bool staggered) {
    if (staggered && !counted_) return;
    with(order_).set("count", contact_->spheres);
    if (counted_) {
        order_.set("onlyOrder", int(staggered));
        order_.storage("Sorted", staggered ? staggered_.buffer : pairs_.buffer);
    } else {
        order_.set("keyMask", keyMask());
    }
    dispatch(order_, size_t(contact_->spheres));
    settled();
}

void MoleculeContact::buildGrid(const Frame& frame, Buffers& state) {
    dispatches_ = 0;
    for (const bool staggered : {true, false}) {
        if (staggered && !staggered_.buffer) continue;
        makeKeys(staggered, frame, state);
        sortKeys(staggered);
        order(staggered);
    }
}

void MoleculeContact::find(const Program& program, const Times& times) {
    with(program).set("count", contact_->spheres);
    program.set("cell", float(contact_->cell));
    program.set("listStride", int(padded_));
    program.set("last", int(!findStaggered_ || &program == &findStaggered_));
    if (contact_->settings.search == ContactSearch::exact) {
        program.set("reach", float(contact_->reach));
        program.set("keyMask", keyMask());
    }
    if (contact_->settings.fastest || rests()) setTimes(program, times);
    if (rests()) {
        ++dispatches_;
        program.dispatchIndirect(markGroups_, &program == &findResting_ ? ofMarked : ofAwake);
    } else {
        dispatch(program, size_t(contact_->spheres));
    }
    settled();
}

void MoleculeContact::sift() {
    with(sift_).set("count", contact_->spheres);
    sift_.set("listStride", int(padded_));
    dispatch(sift_, size_t(contact_->spheres));
    settled();
}

// As many contacts away from an impact as an impulse gets in a step, and as there are bits for.
void MoleculeContact::wake() {
    const int furthest = std::min(contact_->settings.iterations, 24);
    with(wake_).set("count", contact_->spheres);
    wake_.set("listStride", int(padded_));
    for (int away = 0; away <= furthest; ++away) {
        wake_.set("contactsAway", away);
        wake_.set("last", int(away == furthest));
        ++dispatches_;
        wake_.dispatchIndirect(markGroups_, ofStruck);
        settled();
    }
}

void MoleculeContact::search(Buffers&, const Times& times) {
    if (rests()) sift();
    find(find_, times);
    if (rests()) {
        wake();
        find(findResting_, times);
    }
    if (findStaggered_) find(findStaggered_, times);
}

}  // namespace shoal
