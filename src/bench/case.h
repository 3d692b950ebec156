// The cases that `shoal bench` measures: plain data.
//
// One workload: molecules fall from random places in a box through uniform wind {2, 0, 0.5} m/s with gravity
// and drag of 1/s, onto a ground plane; `euler`, 1/60 s a frame in 4 substeps. A case says what differs.
#pragma once

#include <string>
#include <vector>

#include "bench/baseline.h"
#include "compile/path.h"
#include "scene/scene.h"

namespace shoal::bench {

enum class Subject {
    fused,
    fragments,
    pingPong,
    avx512,  // baselines: bench/baseline.h
    avx2,
    scalar,
    bufferCopy,   // the state, by the device's own command
    kernelCopy,   // the state, by a compute kernel that does nothing else
    memoryCopy,   // the baseline's state, by memcpy on all cores
    multiplyAdd,  // a compute kernel of arithmetic alone
};
const char* name(Subject subject);   // "fused", "fragments", "ping-pong", "AVX-512", …
bool isPath(Subject subject);        // fused, fragments or ping-pong
Path pathOf(Subject subject);        // of those
bool isBaseline(Subject subject);    // AVX-512, AVX2 or scalar
bool isCopy(Subject subject);        // moves the state and does nothing else
Simd simdOf(Subject subject);        // of a baseline
bool isOnDevice(Subject subject);    // else the processor itself does the work
bool needsCompute(Subject subject);  // OpenGL 4.3

enum class Wind {
    uniform,
    gusts,  // a gust and curl noise: fields that cost something
};
const char* name(Wind wind);  // "uniform", "gusts"

struct BenchCase {
    std::string group;     // cases that are measured in turn, such as "16,384 quads"
    std::string label;     // within the group: "fused, in place"
    std::string molecule;  // "quad", "cross", "fish", "cloth"
    int count = 0;
    Subject subject = Subject::fused;
    SolverKind solver = SolverKind::euler;
    int substeps = 4;
    Wind wind = Wind::uniform;
    FieldSampling sampling = FieldSampling::vertexSubstep;
    Lanes lanes = Lanes::automatic;
    bool inPlace = false;
    bool drawn = false;  // normals and a picture every frame

    std::string name() const { return group + ": " + label; }
};

// "1,048,576".
std::string grouped(int count);

// All of them, group by group. `quick`: the small groups only, and no pictures of many.
std::vector<BenchCase> benchCases(bool quick);

// The molecules of the cases: those shipped, and an 8 x 8 cloth.
struct BenchMolecules {
    Molecule quad, cross, fish, cloth;

    explicit BenchMolecules(const std::string& folder);  // Error: a file is missing
    const Molecule& named(const std::string& name) const;
};
Molecule cloth(int side);

Scene benchScene(const BenchCase& benchCase, const Molecule& molecule);
// Returns the step of the baseline in a scene of benchScene().
BaselineStep baselineStep(const Scene& scene);

}  // namespace shoal::bench
