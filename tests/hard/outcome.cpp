#include "hard/outcome.h"

#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <sstream>

#include "hard/table.h"
#include "simulate/fused.h"
#include "support/catch.h"

namespace shoal::test {

namespace {

std::string shortly(double value) {
    std::ostringstream out;
    out << std::setprecision(2) << value;
    return out.str();
}

// With `limit` 0 only 0 passes.
double share(double value, double limit) {
    return limit > 0 ? value / limit : value > 0 ? 1e30 : 0;
}

Outcome outcomeOf(const Solver& solver, const HardCase& hardCase) {
    Judge judge;
    try {
        hardCase(solver, judge);
        return judge.outcome();
    } catch (const Runaway& runaway) {
        const Alarm& alarm = runaway.alarm();
        if (!alarm.finite) return {Verdict::notFinite, runaway.what()};
        return {Verdict::fails,
                concat("ran away: ", shortly(alarm.speed), " m/s at ", shortly(alarm.time), " s")};
    } catch (const Error& error) {
        return {Verdict::refuses, error.message()};
    }
}

}  // namespace

const char* word(Verdict verdict) {
    static constexpr const char* words[] = {"passes", "refuses", "fails", "NOT FINITE"};
    return words[size_t(verdict)];
}

void Judge::add(Figure figure) {
    finite_ = finite_ && std::isfinite(figure.value);
    for (Figure& known : figures_) {
        if (known.what != figure.what) continue;
        if (figure.badness > known.badness) known = std::move(figure);
        return;
    }
    figures_.push_back(std::move(figure));
}

void Judge::atMost(const std::string& what, double value, double limit) {
    add({what, value, share(std::abs(value), limit)});
}

void Judge::near(const std::string& what, double value, double expected, double margin) {
    add({what, value, share(std::abs(value - expected), margin)});
}

void Judge::report(const std::string& what, double value) {
    add({what, value, 0});
}

void Judge::finite(const Snapshot& snapshot) {
    finite_ = finite_ && test::finite(snapshot);
}

// If any figure fails, only those that do are named, so that the table shows them.
Outcome Judge::outcome() const {
    bool good = true;
    for (const Figure& figure : figures_)
        good = good && figure.badness <= 1;
    std::string text;
    for (const Figure& figure : figures_) {
        if (!good && figure.badness <= 1) continue;
        text += concat(text.empty() ? "" : ", ", figure.what, " ", shortly(figure.value));
    }
    if (!finite_) return {Verdict::notFinite, text};
    return {good ? Verdict::passes : Verdict::fails, text};
}

void holds(const std::string& name, const HardCase& hardCase) {
    const char* alone = std::getenv("SHOAL_HARD_SOLVER");
    for (size_t i = 0; i < solvers().size(); ++i) {
        // a CPU rasteriser takes minutes for the steps of one that is spread over a molecule's lanes
        if (alone ? alone != std::string(solvers()[i].name) : solvers()[i].spread) continue;
        const Outcome outcome = outcomeOf(solvers()[i], hardCase);
        record(name, i, outcome);
        INFO(name << ", " << solvers()[i].name << ": " << outcome.figure);
        const std::optional<Verdict> expected =
            runsHere(solvers()[i]) ? expectedOf(name, solvers()[i]) : Verdict::refuses;
        // docs/hard-cases.tsv lacks a case or a solver: SHOAL_UPDATE_HARD=1 writes it
        CHECK(std::string(word(outcome.verdict)) == (expected ? word(*expected) : "nothing"));
    }
}

bool onPingPong() {
    return testPath() == Path::pingPong;
}

Simulation hardSimulation(const Scene& scene, bool drawn) {
    return Simulation(testContext(), compile(scene), {.drawn = drawn, .path = testPath()});
}

void runChecked(Simulation& simulation, int frames) {
    run(simulation, frames);
    simulation.check();
}

void startFrom(Simulation& simulation, const std::function<void(GroupState&)>& edit) {
    simulation.restart();
    SavedState state = simulation.save();
    for (GroupState& group : state.groups) {
        group.displacements.clear();
        group.velocityChanges.clear();
        edit(group);
    }
    simulation.load(state);
}

glm::dvec3 placeOf(const GroupState& state, size_t vertex) {
    const size_t vertices = state.positions.size() / state.anchors.size();
    return glm::dvec3(state.anchors[vertex / vertices]) + glm::dvec3(state.positions[vertex]);
}

void moveTo(GroupState& state, size_t vertex, const glm::dvec3& position) {
    const size_t vertices = state.positions.size() / state.anchors.size();
    state.positions[vertex] = glm::vec3(position - glm::dvec3(state.anchors[vertex / vertices]));
}

void scaleMolecules(GroupState& state, const glm::dvec3& factors) {
    const size_t vertices = state.positions.size() / state.anchors.size();
    for (size_t i = 0; i < state.positions.size(); ++i) {
        const glm::dvec3 first = placeOf(state, i / vertices * vertices);
        moveTo(state, i, first + factors * (placeOf(state, i) - first));
    }
}

Molecule tetrahedron(double stiffness, double damping) {
    Molecule out = leaf(stiffness, damping);
    out.name = "tetrahedron";
    const glm::dvec3 corners[] = {{0, 0, 0}, {0.5, 0, 0}, {0.25, 0, -0.4}, {0.25, 0.45, -0.15}};
    for (size_t i = 0; i < 4; ++i)
        out.vertices[i].position = corners[i];
    return out;
}

double divided(const Solver& solver, int steps) {
    return solver.kind == SolverKind::verlet || solver.kind == SolverKind::xpbd ? 6e-8 * steps : 0;
}

double strainOf(const Molecule& molecule, const reference::State& state) {
    double sum = 0;
    for (const Spring& spring : molecule.springs) {
        const double length =
            glm::length(state.position[size_t(spring.a)] - state.position[size_t(spring.b)]);
        const double strain = length / molecule.restLength(spring) - 1;
        sum += strain * strain / double(molecule.springs.size());
    }
    return std::sqrt(sum);
}

}  // namespace shoal::test
