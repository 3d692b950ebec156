// The passes of the response of contact on the fused path.
#include <algorithm>

#include "simulate/molecule_contact.h"

namespace shoal {

using gpu::Program;

void MoleculeContact::dispatchTouching(const Program& program) const {
    program.storage("Touching", 5, touching_);
    ++dispatches_;
    program.dispatchIndirect(touchingGroups_, 0);
}

// Runs a lane a sphere, or a rigid body.
void MoleculeContact::dispatchBodies(const Program& program, size_t group, const SphereRange& range) const {
    const size_t spheres = setSpheres(program, range);
    dispatch(program, isRigid(group) ? spheres / size_t(contact_->groups[group].spheresOf) : spheres);
}

// Binds what all stages of the response read.
MoleculeContact::Textures MoleculeContact::bindResponse(const Program& program, const Times& times) const {
    Textures textures(program);
    textures.add("places", places_.texture)
        .add("sorted", pairs_.texture)
        .add("motions", motions_.texture)
        .add("cells", cells_.texture)
        .add("lists", lists_.texture)
        .add("counts", counts_.texture)
        .add("materials", materials_.texture);
    if (rests()) textures.add("marks", marks_.texture);
    program.set("listStride", int(padded_));
    setResponse(program, times);
    if (rigid_ && program.uses("bodies")) textures.add("bodies", bodies_.texture);
    return textures;
}

void MoleculeContact::bindWalls(const Program& program, Textures& textures) const {
    if (!walls_) return;
    if (program.uses("walls")) textures.add("walls", nearWalls_.texture);
    program.storage("WallPushes", 7, wallPushes_.buffer);
}

void MoleculeContact::runNearest(Buffers&, const Times& times) {
    bindResponse(nearest_, times);
    nearest_.storage("Totals", 0, totals_[0].buffer);
    dispatchTouching(nearest_);
    settled();
}

void MoleculeContact::prepare(Buffers& state, const Times& times) {
    Textures textures = bindResponse(prepare_, times);
    textures.add("oldLists", partners_.texture)
        .add("oldPushes", oldPushes_.texture)
        .add("oldAnchors", oldAnchors_.texture);
    bindWalls(prepare_, textures);
    prepare_.storage("Totals", 0, totals_[0].buffer);
    prepare_.storage("Pushes", 1, pushes_[0].buffer);
    prepare_.storage("Anchors", 2, anchors_.buffer);
    prepare_.storage("Known", 3, known_.buffer);
    if (spreads_) {
        prepare_.storage("ContactSums", 4, contactSums_.buffer);
    } else {
        prepare_.storage("EffectiveCounts", 4, effectiveCounts_.buffer);
        prepare_.storage("MotionsNow", 6, motionsNow_[0].buffer);
    }
    dispatchTouching(prepare_);
    settled();
    if (spreads_) countEffective(state);
}

// Where contacts of several spheres act together.
void MoleculeContact::countEffective(Buffers& state) {
    forBodies(state, [&](size_t g, const GroupBuffers::Part&, const SphereRange& range) {
        const Program& program = groups_[g].effectiveSum;
        Textures textures(program);
        textures.add("slots", slots_.texture)
            .add("counts", counts_.texture)
            .add("contactSums", contactSums_.texture)
            .add("shapes", groups_[g].shapes.texture);
        if (isRigid(g)) textures.add("bodies", bodies_.texture);
        if (rests()) textures.add("cells", cells_.texture).add("marks", marks_.texture);
        program.storage("EffectiveCounts", 0, effectiveCounts_.buffer);
        dispatchBodies(program, g, range);
    });
    settled();
}

void MoleculeContact::relax(Buffers& state, const Times& times, int iteration) {
    const bool first = iteration == 0;
    const Program& program = first ? relaxFirst_ : relax_;
    const float now = momentum(iteration);
    // without momentum the earlier ones do not count, and nobody may have written them yet
    if (spreads_) spread(state, totals_[now == 0 ? 0 : 1], now);
    Textures textures = bindResponse(program, times);
    textures.add("effectiveCounts", effectiveCounts_.texture).add("known", known_.texture);
    if (first) {
        textures.add("anchors", anchors_.texture);
        program.storage("Normals", 4, normals_.buffer);
        program.storage("Amounts", 6, amounts_.buffer);
    } else {
        textures.add("normals", normals_.texture).add("amounts", amounts_.texture);
        program.set("momentum", now);
    }
    textures.add("motionsNow", motionsNow_[0].texture);
    if (!spreads_) {
        textures.add("totals", totals_[0].texture);
        program.set("nextMomentum", momentum(iteration + 1));
        program.storage("MotionsNext", 3, motionsNow_[1].buffer);
    }
    bindWalls(program, textures);
    program.storage("Totals", 0, totals_[2].buffer);
    program.storage("Pushes", 1, pushes_[0].buffer);
    program.storage("Earlier", 2, pushes_[1].buffer);
    dispatchTouching(program);
    settled();
    std::swap(pushes_[0], pushes_[1]);
    if (!spreads_) std::swap(motionsNow_[0], motionsNow_[1]);
    std::rotate(totals_.begin(), totals_.begin() + 2, totals_.end());
}

void MoleculeContact::spread(Buffers& state, const Array& earlier, float momentum) {
    forBodies(state, [&](size_t g, const GroupBuffers::Part& part, const SphereRange& range) {
        const Program& program = groups_[g].spread;
        Textures textures(program);
        textures.add("slots", slots_.texture)
            .add("counts", counts_.texture)
            .add("motions", motions_.texture)
            .add("totals", totals_[0].texture)
            .add("earlier", earlier.texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        if (isRigid(g)) textures.add("bodies", bodies_.texture);
        if (rests()) textures.add("cells", cells_.texture).add("marks", marks_.texture);
        program.set("momentum", momentum);
        program.storage("MotionsNow", 0, motionsNow_[0].buffer);
        dispatchBodies(program, g, range);
    });
    settled();
}

void MoleculeContact::settle(Buffers&, const Times& times) {
    Textures textures = bindResponse(settle_, times);
    textures.add("effectiveCounts", effectiveCounts_.texture)
        .add("pushes", pushes_[0].texture)
        .add("anchors", anchors_.texture);
    bindWalls(settle_, textures);
    settle_.storage("Totals", 0, totals_[0].buffer);
    settle_.storage("Partners", 1, partners_.buffer);
    settle_.storage("OldPushes", 2, oldPushes_.buffer);
    settle_.storage("Known", 3, known_.buffer);
    settle_.storage("OldAnchors", 4, oldAnchors_.buffer);
    dispatchTouching(settle_);
    settled();
}

void MoleculeContact::apply(Buffers& state, const Times& times) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part,
                        const SphereRange& range) {
        const Program& program = groups_[g].apply;
        const bool rigid = isRigid(g);
        const bool many = contact_->groups[g].triangles || rigid;  // spheres act on a vertex
        Textures textures(program);
        textures.add(many ? "slots" : "sorted", many ? slots_.texture : pairs_.texture)
            .add("counts", counts_.texture)
            .add("totals", totals_[0].texture)
            .add("known", known_.texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        if (rigid) {
            textures.add("bodies", bodies_.texture)
                .add("motions", motions_.texture)
                .add("effectiveCounts", effectiveCounts_.texture);
            if (!rests()) textures.add("cells", cells_.texture);
        }
        if (rests() && many) textures.add("cells", cells_.texture).add("marks", marks_.texture);
        setTimes(program, times);
        program.set("substepTime", float(times.substep));
        if (contact_->remembers()) program.storage("Loads", 1, loads_.buffer);
        setSpheres(program, range);
        store(program, "State", 0, buffers.currentState(part));
        if (many)
            dispatch(program,
                     size_t(part.count) * size_t(plan_->groups[contact_->groups[g].group].vertexCount));
        else
            dispatchTouching(program);
    });
    settled();
}

// m/s: a tenth of what gravity adds in a step.
float MoleculeContact::wakeSpeed(const Times& times) const {
    return float(std::max(times.restSpeed / 20, *contact_->settings.rest));
}

// What rests takes over what is awake has worked out.
void MoleculeContact::weigh(const Times& times) {
    Textures textures = bindResponse(weigh_, times);
    textures.add("slots", slots_.texture).add("markedSlots", markedSlots_.texture);
    weigh_.set("wakeSpeed", wakeSpeed(times));
    weigh_.storage("Totals", 0, totals_[0].buffer);
    weigh_.storage("Partners", 1, partners_.buffer);
    weigh_.storage("OldPushes", 2, oldPushes_.buffer);
    weigh_.storage("Known", 3, known_.buffer);
    weigh_.storage("OldAnchors", 4, oldAnchors_.buffer);
    weigh_.storage("Calm", 5, calm_.buffer);
    if (walls_) weigh_.storage("WallPushes", 6, wallPushes_.buffer);
    weigh_.storage("MarkGroups", 7, markGroups_);
    ++dispatches_;
    weigh_.dispatchIndirect(markGroups_, ofMarked);
    settled();
}

void MoleculeContact::rest(Buffers& state, const Times& times) {
    if (!rests()) return;
    weigh(times);
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part,
                        const SphereRange& range) {
        if (!contact_->mayRest(plan_->groups[contact_->groups[g].group])) return;
        const Program& program = groups_[g].rest;
        Textures(program)
            .add("slots", slots_.texture)
            .add("cells", cells_.texture)
            .add("marks", marks_.texture)
            .add("motions", motions_.texture)
            .add("totals", totals_[0].texture)
            .add("oldRecords", part.record);
        program.set("stepTime", float(times.step));
        program.set("restTime", float(ContactPlan::restTime));
        program.set("restDistance", float(*contact_->settings.rest * ContactPlan::restTime));
        program.set("wakeSpeed", wakeSpeed(times));
        program.set("probes", int(groups_[g].probes));
        program.set("wakes", int(wakes_));
        program.storage("Loads", 1, loads_.buffer);
        program.storage("Calm", 2, calm_.buffer);
        setSpheres(program, range);
        store(program, "State", 0, buffers.currentState(part));
        dispatch(program, size_t(part.count));
    });
    settled();
}

}  // namespace shoal
