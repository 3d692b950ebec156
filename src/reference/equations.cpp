#include "reference/equations.h"

#include <cmath>
#include <numbers>

#include "molecule/skin.h"
#include "reference/fields.h"
#include "reference/forces.h"

namespace shoal::reference {

namespace {

// Ends closer than this have no direction between them.
constexpr double coincident = 1e-12;

}  // namespace

Equations::Equations(const Problem& problem) : problem_(&problem) {
    const Molecule& molecule = *problem.molecule;
    inverseMass_.reserve(molecule.vertices.size());
    for (size_t i = 0; i < molecule.vertices.size(); ++i)
        inverseMass_.push_back(problem.pinned(i) ? 0 : 1 / molecule.vertices[i].mass);
    links_ = weightedSprings(molecule);
    for (WeightedSpring& link : links_) {
        link.stiffness *= problem.stiffness;
        link.damping *= problem.damping;
        link.restLength *= problem.scale;
    }
    for (size_t s = 0; s < molecule.springs.size(); ++s)
        if (const auto& muscle = molecule.springs[s].actuation)
            muscles_.push_back({s, links_[s].restLength, muscle->amplitude,
                                2 * std::numbers::pi * muscle->frequency, muscle->phase + problem.phase});
}

void Equations::flex(double time) {
    for (const Muscle& muscle : muscles_) {
        const double contraction = muscle.amplitude * std::sin(muscle.angularFrequency * time + muscle.phase);
        links_[muscle.link].restLength = muscle.restLength * (1 + contraction);
    }
}

void Equations::springs(const Vectors& position, const Vectors& velocity, double time, Vectors& out) {
    flex(time);
    out.assign(position.size(), glm::dvec3(0));
    for (const WeightedSpring& link : links_) {
        const glm::dvec3 d = link.along(position);
        const double square = glm::dot(d, d);
        if (square < coincident * coincident) continue;
        const double length = std::sqrt(square), inverse = 1 / length;
        const double approach = glm::dot(d, link.along(velocity)) * inverse;
        const double pull = link.stiffness * (length - link.restLength) + link.damping * approach;
        const glm::dvec3 force = pull * inverse * d;
        for (size_t i = 0; i < size_t(link.count); ++i)
            out[size_t(link.vertices[i])] -= link.weights[i] * force;
    }
    for (size_t i = 0; i < out.size(); ++i)
        out[i] *= inverseMass_[i];
}

void Equations::everything(const Vectors& position, const Vectors& velocity, double time, Vectors& out) {
    springs(position, velocity, time, out);
    for (size_t i = 0; i < out.size(); ++i) {
        if (!pinned(i)) out[i] += problem_->gravity;
    }
    if (!problem_->forces.empty()) addForces(position, velocity, time, out);
    if (problem_->drag.any()) addDrag(position, velocity, time, out);
}

void Equations::addForces(const Vectors& position, const Vectors& velocity, double time, Vectors& out) {
    const std::vector<Force>& forces = problem_->forces;
    const glm::dvec3 thrust = thrustAcceleration(forces, meanVelocity(*problem_, velocity), time);
    for (size_t i = 0; i < out.size(); ++i)
        if (!pinned(i)) out[i] += thrust + forceAcceleration(forces, position[i], time);
}

void Equations::addDrag(const Vectors& position, const Vectors& velocity, double time, Vectors& out) {
    const Drag& drag = problem_->drag;
    const glm::dvec3 wind = forceWind(problem_->forces, time);
    if (drag.directional()) sumNormals(*problem_->molecule, position, normals_);
    for (size_t i = 0; i < out.size(); ++i) {
        if (pinned(i)) continue;
        const glm::dvec3 slip = wind + fluidVelocity(problem_->fields, position[i], time) - velocity[i];
        out[i] += drag.tangent * slip;
        if (drag.directional())
            out[i] += (drag.normal - drag.tangent) * glm::dot(slip, normals_[i]) * normals_[i];
    }
}

}  // namespace shoal::reference
