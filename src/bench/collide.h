// The measurements of `shoal bench collide`: contact, and searches.
//
// Contact of molecules with one another is measured against the baseline on the CPU
// (bench/contact_baseline.h).
//
// Quads at random in a cube, so many cubic metres each whatever their number, with contact; in each size a
// step of contact, pass by pass, the fused step before it, and the baseline's step. All sizes take turns,
// round after round. A sample: the start state (not timed), one fused step, one contact step; the baseline
// begins with the state that this contact step begins with, to the bit.
#pragma once

#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/runner.h"
#include "measure/timing.h"

namespace shoal::bench {

struct ContactCase {
    std::string density;  // "moderate", "dense"
    int quads = 0;
    double room = 0;                        // m^3, of each quad
    static constexpr double radius = 0.02;  // m
};
std::vector<ContactCase> contactCases(bool quick);

struct ContactTimes {
    ContactCase benchCase;
    std::string leftOut;  // why it was not measured; empty: it was
    size_t spheres = 0, contacts = 0;
    uint32_t dropped = 0;         // contacts that did not fit into a list
    size_t baselineContacts = 0;  // differ by what rounding decides
    size_t bytes = 0;             // of contact, on the device
    measure::Spread fused = {};   // s, of the step before: two substeps, without contact
    measure::Spread grid = {}, search = {}, response = {}, contact = {};  // s; contact: all three
    measure::Spread baseline = {};                                        // s
    measure::Spread device = {};  // s, the device's own time of contact; no samples: a processor runs it
    double perQuad() const { return contact.min / benchCase.quads; }  // s, by the shortest
    double ratio() const { return contact.min / baseline.min; }
};

// Error: the driver refuses a shader; both find contacts that differ by more than rounding explains.
std::vector<ContactTimes> measureContact(const std::vector<ContactCase>& cases, const Molecule& quad,
                                         const BenchDevice& device, const measure::Schedule& schedule,
                                         const BenchProgress& progress);

// ---- Searches
// The searches of contact against brute force: what share of the contacts each finds, and at what time.

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
                             const measure::Schedule& schedule, const BenchProgress& progress);

}  // namespace shoal::bench
