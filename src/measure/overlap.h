// How deep spheres of contact between molecules lie in one another.
#pragma once

#include <utility>

#include "simulate/simulation.h"

namespace shoal::measure {

struct Overlap {
    // Depths over the radius of the smaller sphere, of the contacts that the last step found; those that have
    // parted since count as 0.
    double largest = 0, rms = 0;
    size_t contacts = 0;
    size_t group = 0;  // of the sphere with the smaller number in the deepest, in the plan
    int molecule = 0;
};

// Reads the lists of contacts, and all states of groups with contact. The simulation has contact, and has
// made a frame.
Overlap overlapOf(const Simulation& simulation);

}  // namespace shoal::measure
