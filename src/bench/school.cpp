#include "bench/bench.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

class SchoolEntrant {
  public:
    SchoolEntrant(const SchoolCase& one, const Molecule& fry, const BenchDevice& device)
        : one_(one),
          simulation_(*device.context, device.shaderRoot, compile(schoolScene(one, fry)),
                      {.drawn = false, .path = one.path, .cache = device.cache}),
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
    SchoolTimes finish() const { return {one_, measure::spreadOf(samples_), measure::spreadOf(device_)}; }

    double seconds = 0;  // of a visit

  private:
    static constexpr int frames = 4;
    void run(int count) {
        for (int i = 0; i < count; ++i)
            simulation_.frame();
        simulation_.check();  // waits
    }
    SchoolCase one_;
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

Scene schoolScene(const SchoolCase& one, const Molecule& fry) {
    const double half = std::cbrt(one.count / schoolDensity) / 2;
    Scene scene;
    scene.seed = 1;
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 5;
    Group& group = scene.groups.emplace_back();
    group.name = "fry";
    group.molecule = fry;
    group.count = one.count;
    group.place.kind = Placement::Kind::volume;
    group.place.box = {glm::dvec3(-half), glm::dvec3(half)};
    group.place.turn = Placement::Turn::yaw;
    group.drag = {40, 1};
    if (!one.schools) return scene;
    School& school = group.school.emplace();
    school.radius = 0.4;
    school.separationRadius = 0.15;
    school.cohesion = 0;  // the density stays
    school.home = SchoolHome{group.place.box, {}, 0, 2};
    return scene;
}

std::vector<SchoolTimes> measureSchools(const std::vector<SchoolCase>& cases, const Molecule& fry,
                                        const BenchDevice& device, double seconds) {
    std::vector<std::unique_ptr<SchoolEntrant>> entrants;
    entrants.reserve(cases.size());
    for (const SchoolCase& one : cases)
        entrants.push_back(std::make_unique<SchoolEntrant>(one, fry, device));
    double round = 0;
    for (auto& entrant : entrants)
        entrant->warmUp();
    measure::pinRasteriserThreads();  // all of them run by now
    for (auto& entrant : entrants)
        round += entrant->seconds;
    const int rounds = std::clamp(int(seconds / std::max(round, 1e-6)), 5, 200);
    for (int i = 0; i < rounds; ++i)
        for (auto& entrant : entrants)
            entrant->visit();
    std::vector<SchoolTimes> out;
    out.reserve(cases.size());
    for (auto& entrant : entrants)
        out.push_back(entrant->finish());
    return out;
}

}  // namespace shoal::bench
