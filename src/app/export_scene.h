// Shared by the exports of `shoal export`.
#pragma once

#include <span>
#include <vector>

#include "app/options.h"
#include "simulate/simulation.h"

namespace shoal::app {

inline std::span<const glm::dvec3> ofMolecule(const std::vector<glm::dvec3>& values, const Snapshot& state,
                                              size_t molecule) {
    const auto each = size_t(state.vertexCount);
    return std::span(values).subspan(molecule * each, each);
}

inline std::vector<size_t> livingIn(const Snapshot& state) {
    std::vector<size_t> out;
    for (size_t m = 0; m < size_t(state.count); ++m)
        if (state.alive.empty() || state.alive[m]) out.push_back(m);
    return out;
}

// Runs the simulation for --frames and writes all that is drawn as USD (export_usd.cpp); says what.
void exportUsd(const Options& options, const Scene& scene, Simulation& simulation);

}  // namespace shoal::app
