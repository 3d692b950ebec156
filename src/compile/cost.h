// The costs of a group's fused kernel, counted from its plan: bytes, operations, fetches and shared memory
// exactly or about, registers as an estimate. Pure functions; which of them bounds it follows from the rates
// of a device (bench/rates.h).
//
// Operations are additions and multiplications, also of integers; a root, a division, a sine and an
// exponential count as one, a fused multiply-add as two, comparisons not at all. They are counted by hand
// from shaders/physics for each spring, vertex, field and collider, times how often the solver asks for it.
// So they are about right: within a factor of two of what a compiler makes of it. What a contact that is
// found costs is not counted, nor are forces, births, steering and normals for the picture.
#pragma once

#include <string>
#include <vector>

#include "compile/path.h"
#include "scene/known_colliders.h"

namespace shoal {

// Bytes that a frame of the fused path must read and write of a molecule: its state once each way, its
// record, its constants, and normals where it is drawn. Exact, but for a record, which is written only when
// its anchor moves.
size_t bytesPerMolecule(const GroupPlan& group, bool drawn);

// One evaluation takes:
constexpr double springOperations = 35;  // with damping
constexpr double motionOperations = 12;  // of a vertex: drag and gravity 6, moving 6

ReadingCost costOf(const FieldShape& shape);

struct KernelCost {
    std::string group;
    int molecules = 0;
    Lanes lanes = Lanes::automatic;  // automatic: in fragments
    int draws = 1;                   // in fragments: each does the whole step again
    // A molecule and frame take:
    double bytes = 0;
    double operations = 0;
    double stateFetches = 0;  // 4-vectors of the state, records and constants
    double tableFetches = 0;  // of fields and colliders (ReadingCost), which caches mostly hold
    int sharedBytes = 0;      // of a workgroup
    // Estimates, for a GPU: 32-bit registers that a lane wants (positions, velocities and what the solver
    // keeps of its vertices, and 24 beside them), and how many of 2,048 lanes 65,536 registers and 100 KiB of
    // shared memory then hold, the numbers of a multiprocessor of NVIDIA since 2020. Beyond 255 registers a
    // lane spills.
    int registers = 0;
    double occupancy = 1;
    bool spills() const { return registers > 255; }
};

// One for each group. `scene`: what the plan was compiled from. `choice`: fused or in fragments (a contract).
std::vector<KernelCost> kernelCosts(const Scene& scene, const Plan& plan, const PathChoice& choice,
                                    const PathLimits& limits);

}  // namespace shoal
