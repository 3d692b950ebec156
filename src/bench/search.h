// The searches of contact against brute force: what share of the contacts each finds, and at what time.
#pragma once

#include "bench/collide.h"

namespace shoal::bench {

struct SearchShare {
    ContactSearch search = ContactSearch::exact;
    double perCell = 0;    // spheres
    size_t contacts = 0;   // by brute force
    size_t found = 0;      // of those
    measure::Spread time;  // s, of grid and search
    double share() const { return contacts > 0 ? double(found) / double(contacts) : 1; }
    double perContact() const { return found > 0 ? time.min / double(found) : 0; }  // s
};

// Spheres that fly in straight lines, looked at after every step: of the pairs that touch at any time, the
// share that one of the looks finds.
struct StepShare {
    ContactSearch search = ContactSearch::exact;
    double step = 0;  // way of one sphere relative to another in a step, in radii, in the mean
    size_t contacts = 0, found = 0;
    double share() const { return contacts > 0 ? double(found) / double(contacts) : 1; }
};

struct SearchReport {
    int spheres = 0, movingSpheres = 0;
    double movingPerCell = 0;
    std::vector<SearchShare> shares;
    std::vector<StepShare> steps;
};

SearchReport measureSearches(const Molecule& point, bool quick, const BenchDevice& device,
                             const measure::Schedule& schedule, const CollideProgress& progress);

}  // namespace shoal::bench
