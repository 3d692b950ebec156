// Fields read less often than every substep, with the error that it costs, against the double reference.
#include <algorithm>
#include <cmath>

#include "gl/agreement.h"
#include "scene/field_kinds.h"
#include "support/catch.h"

namespace shoal {

using test::at;
using Sampling = FieldSampling;

namespace {

constexpr int substepsPerSecond = 960;  // so that the solver's own error stays below what is measured
constexpr Sampling everySampling[] = {Sampling::vertexSubstep, Sampling::vertexFrame,
                                      Sampling::moleculeFrame};

// Leaves of 0.2 m to 0.3 m in gusts and eddies that are several times their size.
Scene leavesInGusts() {
    std::vector<test::Item> items;
    for (int i = 0; i < 24; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 0.1 * i - 3, 2 - 0.05 * i));
        items.push_back(at({i % 4 * 2.5 - 5, i / 4 % 4 * 2.5, i / 16 * 2.5 - 4},
                           glm::angleAxis(0.37 * i, axis), 0.2 + 0.004 * i));
    }
    Scene scene = test::sceneOf(test::leaf(150, 1), SolverKind::leapfrog, items);
    scene.gravity = {0, -9.81, 0};
    scene.groups[0].drag = {4, 1};
    GustField gust;
    gust.direction = {2, 0.2, -1};
    gust.seed = 4;
    CurlNoiseField noise;
    noise.seed = 8;
    gust.noise = noise.noise = NoiseForm::computed;  // a GPU's filter of tables would be most of the error
    scene.fields = {test::field(gust), test::field(noise)};
    return scene;
}

Simulation simulationOf(Scene scene, Sampling sampling, int framesPerSecond) {
    scene.solver.fieldSampling = sampling;
    test::setSteps(scene, 1.0 / framesPerSecond, substepsPerSecond / framesPerSecond);
    return Simulation(testContext(), compile(scene), {.path = Path::fused});
}

std::vector<reference::State> afterASecond(const Scene& scene, Sampling sampling, int framesPerSecond) {
    Simulation simulation = simulationOf(scene, sampling, framesPerSecond);
    test::run(simulation, framesPerSecond);
    const Snapshot end = simulation.snapshot(0);
    std::vector<reference::State> out;
    for (int m = 0; m < end.count; ++m)
        out.push_back(test::stateOf(end, m));
    return out;
}

// RMS over the molecules, of their size.
double apart(const Scene& scene, const std::vector<reference::State>& a,
             const std::vector<reference::State>& b) {
    double sum = 0;
    for (size_t m = 0; m < a.size(); ++m) {
        const double size = scene.groups[0].molecule.size() * scene.groups[0].place.items[m].scale;
        sum += std::pow(reference::relativeError(a[m], b[m], size), 2) / double(a.size());
    }
    return std::sqrt(sum);
}

}  // namespace

TEST_CASE("what reading fields once a frame costs, and that it falls with the frame's square",
          "[fused][sampling]") {
    if (!test::canFuse()) return;
    const Scene scene = leavesInGusts();
    std::vector<reference::State> exact;
    const Snapshot start = simulationOf(scene, Sampling::vertexSubstep, 10).snapshot(0);
    for (int m = 0; m < start.count; ++m) {
        const auto solution = reference::solve(test::problemOf(scene, m), test::stateOf(start, m), 1, 1e-6);
        REQUIRE(solution.converged);
        exact.push_back(solution.state);
    }
    double error[3][3];  // by sampling, then at 10, 20 and 40 frames a second
    double toLimit[3];   // moleculeFrame against itself with very short frames
    const auto limit = afterASecond(scene, Sampling::moleculeFrame, 320);
    for (int frames = 0; frames < 3; ++frames) {
        for (const Sampling sampling : everySampling) {
            const auto end = afterASecond(scene, sampling, 10 << frames);
            error[int(sampling)][frames] = apart(scene, end, exact);
            if (sampling == Sampling::moleculeFrame) toLimit[frames] = apart(scene, end, limit);
        }
        UNSCOPED_INFO(10 * (1 << frames) << " frames a second: vertexSubstep " << error[0][frames]
                                         << ", vertexFrame " << error[1][frames] << ", moleculeFrame "
                                         << error[2][frames] << ", of it by time " << toLimit[frames]);
    }
    // the solver's own error and float's; a frame's length does not matter to it
    for (const double solver : error[0])
        CHECK(solver < 5e-5);
    // At 10 frames a second a leaf flies past a tenth of an eddy in a frame: percents of its size after 1 s,
    // a hundred times the solver's error, so that the slopes mean something. Those of the coarsest are the
    // least straight.
    CHECK((error[1][0] > 0.01 && error[1][0] < 0.1));
    CHECK((toLimit[0] > 0.005 && toLimit[0] < 0.1));
    for (int finer = 1; finer < 3; ++finer) {
        CHECK(std::log2(error[1][finer - 1] / error[1][finer]) == Approx(2).margin(finer == 1 ? 0.35 : 0.15));
        CHECK(std::log2(toLimit[finer - 1] / toLimit[finer]) == Approx(2).margin(finer == 1 ? 0.35 : 0.15));
    }
    // Read at one point, a field does not turn the leaf: it ends about its own size away, however short
    // frames are.
    for (const double molecule : error[2])
        CHECK((molecule > 0.1 && molecule < 3));
}

TEST_CASE("a uniform wind is the same however often it is read", "[fused][sampling]") {
    if (!test::canFuse()) return;
    for (const SolverKind solver : test::bothSolvers) {
        Scene scene = leavesInGusts();
        scene.solver.kind = solver;
        scene.fields = {test::field(UniformField{{3, 0.5, -1}})};
        std::vector<reference::State> ends[3];
        for (const Sampling sampling : everySampling)
            ends[int(sampling)] = afterASecond(scene, sampling, 60);
        UNSCOPED_INFO(name(solver) << ": " << apart(scene, ends[0], ends[1]) << " and "
                                   << apart(scene, ends[0], ends[2]));
        CHECK(apart(scene, ends[0], ends[1]) < 1e-6);
        CHECK(apart(scene, ends[0], ends[2]) < 1e-6);
    }
}

// With one substep a frame, at whose end an implicit solver takes the field.
TEST_CASE("a solver with history reads the field once a frame where its substeps would",
          "[fused][sampling]") {
    if (!test::canFuse()) return;
    Scene scene = test::sceneOf(test::leaf(150, 1), SolverKind::bdf2Xpbd);
    scene.groups[0].drag = {1, 1};
    scene.fields = {test::field(OscillatingField{{3, 0.5, -1}, 2, 0.5})};
    glm::dvec3 ends[2];
    for (const Sampling sampling : {Sampling::vertexSubstep, Sampling::vertexFrame}) {
        Simulation simulation = simulationOf(scene, sampling, substepsPerSecond);
        test::run(simulation, 100);
        ends[int(sampling)] = simulation.snapshot(0).positions[0];
    }
    CHECK(glm::distance(ends[0], ends[1]) < 1e-6);
}

}  // namespace shoal
