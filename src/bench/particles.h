// Point particles: what `shoal bench particles` measures.
//
// The settings of [Latta 2004] and [Kipfer 2004] on squares of particles: they fall with drag through a
// uniform wind, one substep of 1/60 s a frame, from half a second after their start; alone, over a height
// field, sorted, with contact, being born and dying, drawn. Beside them the loop that one would write for the
// CPU, with an upload of its positions every frame (bench/particle_baseline.h), and a copy of the state.
//
// All cases of a group take turns, round after round. A sample: to the start (but where they are born and
// die: that goes on), a frame that is not timed, then some between two waits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "bench/runner.h"
#include "measure/timing.h"
#include "scene/emitter.h"
#include "scene/particle.h"
#include "sort/sorter.h"

namespace shoal::bench {

struct ParticleCase {
    enum class What { step, cpuLoop, copy };

    std::string group, label;  // "height field, 1024 x 1024", "fused"
    int side = 512;            // of the square of vertices
    What what = What::step;
    Path path = Path::automatic;
    bool quads = false;  // as many vertices as quads: what a point is compared with
    bool heights = false, contact = false, inPlace = false;
    SolverKind solver = SolverKind::leapfrog;
    double frameRate = 60;  // 1/s
    int substeps = 1;
    std::optional<SortMethod> sort = {};  // of as many pairs, after the step
    int spreadFrames = 0;                 // above 0: the sort takes so many frames
    std::optional<Allocator> allocator = {};
    double turnover = 0;                      // share of the living that is born, and dies, in a frame
    std::optional<ParticleShape> drawn = {};  // into a small picture
    double published = 0;                     // frames a second, of UberFlow's table 2; 0: none

    int count() const { return side * side; }
    std::string name() const { return group + ": " + label; }
};

// Group by group. `quick`: one small square.
std::vector<ParticleCase> particleCases(bool quick);
Scene particleScene(const ParticleCase& particleCase, const Molecule& point, const Molecule& quad);

struct ParticleTimes {
    ParticleCase benchCase;
    std::string leftOut;               // why it was not measured; empty: it was
    measure::Spread frame = {};        // s, wall time
    measure::Spread device = {};       // s, as BenchResult's
    size_t movedBytes = 0;             // read and written in a frame, at the least; 0: not known
    double busBytes = 0;               // of state and places, a frame
    std::optional<double> error = {};  // m: see positionError
    // Where they are born:
    double born = 0, lost = 0;     // a frame
    double live = 0, packing = 1;  // packing: one past the last place that is taken, over the living

    double perParticle() const { return frame.min / benchCase.count(); }  // s
};

// Returns the error after 1 s against the closed form of constant force and drag, RMS over 4,096 particles;
// nothing for a case in which anything else acts.
std::optional<double> positionError(const ParticleCase& particleCase, const Molecule& point,
                                    const BenchDevice& device);

// Cases of one group. Error: the driver refuses a shader.
std::vector<ParticleTimes> measureParticles(const std::vector<ParticleCase>& cases, const Molecule& point,
                                            const Molecule& quad, const BenchDevice& device,
                                            const measure::Schedule& schedule);

}  // namespace shoal::bench
