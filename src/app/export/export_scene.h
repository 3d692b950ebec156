// Shared by the exports of `shoal export`.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "app/line/options.h"
#include "exchange/drawn_mesh.h"
#include "simulate/simulation.h"

namespace shoal::app {

// Borrows from the snapshot.
inline exchange::MoleculeState moleculeIn(const Snapshot& state, size_t molecule) {
    const auto each = size_t(state.vertexCount);
    exchange::MoleculeState out{std::span(state.positions).subspan(molecule * each, each),
                                std::span(state.velocities).subspan(molecule * each, each),
                                state.seeds[molecule]};
    if (!state.lives.empty()) out.life = state.lives[molecule];
    return out;
}

inline std::vector<exchange::MoleculeState> livingIn(const Snapshot& state) {
    std::vector<exchange::MoleculeState> out;
    for (size_t m = 0; m < size_t(state.count); ++m)
        if (state.alive.empty() || state.alive[m]) out.push_back(moleculeIn(state, m));
    return out;
}

// Warns where --rigid leaves vertices off (m) by more than a twentieth of a molecule's size.
std::vector<Warning> warningsOfBending(const Group& group, const GroupPlan& plan, double residual);

// Looks at so many frames, the first as it is, and shows how far it is, until a signal asks for the end.
void eachFrame(Simulation& simulation, int frames, const std::function<void(int frame)>& look);

// Runs the simulation for --frames, or until a signal asks for the end, and writes all that is drawn as USD
// (export_usd.cpp); says what. False: the signal came before the first frame, and nothing is written.
bool exportUsd(const Options& options, const Scene& scene, Simulation& simulation);

}  // namespace shoal::app
