#include "bench/bench.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using measure::Clock, measure::secondsSince;

class Entrant {
  public:
    Entrant(const SchoolCase& one, const Molecule& fry, const BenchDevice& device)
        : simulation_(*device.context, device.shaderRoot, compile(schoolScene(one, fry)), options(device)) {
        result.one = one;
    }

    // Half a second, by which they are in motion; then what a visit costs.
    void warmUp() {
        for (int i = 0; i < 30; ++i)
            simulation_.frame();
        simulation_.check();
        visit();
        seconds = samples_.back() * frames;
        samples_.clear();
    }
    void visit() {
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < frames; ++i)
            simulation_.frame();
        simulation_.check();  // waits
        samples_.push_back(secondsSince(start) / frames);
    }
    SchoolTimes finish() {
        result.frame = measure::spreadOf(samples_);
        return result;
    }

    double seconds = 0;  // of a visit

  private:
    static constexpr int frames = 4;
    static SimulationOptions options(const BenchDevice& device) {
        SimulationOptions out;
        out.path = Path::fused;
        out.drawn = false;
        out.cache = device.cache;
        return out;
    }
    Simulation simulation_;
    SchoolTimes result;
    std::vector<double> samples_;
};

}  // namespace

std::vector<SchoolCase> schoolCases(bool quick) {
    if (quick) return {{1000, true}, {1000, false}};
    return {{1000, true}, {3000, true}, {10000, true}, {10000, false}, {30000, true}, {100000, true}};
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
    std::vector<std::unique_ptr<Entrant>> entrants;
    for (const SchoolCase& one : cases)
        entrants.push_back(std::make_unique<Entrant>(one, fry, device));
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
    for (auto& entrant : entrants)
        out.push_back(entrant->finish());
    return out;
}

}  // namespace shoal::bench
