// The passes of the response of contact on the fused path.
#include <algorithm>

#include "simulate/molecule_contact.h"

namespace shoal {

using gpu::Program;

void MoleculeContact::dispatchTouching(const Program& program) const {
    ++dispatches_;
    program.dispatchIndirect(touchingGroups_, 0);
}

// Runs a lane a sphere, or a rigid body.
void MoleculeContact::dispatchBodies(const Program& program, size_t group, const SphereRange& range) const {
    const size_t spheres = setSpheres(program, range);
    dispatch(program, isRigid(group) ? spheres / size_t(contact_->groups[group].spheresOf) : spheres);
}

// Uses a program of the response, with what all of its stages are given.
const Program& MoleculeContact::withResponse(const Program& program, const Times& times) const {
    with(program).set("listStride", int(padded_));
    setResponse(program, times);
    return program;
}

void MoleculeContact::runNearest(Buffers&, const Times& times) {
    dispatchTouching(withResponse(nearest_, times));
    settled();
}

void MoleculeContact::prepare(Buffers& state, const Times& times) {
    dispatchTouching(withResponse(prepare_, times));
    settled();
    if (spreads_) countEffective(state);
}

// Where contacts of several spheres act together.
void MoleculeContact::countEffective(Buffers& state) {
    forBodies(state, [&](size_t g, const GroupBuffers::Part&, const SphereRange& range) {
        const Program& program = with(groups_[g].effectiveSum);
        program.texture("shapes", groups_[g].shapes.texture);
        dispatchBodies(program, g, range);
    });
    settled();
}

void MoleculeContact::relax(Buffers& state, const Times& times, int iteration) {
    const bool first = iteration == 0;
    const float now = momentum(iteration);
    // without momentum the earlier ones do not count, and nobody may have written them yet
    if (spreads_) spread(state, totals_[now == 0 ? 0 : 1], now);
    const Program& program = withResponse(first ? relaxFirst_ : relax_, times);
    if (!first) program.set("momentum", now);
    if (!spreads_) program.set("nextMomentum", momentum(iteration + 1));
    program.storage("Totals", totals_[2].buffer);
    dispatchTouching(program);
    settled();
    std::swap(pushes_[0], pushes_[1]);
    if (!spreads_) std::swap(motionsNow_[0], motionsNow_[1]);
    std::rotate(totals_.begin(), totals_.begin() + 2, totals_.end());
}

void MoleculeContact::spread(Buffers& state, const Array& earlier, float momentum) {
    forBodies(state, [&](size_t g, const GroupBuffers::Part& part, const SphereRange& range) {
        const Program& program = with(groups_[g].spread);
        program.texture("earlier", earlier.texture);
        program.texture("oldRecords", part.record);
        program.texture("shapes", groups_[g].shapes.texture);
        program.set("momentum", momentum);
        dispatchBodies(program, g, range);
    });
    settled();
}

void MoleculeContact::settle(Buffers&, const Times& times) {
    dispatchTouching(withResponse(settle_, times));
    settled();
}

void MoleculeContact::apply(Buffers& state, const Times& times) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part,
                        const SphereRange& range) {
        const Program& program = with(groups_[g].apply);
        program.texture("oldRecords", part.record);
        program.texture("shapes", groups_[g].shapes.texture);
        store(program, "State", buffers.currentState(part));
        setTimes(program, times);
        program.set("substepTime", float(times.substep));
        setSpheres(program, range);
        if (contact_->groups[g].triangles || isRigid(g))  // spheres act on a vertex
            dispatch(program,
                     size_t(part.count) * size_t(plan_->groups[contact_->groups[g].group].vertexCount));
        else
            dispatchTouching(program);
    });
    settled();
}

// m/s: the change of velocity from which on what rests wakes, a tenth of what gravity adds in a step but at
// least the scene's `rest`.
float MoleculeContact::wakeSpeed(const Times& times) const {
    return float(std::max(times.restSpeed / 20, *contact_->settings.rest));
}

// Gives resting molecules the impulses that awake ones have worked out.
void MoleculeContact::weigh(const Times& times) {
    withResponse(weigh_, times).set("wakeSpeed", wakeSpeed(times));
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
        const Program& program = with(groups_[g].rest);
        program.texture("oldRecords", part.record);
        store(program, "State", buffers.currentState(part));
        program.set("stepTime", float(times.step));
        program.set("restTime", float(ContactPlan::restTime));
        program.set("restDistance", float(*contact_->settings.rest * ContactPlan::restTime));
        program.set("wakeSpeed", wakeSpeed(times));
        program.set("probes", int(groups_[g].probes));
        program.set("wakes", int(wakes_));
        setSpheres(program, range);
        dispatch(program, size_t(part.count));
    });
    settled();
}

}  // namespace shoal
