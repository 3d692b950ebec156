// State written out for other programs: CSV (a row a vertex) and PLY (with triangles).
#pragma once

#include <string>

#include "scene/scene.h"
#include "simulate/simulation.h"

namespace shoal::app {

// Where a frame's state goes: "out.csv" and "out.ply" become "out-00060.csv" and so on when several frames
// are asked for; a folder gets "state-00060.csv".
std::string exportName(const std::string& target, int frame, bool several);

// Positions, velocities (m, m/s), normals, group, molecule and vertex number, all groups in turn.
// Error: cannot be written; nothing half-written stays.
void exportState(const std::string& file, Simulation& simulation, const Scene& scene);

}  // namespace shoal::app
