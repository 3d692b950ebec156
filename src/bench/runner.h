// Runs a case of the benchmark, one frame at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bench/case.h"
#include "compile/plan.h"
#include "gpu/context.h"
#include "gpu/pass_timers.h"
#include "simulate/state_view.h"

namespace shoal::bench {

// Draws a picture of a state. Made for a scene and its plan by who knows how to draw; this room does not.
using Draw = std::function<void(const StateView&)>;
using DrawMaker = std::function<Draw(const Scene&, const Plan&)>;

struct BenchDevice {
    gpu::Context* context = nullptr;
    DrawMaker makeDraw = {};  // null: cases with a picture are left out
    int cores = 1;            // threads of the baselines
    bool goesOn = false;      // what the driver refuses is the failure of a case, not the end
    bool ownTimes = false;    // the device's own times are asked for as well; not of a CPU rasteriser
};

// Where all cases of one molecule and count begin: some way into the fall, so that there are contacts.
struct BenchStart {
    static constexpr int framesBefore = 20;

    std::vector<glm::vec3> positions, velocities;  // world coordinates, m and m/s; molecule by molecule
    GroupState packed;                             // the same

    BenchStart(const BenchCase& benchCase, const Molecule& molecule, int cores);
};

class BenchRunner {
  public:
    virtual ~BenchRunner() = default;
    virtual void restart() {}  // to the start
    virtual void frame() = 0;
    virtual void finish() {}  // waits until the frames are done
    void run(int frames) {
        for (int i = 0; i < frames; ++i)
            frame();
        finish();
    }

    size_t stateBytes = 0;           // where the state lives, all copies of it
    size_t movedBytes = 0;           // read and written in a frame, at the least; 0: not known
    double operations = 0;           // additions and multiplications of a frame, about; 0: not known
    Lanes lanes = Lanes::automatic;  // fused: how molecules are spread
};

// About how many a frame of the workload takes, in uniform wind and in the air.
double operationsPerFrame(const BenchCase& benchCase, const Molecule& molecule);

// Why a case cannot be run here; empty when it can.
std::string reasonToLeaveOut(const BenchCase& benchCase, const Molecule& molecule, const BenchDevice& device);

// Borrows all of its arguments. Error: out of memory, the driver refuses a shader.
std::unique_ptr<BenchRunner> makeRunner(const BenchCase& benchCase, const Molecule& molecule,
                                        const BenchStart& start, const BenchDevice& device);

// The last value of a pass, s; 0 without it.
double lastOf(const gpu::PassTimers& timers, const char* pass);

// Bytes that one frame of the fused path reads and writes at the least: each molecule once.
size_t fusedBytesPerFrame(const Plan& plan, bool drawn);

}  // namespace shoal::bench
