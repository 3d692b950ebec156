// Contact of molecules with one another, against the baseline on the CPU (bench/contact_baseline.h).
//
// Quads at random in a cube, so many cubic metres each whatever their number, with contact; in each size a
// step of contact, pass by pass, the fused step before it, and the baseline's step. All sizes take turns,
// round after round. A sample: the start state (not timed), one fused step, one contact step; the baseline
// begins with the state that this contact step begins with, to the bit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/runner.h"
#include "measure/statistics.h"

namespace shoal::bench {

// Reports the share of the work that is done, in [0, 1].
using CollideProgress = std::function<void(double share)>;

struct ContactCase {
    std::string density;  // "moderate", "dense"
    int quads = 0;
    double room = 0;                        // m^3, of each quad
    static constexpr double radius = 0.02;  // m
};
std::vector<ContactCase> contactCases(bool quick);

struct ContactTimes {
    ContactCase one;
    std::string leftOut;  // why it was not measured; empty: it was
    size_t spheres = 0, contacts = 0;
    uint32_t dropped = 0;                             // contacts that did not fit into a list
    size_t baselineContacts = 0;                      // differ by what rounding decides
    size_t bytes = 0;                                 // of contact, on the device
    measure::Spread fused;                            // s, of the step before: two substeps, without contact
    measure::Spread grid, search, response, contact;  // s; contact: all three
    measure::Spread baseline;                         // s
    double perQuad() const { return contact.min / one.quads; }  // s, by the shortest
    double ratio() const { return contact.min / baseline.min; }
};

// Error: the driver refuses a shader; both find contacts that differ by more than rounding explains.
std::vector<ContactTimes> measureContact(const std::vector<ContactCase>& cases, const Molecule& quad,
                                         const BenchDevice& device, const measure::Schedule& schedule,
                                         const CollideProgress& progress);

}  // namespace shoal::bench
