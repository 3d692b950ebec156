// The passes of the grid and of the search of contact on the fused path.
#include <algorithm>

#include "simulate/molecule_contact.h"

namespace shoal {

using gpu::Program;

void MoleculeContact::setWalls(const Program& program, const ContactGroup& group, const Frame& frame) const {
    const std::vector<glm::vec4> parameters = colliderParameters(*plan_, plan_->groups[group.group], frame);
    program.set("colliderParameters", std::span<const glm::vec4>(parameters));
    program.storage("Walls", 4, nearWalls_.buffer);
}

void MoleculeContact::makeKeys(bool staggered, const Frame& frame, Buffers& state) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part,
                        const SphereRange& range) {
        const ContactGroup& group = contact_->groups[g];
        const Program& program = groups_[g].spheres;
        Textures textures(program);
        textures.add("oldState", buffers.oldState(part)).add("oldRecords", part.record);
        textures.add("shapes", groups_[g].shapes.texture);
        if (buffers.hasConstants()) textures.add("constants", part.constant);
        if (walls_ && plan_->groups[group.group].needs.collide) {
            if (tables_->sampleTexels) textures.add("samples", tables_->sampleTexels);
            setWalls(program, group, frame);
        }
        program.set("label", int(uint32_t(g) << 26) + part.first);
        program.set("keys", keyMask() + 1);
        program.set("cell", float(contact_->cell));
        program.set("givenRadius", float(group.radius));
        program.set("cellShift", glm::vec3(staggered ? float(contact_->cell / 2) : 0.0f));
        program.set("onlyKeys", int(staggered));
        program.set("contactStep", float(frame.parameters.frameTime));
        if (counted_) program.storage("CellCounts", 5, cellCounts_);
        const Array& pairs = counted_ ? arrivals_ : staggered ? staggered_ : pairs_;
        program.storage("Pairs", 0, pairs.buffer);
        program.storage("Places", 1, spherePlaces_.buffer);
        program.storage("Motions", 2, motions_.buffer);
        program.storage("Cells", 3, sphereCells_.buffer);
        if (contact_->remembers()) program.storage("Loads", 6, loads_.buffer);
        if (isRigid(g)) program.storage("Bodies", 7, bodies_.buffer);
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
    starts_.use();
    starts_.set("keys", keyMask() + 1);
    starts_.storage("CellCounts", 5, cellCounts_);
    starts_.storage("Starts", 1, cellStarts_.buffer);
    ++dispatches_;
    starts_.dispatch(int((size_t(keyMask()) + cellTile) / cellTile));
    settled();
    Textures(collect_).add("arrivals", arrivals_.texture).add("starts", cellStarts_.texture);
    collect_.set("keys", keyMask() + 1);
    collect_.set("count", contact_->spheres);
    collect_.storage("CellCounts", 5, cellCounts_);
    collect_.storage("Members", 1, members_.buffer);
    dispatch(collect_, size_t(contact_->spheres));
    settled();
}

void MoleculeContact::order(bool staggered) {
    if (staggered && !counted_) return;
    Textures textures(order_);
    textures.add("spherePlaces", spherePlaces_.texture).add("sphereCells", sphereCells_.texture);
    if (counted_) {
        textures.add("arrivals", arrivals_.texture)
            .add("starts", cellStarts_.texture)
            .add("members", members_.texture);
        order_.set("onlyOrder", int(staggered));
        order_.storage("Sorted", 0, staggered ? staggered_.buffer : pairs_.buffer);
    } else {
        textures.add("sorted", pairs_.texture);
        order_.set("keyMask", keyMask());
        order_.storage("Starts", 0, cellStarts_.buffer);
    }
    order_.set("count", contact_->spheres);
    order_.storage("Places", 1, places_.buffer);
    order_.storage("Cells", 4, cells_.buffer);
    order_.storage("Slots", 2, slots_.buffer);
    useTouching(order_);
    useMarks(order_);
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
    Textures textures(program);
    textures.add("places", places_.texture).add("cells", cells_.texture).add("sorted", pairs_.texture);
    if (&program == &findStaggered_)
        textures.add("staggered", staggered_.texture).add("slots", slots_.texture);
    if (contact_->settings.search == ContactSearch::exact) {
        textures.add("starts", cellStarts_.texture);
        program.set("reach", float(contact_->reach));
        program.set("keyMask", keyMask());
    }
    if (contact_->remembers()) textures.add("known", known_.texture);
    if (&program == &findResting_)
        textures.add("partners", partners_.texture).add("slots", slots_.texture);
    else if (rests())
        textures.add("awakeSlots", awakeSlots_.texture);
    if (contact_->settings.fastest || rests()) {
        textures.add("motions", motions_.texture);
        setTimes(program, times);
    }
    if (self_) textures.add("apart", apart_.texture).add("groupsOf", groupsOf_.texture);
    if (walls_ && spreads_) textures.add("walls", nearWalls_.texture);
    if (walls_ && rigid_) textures.add("bodies", bodies_.texture);
    program.set("count", contact_->spheres);
    program.set("cell", float(contact_->cell));
    program.set("listStride", int(padded_));
    program.set("last", int(!findStaggered_ || &program == &findStaggered_));
    program.storage("Lists", 0, lists_.buffer);
    program.storage("Counts", 1, counts_.buffer);
    program.storage("Dropped", 2, dropped_);
    useTouching(program);
    useMarks(program);
    if (rests()) program.storage("MarkedSlots", 4, markedSlots_.buffer);
    if (rests()) {
        ++dispatches_;
        program.dispatchIndirect(markGroups_, &program == &findResting_ ? ofMarked : ofAwake);
    } else {
        dispatch(program, size_t(contact_->spheres));
    }
    settled();
}

void MoleculeContact::sift() {
    Textures(sift_)
        .add("cells", cells_.texture)
        .add("sorted", pairs_.texture)
        .add("partners", partners_.texture)
        .add("slots", slots_.texture)
        .add("known", known_.texture);
    sift_.set("count", contact_->spheres);
    sift_.set("listStride", int(padded_));
    sift_.storage("AwakeSlots", 0, awakeSlots_.buffer);
    sift_.storage("Counts", 1, counts_.buffer);
    sift_.storage("MarkedSlots", 4, markedSlots_.buffer);
    useMarks(sift_);
    dispatch(sift_, size_t(contact_->spheres));
    settled();
}

// As many contacts away from an impact as an impulse gets in a step, and as there are bits for.
void MoleculeContact::wake() {
    const int furthest = std::min(contact_->settings.iterations, 24);
    Textures(wake_)
        .add("places", places_.texture)
        .add("cells", cells_.texture)
        .add("slots", slots_.texture)
        .add("partners", partners_.texture)
        .add("known", known_.texture)
        .add("groupsOf", groupsOf_.texture);
    wake_.set("count", contact_->spheres);
    wake_.set("listStride", int(padded_));
    useMarks(wake_);
    wake_.storage("MarkedSlots", 4, markedSlots_.buffer);
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
