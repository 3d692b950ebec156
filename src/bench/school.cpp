#include "bench/bench.h"

#include <cmath>
#include <memory>

#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

class SchoolEntrant {
  public:
    SchoolEntrant(SchoolTimes& times, const Molecule& fry, const BenchDevice& device)
        : times_(times),
          simulation_(*device.context, compile(schoolScene(times.benchCase, fry)),
                      {.drawn = false, .path = times.benchCase.path}),
          ownTimes_(device.ownTimes) {}

    // Half a second, by which they are in motion; then what a visit costs.
    void warmUp() {
        run(30);
        visit();
        seconds = samples_.back() * frames;
        samples_.clear();
        device_.clear();
    }
    void visit() {
        samples_.push_back(measure::secondsOf([&] { run(frames); }) / frames);
        if (ownTimes_) device_.push_back(timer_.secondsOf([&] { simulation_.frame(); }));
    }
    void finish() {
        times_.frame = measure::spreadOf(samples_);
        times_.device = measure::spreadOf(device_);
    }

    double seconds = 0;  // of a visit

  private:
    static constexpr int frames = 4;
    void run(int count) {
        for (int i = 0; i < count; ++i)
            simulation_.frame();
        simulation_.check();  // waits
    }
    SchoolTimes& times_;
    Simulation simulation_;
    bool ownTimes_;
    gpu::DeviceTimer timer_;
    std::vector<double> samples_, device_;
};

}  // namespace

std::vector<SchoolCase> schoolCases(bool quick, bool software) {
    constexpr Path fragments = Path::fragments;
    if (quick) return {{1000, true}, {1000, true, fragments}, {1000, false}};
    std::vector<SchoolCase> out = {{1000, true},   {3000, true},  {10000, true}, {10000, true, fragments},
                                   {10000, false}, {30000, true}, {100000, true}};
    if (!software) out.insert(out.end(), {{1000000, true}, {1000000, false}});
    return out;
}

Scene schoolScene(const SchoolCase& schoolCase, const Molecule& fry) {
    const double half = std::cbrt(schoolCase.count / schoolDensity) / 2;
    Scene scene;
    scene.seed = 1;
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 5;
    Group& group = scene.groups.emplace_back();
    group.name = "fry";
    group.molecule = fry;
    group.count = schoolCase.count;
    group.place.kind = Placement::Kind::volume;
    group.place.box = {glm::dvec3(-half), glm::dvec3(half)};
    group.place.turn = Placement::Turn::yaw;
    group.drag = {40, 1};
    if (!schoolCase.schools) return scene;
    School& school = group.school.emplace();
    school.radius = 0.4;
    school.separationRadius = 0.15;
    school.cohesion = 0;  // the density stays
    school.home = SchoolHome{group.place.box, {}, 0, 2};
    return scene;
}

std::vector<SchoolTimes> measureSchools(const std::vector<SchoolCase>& cases, const Molecule& fry,
                                        const BenchDevice& device, const measure::Schedule& schedule) {
    std::vector<SchoolTimes> out;
    for (const SchoolCase& schoolCase : cases)
        out.push_back({.benchCase = schoolCase});
    measureInTurn(
        out, schedule, [](double) {},
        [&](SchoolTimes& times) { return std::make_unique<SchoolEntrant>(times, fry, device); });
    return out;
}

}  // namespace shoal::bench
