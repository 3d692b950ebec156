// A run's state in a file, exact to the bit: what `shoal run --save` writes and `--resume` goes on from.
//
//   head   8 bytes of magic; u32 byte order; u32 version; u64 bytes of what follows up to the checksum
//          f64 time, s; f64 last substep, s; u64 fingerprint of what acts on molecules; i32 frames;
//          u64 spheres, contacts and texels of colliders in what contacts remember; u32 groups;
//          the parameters as they stood; the parameters as the scene had them;
//          a group: name, molecules, vertices, springs, two fingerprints, whether it has a history, steers;
//          u64 checksum of the head
//   body   a group: positions, velocities (3 f32 a vertex), anchors (3 f32 a molecule), released (u8)
//          with a history: displacements, changes of velocity of the last substep (3 f32 a vertex)
//          with life: age and length of life (2 f32), seeds (u32), scale and phase (2 f32) a place;
//          emitters' clocks (f64, u64); born, lost (u64)
//          with an allocator on the CPU: when each place is free (f64); stack: its free places (u32)
//          of a school: what steers (12 f32 a molecule)
//          and what contacts remember (simulate/contact/memory.h): counts (u32 a sphere); partners (u32),
//          pushes, anchors (4 f32) of all contacts; known, loads (4 f32 a sphere); colliders
//          u64 checksum of the body
//
// Numbers are in the byte order of the machine that wrote them. The head is checked before anything of the
// body is read, and the plan says how large the body is: a file that claims a huge size takes no memory.
//
// The scene that goes on must have the same number, names and order of groups; in each group the same number
// of molecules, vertices, springs between the same vertices with the same rest lengths, and every instance's
// seed, scale and phase. All else may change between the two runs, to look closer at one: solver,
// substeps, frame rate, fields, colliders, gravity, stiffness, damping, masses, pins, drag, triangles and
// looks.
#pragma once

#include <cstdint>
#include <filesystem>

#include "compile/plan.h"
#include "simulate/simulation.h"

namespace shoal {

constexpr uint32_t checkpointVersion = 5;

struct Checkpoint {
    SavedState state;
    // Sliders stay where they had been moved to, unless the scene says otherwise than it did then.
    Parameters parameters;
};

// Error: cannot be written; the old file is kept and nothing half-written stays.
void writeCheckpoint(const std::filesystem::path& file, const Plan& plan, const Checkpoint& saved);

// Error, located at the file: it cannot be read; is no checkpoint, or one of another version or byte order;
// is cut short or damaged; is of another scene, and how that differs; holds numbers that are not finite.
Checkpoint readCheckpoint(const std::filesystem::path& file, const Plan& plan);

}  // namespace shoal
