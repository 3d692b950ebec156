// The passes of the response of contact on the fused path.
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
        .add("lists", lists_.texture)
        .add("counts", counts_[memory_].texture)
        .add("materials", materials_.texture);
    program.set("listStride", int(padded_));
    setResponse(program, times);
    if (bodies_.buffer && program.uses("bodies")) {
        int rigid = 0;
        for (size_t g = 0; g < groups_.size(); ++g)
            if (plan_->groups[contact_->groups[g].group].rigid) rigid |= 1 << g;
        program.set("rigidGroups", rigid);
        textures.add("bodies", bodies_.texture);
    }
    return textures;
}

void MoleculeContact::runNearest(Buffers&, const Times& times) {
    bindResponse(nearest_, times);
    nearest_.storage("NewImpulses", 0, impulses_[sides_[0]].buffer);
    nearest_.storage("Shifts", 2, shifts_.buffer);
    dispatchTouching(nearest_);
    settled();
}

void MoleculeContact::prepare(Buffers& state, const Times& times) {
    Textures textures = bindResponse(prepare_, times);
    textures.add("oldSlots", slots_[1 - memory_].texture)
        .add("oldCounts", counts_[1 - memory_].texture)
        .add("oldPushes", pushes_[pushed_].texture)
        .add("oldAnchors", anchors_[1 - memory_].texture)
        .add("oldKnown", known_[1 - memory_].texture);
    pushed_ = 1 - pushed_;
    prepare_.storage("Parts", 9, parts_.buffer);
    prepare_.storage("Shifts", 8, parted_[sides_[0]].buffer);
    prepare_.storage("Impulses", 0, impulses_[sides_[0]].buffer);
    prepare_.storage("Pushes", 1, pushes_[pushed_].buffer);
    prepare_.storage("Anchors", 2, anchors_[memory_].buffer);
    prepare_.storage("Known", 3, known_[memory_].buffer);
    if (spreads_)
        prepare_.storage("Normals", 4, normals_.buffer);
    else
        prepare_.storage("EffectiveCounts", 4, effectiveCounts_.buffer);
    if (walls_) bindWalls(prepare_, textures);
    if (walls_) prepare_.storage("WallNormals", 10, wallNormals_.buffer);
    dispatchTouching(prepare_);
    settled();
    if (!spreads_) return;
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].effectiveSum;
        Textures(program)
            .add("slots", slots_[memory_].texture)
            .add("counts", counts_[memory_].texture)
            .add("normals", normals_.texture)
            .add("shapes", groups_[g].shapes.texture);
        program.storage("EffectiveCounts", 0, effectiveCounts_.buffer);
        dispatch(program, setSpheres(program, g, part, first));
    });
    settled();
}

void MoleculeContact::bindWalls(const Program& program, Textures& textures) const {
    textures.add("walls", nearWalls_.texture);
    program.storage("WallPushes", 7, wallPushes_.buffer);
}

void MoleculeContact::relax(Buffers& state, const Times& times, float momentum) {
    spread(state, momentum);
    // without momentum the earlier ones do not count, and nobody may have written them yet
    const Array& earlier = impulses_[sides_[momentum == 0 ? 0 : 1]];
    Textures textures = bindResponse(relax_, times);
    textures.add("effectiveCounts", effectiveCounts_.texture)
        .add("impulses", impulses_[sides_[0]].texture)
        .add("earlier", earlier.texture)
        .add("known", known_[memory_].texture)
        .add("anchors", anchors_[memory_].texture);
    if (spreads_) textures.add("velocities", velocities_.texture).add("moves", moves_.texture);
    textures.add("shifts", parted_[sides_[0]].texture)
        .add("earlierShifts", parted_[sides_[momentum == 0 ? 0 : 1]].texture);
    relax_.storage("Parts", 3, parts_.buffer);
    relax_.storage("Shifts", 4, parted_[sides_[2]].buffer);
    if (walls_) bindWalls(relax_, textures);
    relax_.set("momentum", momentum);
    relax_.storage("Impulses", 0, impulses_[sides_[2]].buffer);
    relax_.storage("Pushes", 1, pushes_[pushed_].buffer);
    relax_.storage("Earlier", 2, pushes_[1 - pushed_].buffer);
    dispatchTouching(relax_);
    settled();
    pushed_ = 1 - pushed_;
    std::rotate(sides_.begin(), sides_.begin() + 2, sides_.end());
}

void MoleculeContact::settle(Buffers&, const Times& times) {
    Textures textures = bindResponse(settle_, times);
    textures.add("effectiveCounts", effectiveCounts_.texture);
    textures.add("parted", parted_[sides_[0]].texture);
    if (walls_) settle_.storage("WallPushes", 7, wallPushes_.buffer);
    settle_.storage("Pushes", 1, pushes_[pushed_].buffer);
    settle_.storage("Anchors", 2, anchors_[memory_].buffer);
    settle_.storage("Shifts", 3, shifts_.buffer);
    settle_.storage("Known", 4, known_[memory_].buffer);
    dispatchTouching(settle_);
    settled();
}

void MoleculeContact::spread(Buffers& state, float momentum) {
    if (!spreads_) return;
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].spread;
        Textures textures(program);
        textures
            .add("slots", slots_[memory_].texture)
            .add("counts", counts_[memory_].texture)
            .add("motions", motions_.texture)
            .add("impulses", impulses_[sides_[0]].texture)
            .add("earlier", impulses_[sides_[momentum == 0 ? 0 : 1]].texture)
            .add("shifts", parted_[sides_[0]].texture)
            .add("earlierShifts", parted_[sides_[momentum == 0 ? 0 : 1]].texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture)
;
        if (plan_->groups[contact_->groups[g].group].rigid) textures.add("bodies", bodies_.texture);
        program.set("momentum", momentum);
        program.storage("Moves", 1, moves_.buffer);
        program.storage("Velocities", 0, velocities_.buffer);
        dispatch(program, setSpheres(program, g, part, first));
    });
    settled();
}

void MoleculeContact::apply(Buffers& state, const Times& times) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].apply;
        const bool rigid = plan_->groups[contact_->groups[g].group].rigid;
        const bool ofVertices = contact_->groups[g].triangles || rigid;
        Textures textures(program);
        if (rigid) textures.add("bodies", bodies_.texture);
        textures
            .add(ofVertices ? "slots" : "sorted", ofVertices ? slots_[memory_].texture : pairs_.texture)
            .add("counts", counts_[memory_].texture)
            .add("impulses", impulses_[sides_[0]].texture)
            .add("shifts", shifts_.texture)
            .add("known", known_[memory_].texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        program.set("stepTime", float(times.step));
        program.storage("Loads", 1, loads_.buffer);
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
