#include "simulate/contact/solver.h"

#include <optional>

namespace shoal {

using gpu::Program;

ContactSolver::ContactSolver(ContactData& data) : data_(&data) {
    if (data.remembers) {
        prepare_ = data.stage("contact/response/prepare");
        solve_ = data.stage("contact/response/solve");
        store_ = data.stage("contact/response/store");
        chooseFirst_ = data.stage("contact/response/choose", {"FIRST"}, "choose_first");
        choose_ = data.stage("contact/response/choose");
        strike_ = data.stage("contact/response/strike");
        if (data.textures) {
            prepareEntries_ = data.stage("contact/response/prepare", {"ENTRIES"}, "prepare_entries");
            constrain_ = data.stage("contact/response/solve", {"FIRST", "ENTRIES"}, "constrain");
            solveEntries_ = data.stage("contact/response/solve", {"ENTRIES"}, "solve_entries");
        } else {
            solveFirst_ = data.stage("contact/response/solve", {"FIRST"}, "solve_first");
        }
    } else {
        nearest_ = data.stage("contact/response/nearest");
    }
    for (const ContactGroup& group : data.contact->groups) {
        Group& made = groups_.emplace_back();
        made.apply =
            data.groupStage(group, data.textures ? "contact/response/gains" : "contact/response/apply");
        if (!data.spreads) continue;
        made.effectiveSum = data.groupStage(group, "contact/response/spread", {}, "effective_sum");
        made.velocities = data.groupStage(group, "contact/response/spread", {"VELOCITIES"}, "velocities");
    }
}

template <typename Visit>
void ContactSolver::forBodies(const Visit& visit) const {
    struct Run {
        size_t group, part;
        ContactData::Spheres spheres;
    };
    std::optional<Run> run;
    data_->forParts([&](size_t g, size_t part, const MoleculeRange& molecules) {
        const std::vector<ContactGroup>& groups = data_->contact->groups;
        const ContactData::Spheres more = data_->spheresOf(groups[g], molecules);
        const bool together = run && !data_->textures && data_->isRigid(groups[run->group]) &&
                              data_->isRigid(groups[g]) &&
                              run->spheres.first + run->spheres.count == more.first &&
                              groups[run->group].spheresOf == groups[g].spheresOf;
        if (together) {
            run->spheres.count += more.count;
            return;
        }
        if (run) visit(run->group, run->part, run->spheres);
        run = Run{g, part, more};
    });
    if (run) visit(run->group, run->part, run->spheres);
}

void ContactSolver::runBodies(const Program& program, const ContactGroup& group,
                              const ContactData::Spheres& spheres) {
    if (data_->textures) {
        program.set("groupSpheres", spheres.count);
        program.set("count", data_->contact->spheres);
        return data_->runAll(program);
    }
    data_->arrays.run(program, spheres.first,
                      data_->isRigid(group) ? spheres.count / group.spheresOf : spheres.count);
}

void ContactSolver::runEntries(const Program& program) {
    const int together = data_->arrays.entriesADraw(program);
    for (int first = 0; first < data_->listLength; first += together) {
        program.set("firstEntry", first);
        data_->arrays.run(program, 0, data_->contact->spheres, first);
    }
}

// Rounds of a choice and what follows from it; with buffers they are empty where there is no impact.
void ContactSolver::strike(const ContactStep& times) {
    const auto run = [&](const Program& program, int round) {
        data_->withResponse(program, times);
        if (program.uses("roundNumber")) program.set("roundNumber", round);
        if (data_->textures)
            data_->runAll(program);
        else if (&program == &chooseFirst_)
            data_->runResponding(program);
        else
            data_->arrays.runIndirect(program, "impactGroups", 0);
    };
    for (int round = 1; round <= data_->contact->settings.iterations; ++round) {
        run(round == 1 ? chooseFirst_ : choose_, round);
        run(strike_, round);
        if (!data_->textures) continue;
        data_->arrays.swap("places", "nextPlaces");
        data_->arrays.swap("motions", "nextMotions");
        data_->arrays.swap("impacts", "nextImpacts");
    }
}

void ContactSolver::prepare(const ContactStep& times) {
    if (data_->textures) {
        runEntries(data_->withResponse(prepareEntries_, times));
        data_->arrays.rotate({"impulses", "earlierImpulses", "nextImpulses"});
    }
    data_->runResponding(data_->withResponse(prepare_, times));
    if (data_->textures && data_->colliders)
        data_->arrays.rotate({"colliderImpulses", "earlierColliderImpulses", "nextColliderImpulses"});
    if (data_->spreads) countEffective();
    if (data_->textures) runEntries(data_->withResponse(constrain_, times));
}

void ContactSolver::countEffective() {
    forBodies([&](size_t g, size_t part, const ContactData::Spheres& spheres) {
        const ContactGroup& group = data_->contact->groups[g];
        const Program& program = data_->withPart(groups_[g].effectiveSum, group, part);
        program.set("firstSphere", spheres.first);
        runBodies(program, group, spheres);
    });
}

// Where one sphere's contacts move others.
void ContactSolver::findVelocities(float momentum) {
    forBodies([&](size_t g, size_t part, const ContactData::Spheres& spheres) {
        const ContactGroup& group = data_->contact->groups[g];
        const Program& program = data_->withPart(groups_[g].velocities, group, part);
        program.set("momentum", momentum);
        program.set("firstSphere", spheres.first);
        runBodies(program, group, spheres);
    });
}

void ContactSolver::solve(const ContactStep& times, int iteration) {
    const int iterations = data_->contact->settings.iterations;
    const float momentum = ContactPlan::momentum(iteration, iterations);
    if (data_->spreads) findVelocities(momentum);
    const auto use = [&](const Program& program) -> const Program& {
        data_->withResponse(program, times);
        if (&program != &solveFirst_) program.set("momentum", momentum);
        return program;
    };
    if (data_->textures) {
        runEntries(use(solveEntries_));
        data_->arrays.rotate({"impulses", "earlierImpulses", "nextImpulses"});
    }
    const bool isFirst = iteration == 0 && !data_->textures;
    const Program& program = use(isFirst ? solveFirst_ : solve_);
    if (!data_->textures && !data_->spreads)
        program.set("nextMomentum", ContactPlan::momentum(iteration + 1, iterations));
    data_->runResponding(program);
    data_->arrays.rotate({"totals", "earlierTotals", "nextTotals"});
    if (data_->textures) {
        if (data_->colliders)
            data_->arrays.rotate({"colliderImpulses", "earlierColliderImpulses", "nextColliderImpulses"});
        return;
    }
    data_->arrays.swap("impulses", "earlierImpulses");
    if (!data_->spreads) data_->arrays.swap("velocities", "nextVelocities");
}

void ContactSolver::store(const ContactStep& times) {
    data_->runResponding(data_->withResponse(store_, times));
    if (data_->textures) data_->arrays.rotate({"totals", "earlierTotals", "nextTotals"});
}

void ContactSolver::apply(const ContactStep& times) {
    data_->forParts([&](size_t g, size_t part, const MoleculeRange& molecules) {
        const ContactGroup& group = data_->contact->groups[g];
        const ContactData::Spheres spheres = data_->spheresOf(group, molecules);
        const Program& program = data_->withPart(groups_[g].apply, group, part);
        program.set("stepTime", float(times.step));
        program.set("restSpeed", float(times.restSpeed));
        program.set("substepTime", float(times.substep));
        program.set("firstSphere", spheres.first);
        if (data_->manyAct(group))
            return data_->arrays.run(program, spheres.first,
                                     molecules.count * data_->planOf(group).vertexCount);
        program.set("partSpheres", spheres.count);
        data_->runResponding(program);
    });
    data_->arrays.settle();
}

void ContactSolver::applyGains(const ContactStep& times) {
    data_->forParts([&](size_t g, size_t part, const MoleculeRange& molecules) {
        const ContactGroup& group = data_->contact->groups[g];
        const ContactData::Spheres spheres = data_->spheresOf(group, molecules);
        const bool many = data_->manyAct(group);
        const Program& program =
            many ? data_->withPart(groups_[g].apply, group, part) : data_->use(groups_[g].apply);
        program.set("stepTime", float(times.step));
        if (many) program.set("firstSphere", spheres.first);
        data_->arrays.run(program, spheres.first, spheres.count);
        data_->state->apply(group.group, [&](const Program& applies) {
            applies.set("firstSphere", group.firstSphere);
            applies.texture("gains", data_->arrays.texture("gains"));
            if (!applies.uses("restSpeed")) return;  // it has no history
            applies.set("restSpeed", float(times.restSpeed));
            applies.set("substepTime", float(times.substep));
        });
    });
}

void ContactSolver::run(const ContactStep& times) {
    if (data_->remembers) {
        strike(times);
        prepare(times);
        for (int i = 0; i < data_->contact->settings.iterations; ++i)
            solve(times, i);
        store(times);
    } else {
        data_->runResponding(data_->withResponse(nearest_, times));
    }
    if (data_->textures)
        applyGains(times);
    else
        apply(times);
}

}  // namespace shoal
