#include "simulate/contact/solver.h"

#include <algorithm>
#include <optional>

#include "core/contract.h"
#include "simulate/contact/readback.h"

namespace shoal {

using gpu::Program;

ContactSolver::ContactSolver(ContactData& data) : data_(&data) {
    EXPECTS(data.textures ||
            data.arrays.buffer("batches").bytes() == batchBytes * ContactSettings::mostIterations / 2);
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
            residual_ = data.stage("contact/response/residual");
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
    const int rounds = std::min(data_->contact->settings.iterations, ContactPlan::mostRounds);
    for (int round = 1; round <= rounds; ++round) {
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
void ContactSolver::findVelocities(const Iteration& iteration) {
    forBodies([&](size_t g, size_t part, const ContactData::Spheres& spheres) {
        const ContactGroup& group = data_->contact->groups[g];
        const Program& program = data_->withPart(groups_[g].velocities, group, part);
        program.set("momentum", iteration.momentum);
        program.set("firstSphere", spheres.first);
        if (!data_->textures) program.set("batch", iteration.batch);
        runBodies(program, group, spheres);
    });
}

ContactSolver::Iteration ContactSolver::iteration(int number) const {
    const int iterations = data_->contact->settings.iterations;
    const int batch = std::max(0, (number - iterations % 2) / 2);
    const bool isLast = number > 0 && (iterations - number) % 2 == 1;
    const auto momentum = [&](int i) {
        return ContactPlan::momentum(i, iterations, data_->contact->unlikeMasses);
    };
    return {number, batch, isLast, momentum(number), momentum(number + 1)};
}

void ContactSolver::solve(const ContactStep& times, const Iteration& iteration) {
    if (data_->spreads) findVelocities(iteration);
    const auto use = [&](const Program& program) -> const Program& {
        data_->withResponse(program, times);
        if (&program != &solveFirst_) program.set("momentum", iteration.momentum);
        return program;
    };
    if (data_->textures) {
        runEntries(use(solveEntries_));
        data_->arrays.rotate({"impulses", "earlierImpulses", "nextImpulses"});
        data_->runAll(use(solve_));
        data_->arrays.rotate({"totals", "earlierTotals", "nextTotals"});
        if (data_->colliders)
            data_->arrays.rotate({"colliderImpulses", "earlierColliderImpulses", "nextColliderImpulses"});
        if (iteration.endsBatch) data_->runAll(use(residual_));
        return;
    }
    const bool isFirst = iteration.number == 0;
    const Program& program = use(isFirst ? solveFirst_ : solve_);
    if (!data_->spreads) program.set("nextMomentum", iteration.nextMomentum);
    if (!isFirst) {
        program.set("batch", iteration.endsBatch ? iteration.batch : -1);
        program.set("tolerance", float(data_->contact->settings.tolerance));
    }
    data_->arrays.runIndirect(program, "batches", batchBytes * size_t(iteration.batch));
    data_->arrays.swap("totals", "earlierTotals");
    data_->arrays.swap("impulses", "earlierImpulses");
    if (!data_->spreads) data_->arrays.swap("velocities", "nextVelocities");
}

// With buffers the GPU ends them: what comes then has no workgroups.
void ContactSolver::iterate(const ContactStep& times) {
    const ContactSettings& settings = data_->contact->settings;
    for (int i = 0; i < settings.iterations; ++i) {
        const Iteration next = iteration(i);
        solve(times, next);
        if (!data_->textures) continue;
        inFragments_ = {i + 1, {}};
        if (!next.endsBatch) continue;
        inFragments_.residual = largestResidual(*data_);
        if (*inFragments_.residual <= float(settings.tolerance)) return;
    }
}

ContactConvergence ContactSolver::convergence() const {
    if (!data_->remembers) return {};
    ContactConvergence out = data_->textures ? inFragments_ : convergenceOf(*data_);
    if (data_->plan->gravity == glm::dvec3(0)) out.residual.reset();
    return out;
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
        iterate(times);
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
