// Scenes made in code, run by the passes on the GPU, and the same problem for the double reference.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "compile/plan.h"
#include "gl/gl_test.h"
#include "reference/forces.h"
#include "reference/solve.h"
#include "simulate/simulation.h"
#include "support/shapes.h"

namespace shoal::test {

using Item = Placement::Item;

inline Item at(const glm::dvec3& position, const glm::dquat& rotation = {1, 0, 0, 0}, double scale = 1) {
    return {position, rotation, scale};
}

// One group of molecules, each where an item says and nothing random.
inline Scene sceneOf(Molecule molecule, SolverKind solver, std::vector<Item> items = {Item{}}) {
    Scene scene;
    scene.name = "numerics";
    scene.solver.kind = solver;
    Group group;
    group.name = molecule.name;
    group.molecule = std::move(molecule);
    group.count = int(items.size());
    group.place.kind = Placement::Kind::list;
    group.place.turn = Placement::Turn::none;
    group.place.items = std::move(items);
    scene.groups.push_back(std::move(group));
    return scene;
}

inline void setSteps(Scene& scene, double frameTime, int substeps) {
    scene.frameRate = 1 / frameTime;
    scene.solver.substeps = substeps;
}

inline Simulation simulationOf(const Scene& scene, bool drawn = false) {
    return Simulation(testContext(), compile(scene), {.drawn = drawn, .path = testPath()});
}

inline void run(Simulation& simulation, int frames) {
    for (int i = 0; i < frames; ++i)
        simulation.frame();
}

// The state of one molecule, in world coordinates.
inline reference::State stateOf(const Snapshot& snapshot, int molecule) {
    const auto first = ptrdiff_t(molecule) * snapshot.vertexCount, last = first + snapshot.vertexCount;
    reference::State out;
    out.time = snapshot.time;
    out.position.assign(snapshot.positions.begin() + first, snapshot.positions.begin() + last);
    out.velocity.assign(snapshot.velocities.begin() + first, snapshot.velocities.begin() + last);
    return out;
}

// The equations of one molecule of a scene; borrows the scene's molecule.
inline reference::Problem problemOf(const Scene& scene, int molecule) {
    const Group& group = scene.groups[0];
    reference::Problem out{.molecule = &group.molecule};
    out.scale = place(scene, 0)[size_t(molecule)].scale;
    out.stiffness = group.stiffness;
    out.damping = group.damping;
    if (group.phaseSpread > 0)
        out.phase = double(compile(scene).groups[0].constants.phases[size_t(molecule)]);
    out.held = group.held;
    out.gravity = scene.gravity;
    out.drag = group.drag;
    out.fields = scene.fields;
    out.forces = reference::forcesOn(scene, group);
    return out;
}

inline bool finite(const Snapshot& snapshot) {
    for (size_t i = 0; i < snapshot.positions.size(); ++i) {
        const glm::dvec3 sum =
            snapshot.positions[i] + snapshot.velocities[i] + glm::dvec3(snapshot.normals[i]);
        if (!std::isfinite(sum.x) || !std::isfinite(sum.y) || !std::isfinite(sum.z)) return false;
    }
    return true;
}

constexpr SolverKind bothSolvers[] = {SolverKind::euler, SolverKind::leapfrog};
inline std::vector<SolverKind> explicitSolvers() {
    std::vector<SolverKind> out;
    for (const Solver& one : solvers())
        if (!one.implicit) out.push_back(one.kind);
    return out;
}

// The path that is asked for, else compute shaders where there are some, else fragments.
inline Path pathHere() {
    if (testPath() != Path::automatic) return testPath();
    return testContext().info().computeShaders ? Path::fused : Path::fragments;
}

// Whether the tested path runs it.
inline bool runsHere(const Solver& solver) {
    if (testPath() == Path::pingPong) return !solver.implicit;
    return !solver.spread || (testPath() != Path::fragments && testContext().info().computeShaders);
}

inline std::vector<SolverKind> solversHere() {
    std::vector<SolverKind> out;
    for (const Solver& one : solvers())
        if (runsHere(one)) out.push_back(one.kind);
    return out;
}

// Whether this keeps a molecule in one lane, as implicit solvers demand.
inline bool inOneLane(const SimulationOptions& options) {
    return options.path == Path::fragments || (options.path == Path::fused && options.lanes != Lanes::vertex);
}

inline int orderOf(SolverKind kind) {
    return solver(kind).order;
}

}  // namespace shoal::test
