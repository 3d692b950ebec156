// The passes of the response of contact on the fused path.
#include <algorithm>

#include "simulate/molecule_contact.h"

namespace shoal {

using gpu::Program;

void MoleculeContact::dispatchTouching(const Program& program) const {
    useTouching(program);
    ++dispatches_;
    program.dispatchIndirect(touchingGroups_, 0);
}

// Binds what all stages of the response read.
MoleculeContact::Textures MoleculeContact::bindResponse(const Program& program, const Times& times) const {
    Textures textures(program);
    textures.add("places", places_.texture)
        .add("sorted", pairs_.texture)
        .add("motions", motions_.texture)
        .add("cells", cells_.texture)
        .add("lists", list().texture)
        .add("counts", counts_[now_].texture)
        .add("materials", materials_.texture);
    program.set("listStride", int(padded_));
    setResponse(program, times);
    if (!rigid_ || !program.uses("bodies")) return textures;
    setRigidGroups(program);
    textures.add("bodies", bodies_.texture);
    return textures;
}

void MoleculeContact::bindWalls(const Program& program, Textures& textures) const {
    if (!walls_) return;
    if (program.uses("walls")) textures.add("walls", nearWalls_[now_].texture);
    program.storage("WallPushes", 7, wallPushes_.buffer);
}

void MoleculeContact::runNearest(Buffers&, const Times& times) {
    bindResponse(nearest_, times);
    nearest_.storage("Totals", 0, totals_[0].buffer);
    dispatchTouching(nearest_);
    settled();
}

void MoleculeContact::prepare(Buffers& state, const Times& times) {
    const size_t before = 1 - now_;
    Textures textures = bindResponse(prepare_, times);
    textures.add("oldSlots", slots_[before].texture)
        .add("oldCounts", counts_[before].texture)
        .add("oldLists", lists_[before].texture)
        .add("oldPushes", pushes_[pushed_].texture)
        .add("oldAnchors", anchors_[before].texture)
        .add("oldKnown", known_[before].texture);
    if (walls_) textures.add("oldWalls", nearWalls_[before].texture);
    bindWalls(prepare_, textures);
    pushed_ = 1 - pushed_;
    prepare_.storage("Totals", 0, totals_[0].buffer);
    prepare_.storage("Pushes", 1, pushes_[pushed_].buffer);
    prepare_.storage("Anchors", 2, anchors_[now_].buffer);
    prepare_.storage("Known", 3, known_[now_].buffer);
    if (spreads_)
        prepare_.storage("Normals", 4, normals_.buffer);
    else
        prepare_.storage("EffectiveCounts", 4, effectiveCounts_.buffer);
    dispatchTouching(prepare_);
    settled();
    if (spreads_) countEffective(state);
}

// Where contacts of several spheres act together.
void MoleculeContact::countEffective(Buffers& state) {
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].effectiveSum;
        Textures(program)
            .add("slots", slots_[now_].texture)
            .add("counts", counts_[now_].texture)
            .add("normals", normals_.texture)
            .add("shapes", groups_[g].shapes.texture);
        program.storage("EffectiveCounts", 0, effectiveCounts_.buffer);
        dispatch(program, setSpheres(program, g, part, first));
    });
    settled();
}

void MoleculeContact::relax(Buffers& state, const Times& times, float momentum) {
    // without momentum the earlier ones do not count, and nobody may have written them yet
    const Array& earlier = totals_[momentum == 0 ? 0 : 1];
    if (spreads_) spread(state, earlier, momentum);
    Textures textures = bindResponse(relax_, times);
    textures.add("effectiveCounts", effectiveCounts_.texture)
        .add("known", known_[now_].texture)
        .add("anchors", anchors_[now_].texture);
    if (spreads_)
        textures.add("motionsNow", motionsNow_.texture);
    else
        textures.add("totals", totals_[0].texture).add("earlier", earlier.texture);
    bindWalls(relax_, textures);
    relax_.set("momentum", momentum);
    relax_.storage("Totals", 0, totals_[2].buffer);
    relax_.storage("Pushes", 1, pushes_[pushed_].buffer);
    relax_.storage("Earlier", 2, pushes_[1 - pushed_].buffer);
    dispatchTouching(relax_);
    settled();
    pushed_ = 1 - pushed_;
    std::rotate(totals_.begin(), totals_.begin() + 2, totals_.end());
}

void MoleculeContact::spread(Buffers& state, const Array& earlier, float momentum) {
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].spread;
        Textures textures(program);
        textures.add("slots", slots_[now_].texture)
            .add("counts", counts_[now_].texture)
            .add("motions", motions_.texture)
            .add("totals", totals_[0].texture)
            .add("earlier", earlier.texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        if (isRigid(g)) textures.add("bodies", bodies_.texture);
        program.set("momentum", momentum);
        program.storage("MotionsNow", 0, motionsNow_.buffer);
        dispatch(program, setSpheres(program, g, part, first));
    });
    settled();
}

void MoleculeContact::settle(Buffers&, const Times& times) {
    Textures textures = bindResponse(settle_, times);
    textures.add("effectiveCounts", effectiveCounts_.texture);
    bindWalls(settle_, textures);
    settle_.storage("Totals", 0, totals_[0].buffer);
    settle_.storage("Pushes", 1, pushes_[pushed_].buffer);
    settle_.storage("Anchors", 2, anchors_[now_].buffer);
    settle_.storage("Known", 3, known_[now_].buffer);
    dispatchTouching(settle_);
    settled();
}

void MoleculeContact::apply(Buffers& state, const Times& times) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].apply;
        const bool rigid = isRigid(g);
        const bool ofVertices = contact_->groups[g].triangles || rigid;
        Textures textures(program);
        textures.add(ofVertices ? "slots" : "sorted", ofVertices ? slots_[now_].texture : pairs_.texture)
            .add("counts", counts_[now_].texture)
            .add("totals", totals_[0].texture)
            .add("known", known_[now_].texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        if (rigid) textures.add("bodies", bodies_.texture);
        setTimes(program, times);
        program.set("substepTime", float(times.substep));
        if (contact_->remembers()) program.storage("Loads", 1, loads_.buffer);
        setSpheres(program, g, part, first);
        store(program, "State", 0, buffers.currentState(part));
        if (ofVertices)
            dispatch(program,
                     size_t(part.count) * size_t(plan_->groups[contact_->groups[g].group].vertexCount));
        else
            dispatchTouching(program);
    });
    settled();
}

}  // namespace shoal
