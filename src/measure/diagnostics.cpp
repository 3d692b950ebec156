#include "measure/diagnostics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/gl.h"
#include "measure/overlap.h"

namespace shoal::measure {

namespace {

std::string moleculeName(const Plan& plan, size_t group, int molecule) {
    return concat("molecule ", molecule, " of \"", plan.groups[group].name, "\"");
}

}  // namespace

Diagnostics::Diagnostics(const Scene& scene, const Simulation& simulation, const DiagnosticsOptions& options)
    : simulation_(simulation),
      options_(options),
      stretches_(scene, simulation, options),
      duty_(0.2 * options.share),
      last_(options.clock()),
      scene_{scene.file} {
    for (const GroupPlan& plan : simulation.plan().groups) {
        const Group& group = scene.groups[plan.index];
        Molecule molecule = group.molecule;
        if (group.school) std::erase_if(molecule.springs, [](const Spring& s) { return s.actuation; });
        springs_.push_back({std::move(molecule), {plan.count, options.molecules}});
    }
}

std::optional<Warning> Diagnostics::lacks(Diagnostic quantity) const {
    switch (quantity) {
    case Diagnostic::error:
    case Diagnostic::worstError:
    case Diagnostic::energyGiven:
    case Diagnostic::energyLost:
        if (!stretches_.unknownGroups().empty()) return stretches_.unknownGroups().front();
        break;
    case Diagnostic::strain:
    case Diagnostic::rmsStrain:
        if (std::all_of(springs_.begin(), springs_.end(),
                        [](const GroupSprings& each) { return each.molecule.springs.empty(); }))
            return Warning{scene_, "no molecule of the scene has springs"};
        break;
    case Diagnostic::overlap:
    case Diagnostic::rmsOverlap:
    case Diagnostic::contactResidual:
    case Diagnostic::contactsDropped:
        if (!simulation_.contact())
            return Warning{scene_, "no group of the scene has contact between molecules"};
        break;
    }
    return {};
}

bool Diagnostics::follow() {
    stepped_ = stretches_.follow();
    const double moment = options_.clock();
    if (moment < last_ + options_.interval || !duty_.allows(moment)) return false;
    read();
    return true;
}

void Diagnostics::finish(double seconds) {
    stretches_.finish(seconds);
    read();
}

void Diagnostics::read() {
    glFinish();
    const double before = options_.clock();
    Reading next;
    next.time = simulation_.time();
    next.frame = simulation_.frames();
    stretches_.tell(next);
    readStrain(next);
    if (simulation_.contact() && stepped_) readContact(next);
    reading_ = std::move(next);
    last_ = options_.clock();
    duty_.took(last_ - before, last_);
}

void Diagnostics::readStrain(Reading& reading) {
    double square = 0, largest = -1;
    size_t count = 0;
    for (size_t g = 0; g < springs_.size(); ++g) {
        const Molecule& molecule = springs_[g].molecule;
        if (molecule.springs.empty()) continue;
        const MoleculeRange range = springs_[g].sample.next();
        const std::vector<SampledState> molecules = readSample(simulation_, g, range);
        reference::Problem problem{.molecule = &molecule};
        for (size_t m = 0; m < molecules.size(); ++m) {
            if (!molecules[m].alive) continue;
            problem.scale = molecules[m].scale;
            problem.phase = molecules[m].phase;
            for (const Spring& spring : molecule.springs) {
                const reference::State& state = molecules[m].state;
                const double rest = reference::restLength(problem, spring, state.time);
                if (rest <= 0) continue;
                const double length =
                    glm::distance(state.position[size_t(spring.a)], state.position[size_t(spring.b)]);
                double strain = std::abs(length / rest - 1);
                if (std::isnan(strain)) strain = std::numeric_limits<double>::infinity();
                ++count;
                square += strain * strain;
                if (strain <= largest) continue;
                largest = strain;
                reading.places[size_t(Diagnostic::strain)] =
                    moleculeName(simulation_.plan(), g, range.first + int(m));
            }
        }
    }
    if (count == 0) return;
    reading[Diagnostic::strain] = largest;
    reading[Diagnostic::rmsStrain] = std::sqrt(square / double(count));
}

void Diagnostics::readContact(Reading& reading) const {
    const ContactResult& contact = *simulation_.contact();
    const Overlap overlap = overlapOf(simulation_);
    reading[Diagnostic::overlap] = overlap.largest;
    reading[Diagnostic::rmsOverlap] = overlap.rms;
    if (overlap.largest > 0)
        reading.places[size_t(Diagnostic::overlap)] =
            moleculeName(simulation_.plan(), overlap.group, overlap.molecule);
    reading[Diagnostic::contactsDropped] = double(contact.dropped());
    if (const std::optional<float> residual = contact.convergence().residual)
        reading[Diagnostic::contactResidual] = double(*residual);
}

}  // namespace shoal::measure
