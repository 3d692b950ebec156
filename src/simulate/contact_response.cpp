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
        .add("counts", counts_.texture)
        .add("materials", materials_.texture);
    program.set("listStride", int(padded_));
    setResponse(program, times);
    return textures;
}

void MoleculeContact::runNearest(Buffers&, const Times& times, const Totals& totals) {
    bindResponse(nearest_, times);
    nearest_.storage("NewImpulses", 0, impulses_[totals.next].buffer);
    nearest_.storage("Shifts", 2, shifts_.buffer);
    dispatchTouching(nearest_);
    settled();
}

void MoleculeContact::runEffective(Buffers& state, const Times& times) {
    Textures textures = bindResponse(effective_, times);
    if (walls_) textures.add("walls", nearWalls_.texture);
    if (triangles_)
        effective_.storage("Normals", 0, normals_.buffer);
    else
        effective_.storage("EffectiveCounts", 0, effectiveCounts_.buffer);
    dispatchTouching(effective_);
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

void MoleculeContact::runStage(Buffers&, const Program& program, const Times& times, const Totals& totals) {
    Textures textures = bindResponse(program, times);
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
    dispatchTouching(program);
    settled();
}

void MoleculeContact::spread(Buffers& state, const Totals& totals) {
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

void MoleculeContact::apply(Buffers& state, size_t impulses) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].apply;
        const bool ofVertices = contact_->groups[g].triangles;
        Textures(program)
            .add(ofVertices ? "slots" : "sorted", ofVertices ? slots_.texture : pairs_.texture)
            .add("counts", counts_.texture)
            .add("impulses", impulses_[impulses].texture)
            .add("shifts", shifts_.texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
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
