// State written out for other programs: CSV (a row a vertex), PLY (with triangles), VTP (with cells of
// choice) with a PVD index in time.
#pragma once

#include <string>

#include <optional>

#include "app/export_vtp.h"
#include "app/options.h"
#include "core/part_file.h"
#include "scene/scene.h"
#include "simulate/simulation.h"

namespace shoal::app {

// Where a frame's state goes: "out.csv", "out.ply" and "out.vtp" become "out-00060.csv" and so on when
// several frames are asked for, and always below "out.pvd"; a folder gets "state-00060.csv". Numbers are as
// long as `last`.
std::string exportName(const std::string& target, int frame, bool several, int last);

// The state of a run, frame by frame, as --export and what belongs to it say.
class Exporter {
  public:
    // `first`, `last`: the first and the last frame of the run. Error: cannot be written, or another run
    // writes there.
    Exporter(const Options& options, int first, int last);
    bool asksFor(int frame) const;
    bool asksForLast() const;  // whichever that is: a run may end early
    // Positions, velocities (m, m/s), normals, group, molecule and vertex number, all groups in turn; returns
    // the file. Error: cannot be written; nothing half-written stays.
    std::string write(Simulation& simulation, const Scene& scene);

  private:
    const Options& options_;
    bool several() const;

    int first_, last_;
    std::optional<SoleWriter> sole_;
    std::optional<PvdIndex> index_;  // once there is something to put in
};

}  // namespace shoal::app
