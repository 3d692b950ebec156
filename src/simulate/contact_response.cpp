// The response of contact on the fused path: the impulses of all contacts, in Jacobi iterations, into the
// state.
#include "simulate/molecule_contact.h"

namespace shoal {

using gpu::Program;

void MoleculeContact::dispatchActive(const Program& program) const {
    program.storage("Active", 3, active_);
    program.dispatchIndirect(active_, 0);
}

// Binds what all stages of the response read.
MoleculeContact::Textures MoleculeContact::bindResponse(const Program& program, double stepTime,
                                                        double restSpeed) const {
    Textures textures(program);
    textures.add("places", places_.texture)
        .add("sorted", pairs_.texture)
        .add("motions", motions_.texture)
        .add("cells", cells_.texture)
        .add("lists", lists_.texture)
        .add("counts", counts_.texture)
        .add("materials", materials_.texture);
    program.set("count", contact_->spheres);
    program.set("cell", float(contact_->cell));
    program.set("groupCount", int(contact_->groups.size()));
    program.set("listStride", int(padded_));
    program.set("stepTime", float(stepTime));
    program.set("restSpeed", float(restSpeed));
    return textures;
}

void MoleculeContact::runNearest(double stepTime, double restSpeed, const Totals& totals) {
    bindResponse(nearest_, stepTime, restSpeed);
    nearest_.storage("NewImpulses", 0, impulses_[totals.next].buffer);
    nearest_.storage("Shifts", 2, shifts_.buffer);
    dispatchActive(nearest_);
    settled();
}

// The effective number of contacts that act on the same vertices.
void MoleculeContact::runEffective(double stepTime, double restSpeed,
                                   const std::vector<GroupBuffers>& state) {
    Textures textures = bindResponse(effective_, stepTime, restSpeed);
    if (walls_) textures.add("walls", nearWalls_.texture);
    if (triangles_)
        effective_.storage("Normals", 0, normals_.buffer);
    else
        effective_.storage("EffectiveCounts", 0, effectiveCounts_.buffer);
    dispatchActive(effective_);
    settled();
    if (!triangles_) return;
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].effectiveSum;
        Textures(program)
            .add("slots", slots_.texture)
            .add("counts", counts_.texture)
            .add("normals", normals_.texture)
            .add("shapes", groups_[g].shapes.texture);
        program.storage("EffectiveCounts", 0, effectiveCounts_.buffer);
        dispatch(program, setSpheres(program, g, part, first));
    });
    settled();
}

void MoleculeContact::runStage(const Program& program, double stepTime, double restSpeed,
                               const Totals& totals) {
    Textures textures = bindResponse(program, stepTime, restSpeed);
    textures.add("effectiveCounts", effectiveCounts_.texture)
        .add("impulses", impulses_[totals.last].texture)
        // without momentum the earlier ones do not count, and nobody may have written them yet
        .add("earlier", impulses_[totals.momentum == 0 ? totals.last : totals.earlier].texture);
    program.set("momentum", totals.momentum);
    program.set("frictionShare", 1.0f / ContactPlan::frictionRounds);
    if (triangles_) textures.add("velocities", velocities_.texture);
    if (walls_) {
        textures.add("walls", nearWalls_.texture).add("wallFriction", wallFriction_.texture);
        program.storage("WallPushed", 4, wallPushed_.buffer);
    }
    program.storage("NewImpulses", 0, impulses_[totals.next].buffer);
    program.storage("Pushed", 1, pushed_.buffer);
    if (&program == &correction_) textures.add("kept", shifts_.texture);
    if (&program == &friction_) program.storage("Shifts", 2, shifts_.buffer);
    dispatchActive(program);
    settled();
}

void MoleculeContact::spread(const std::vector<GroupBuffers>& state, const Totals& totals) {
    if (!triangles_) return;
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].spread;
        Textures(program)
            .add("slots", slots_.texture)
            .add("counts", counts_.texture)
            .add("motions", motions_.texture)
            .add("impulses", impulses_[totals.last].texture)
            .add("earlier", impulses_[totals.earlier].texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        program.set("momentum", totals.momentum);
        program.storage("Velocities", 0, velocities_.buffer);
        dispatch(program, setSpheres(program, g, part, first));
    });
    settled();
}

void MoleculeContact::apply(const std::vector<GroupBuffers>& state, const Array& impulses) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].apply;
        const bool ofVertices = contact_->groups[g].triangles;
        Textures(program)
            .add(ofVertices ? "slots" : "sorted", ofVertices ? slots_.texture : pairs_.texture)
            .add("counts", counts_.texture)
            .add("impulses", impulses.texture)
            .add("shifts", shifts_.texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        setSpheres(program, g, part, first);
        store(program, "State", 0, buffers.currentState(part));
        if (ofVertices)
            dispatch(program,
                     size_t(part.count) * size_t(plan_->groups[contact_->groups[g].group].vertexCount));
        else
            dispatchActive(program);
    });
    settled();
}

void MoleculeContact::respond(const Frame& frame, const std::vector<GroupBuffers>& state) {
    const double stepTime = frame.parameters.frameTime;
    // what gravity adds in two steps is no bounce
    const double restSpeed = 2 * glm::length(frame.parameters.gravity) * stepTime;
    Totals totals;
    if (nearest_) {
        runNearest(stepTime, restSpeed, totals);
        return apply(state, impulses_[totals.next]);
    }
    runEffective(stepTime, restSpeed, state);
    const auto run = [&](const Program& program) {
        runStage(program, stepTime, restSpeed, totals);
        totals = {totals.next, totals.last, totals.earlier};
    };
    run(guess_);
    for (int i = 0; i < contact_->settings.iterations; ++i) {
        totals.momentum = i == 0 ? 0.0f : float(i) / float(i + 3);  // Nesterov's, from rest
        spread(state, totals);
        run(relax_);
    }
    totals.momentum = 0;
    for (int i = 0; i < ContactPlan::frictionRounds; ++i) {
        spread(state, totals);
        run(friction_);
    }
    run(correction_);
    apply(state, impulses_[totals.last]);
}

}  // namespace shoal
