// UberFlow's five experiments [Kipfer 2004, section 5, table 2] on
// squares of particles, all of which are drawn:
//
//   E1   motion through a vector field
//   E2   and collisions with a height field
//   E3   E1 and a full sort by depth
//   E4   E1 and collisions of particles with one another: eight neighbours to either side in the order of
//        their cells, in rows that are sorted by themselves; and with the full sort, other searches
//   E5   E3 on the CPU: motion, std::sort, upload
//
// A sample: the start state and unsorted keys (not timed), then the parts of one frame, each between two
// waits; a frame is their sum.
#pragma once

#include "bench/collide.h"

namespace shoal::bench {

struct UberFlowTimes {
    std::string experiment;         // "E1"
    std::string how;                // what differs from the published one
    std::vector<double> published;  // frames a second, for each of uberFlowSides(false); empty: none
    int side = 0;                   // of the square
    std::string leftOut;            // why it was not measured; empty: it was
    measure::Spread motion, contact, sort, draw, frame;  // s; contact: without the sort of the grid
    double framesPerSecond() const { return 1 / frame.min; }
    // Without the picture, which is another than the paper's points of one pixel.
    double undrawnFramesPerSecond() const { return 1 / (motion.min + contact.min + sort.min); }
};

std::vector<int> uberFlowSides(bool quick);

// Cases of one size. `point`: a molecule of one vertex. Error: the driver refuses a shader.
std::vector<UberFlowTimes> measureUberFlow(int side, const Molecule& point, const BenchDevice& device,
                                           const measure::Schedule& schedule,
                                           const CollideProgress& progress);

}  // namespace shoal::bench
