// State as VTK's PolyData in XML (.vtp), and the index (.pvd) by which ParaView reads a run's files as one
// thing in time.
//
// All groups in turn, what does not live left out. Points: m, in single precision or, where some are far from
// the origin, in double. Of each point velocity (m/s), normal, group,
// molecule and vertex number; of the whole the time (s), as VTK names it. Cells: triangles (polys), springs
// (lines) or vertices (verts). Data are appended raw, in this machine's byte order.
#pragma once

#include <string>
#include <vector>

#include "app/options.h"
#include "scene/scene.h"
#include "simulate/simulation.h"

namespace shoal::app {

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

}  // namespace shoal::app
