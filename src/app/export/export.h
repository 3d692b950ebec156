// State written out for other programs: CSV (a row a vertex), PLY (with triangles), VTP (with cells of
// choice) with a PVD index in time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/line/options.h"
#include "core/file.h"
#include "scene/scene.h"
#include "simulate/simulation.h"

namespace shoal::app {

// Calls visit(group, state, molecule) for all that live, all groups in turn.
template <typename Visit>
void forMolecules(Simulation& simulation, const Visit& visit) {
    for (size_t g = 0; g < simulation.plan().groups.size(); ++g) {
        const Snapshot state = simulation.snapshot(g);
        for (size_t m = 0; m < size_t(state.count); ++m)
            if (state.alive.empty() || state.alive[m]) visit(g, state, m);
    }
}

// ---- VTP
// State as VTK's PolyData in XML (.vtp), and the index (.pvd) by which ParaView reads a run's files as one
// thing in time.
//
// All groups in turn, what does not live left out. Points: m, in single precision or, where some are far from
// the origin, in double. Of each point velocity (m/s), normal, group, molecule and vertex number; of the
// whole the time (s), as VTK names it. Cells: triangles (polys), springs (lines) or vertices (verts). Data
// are appended raw, in this machine's byte order.

// m: from so far off the origin on, positions are written to all the digits of a double.
constexpr double farOff = 64;

// Error: cannot be written; nothing half-written stays.
void writeVtp(const std::string& file, Simulation& simulation, const Scene& scene, ExportCells cells);

// An index that is whole after every entry, so that an interrupted run leaves a readable one.
class PvdIndex {
  public:
    // `until`: entries of an index that is there already stay where their time is below, for a run that goes
    // on.
    PvdIndex(std::string file, double until);
    // The file is written anew with one line more. Error: cannot be written.
    void add(double time, const std::string& dataFile);

  private:
    std::string file_, lines_;
};

// ---- Every format

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
