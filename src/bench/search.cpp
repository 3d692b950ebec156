#include "bench/collide.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "reference/sphere_contact.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using glm::dvec3;
using Pairs = std::vector<std::pair<int, int>>;

constexpr double radius = 0.02;     // m
constexpr double stillTime = 1e-5;  // s: nothing moves far
constexpr ContactSearch searches[] = {ContactSearch::exact, ContactSearch::single, ContactSearch::staggered};

Scene sceneOf(ContactSearch search, int count, double perCell, const Molecule& point) {
    Scene scene;
    scene.name = "spheres";
    scene.frameRate = 1 / stillTime;
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 1;
    scene.contact.steps = 1;
    scene.contact.search = search;
    Group group;
    group.name = "spheres";
    group.molecule = point;
    group.count = count;
    group.contact.emplace().radius = radius;
    group.place.items.resize(1);
    scene.groups.push_back(group);
    scene.groups[0].count = 1;
    const double cell = compile(scene).contact.cell;
    scene.groups[0].count = count;
    scene.groups[0].place.items.clear();
    const double half = cell * std::cbrt(count / perCell) / 2;
    scene.groups[0].place.box = {dvec3(-half), dvec3(half)};
    return scene;
}

std::vector<reference::Sphere> spheresOf(const GroupState& state) {
    std::vector<reference::Sphere> out;
    for (size_t i = 0; i < state.anchors.size(); ++i)
        out.push_back({dvec3(state.anchors[i]) + dvec3(state.positions[i]), dvec3(0), radius, 1, int(i)});
    return out;
}

size_t common(const Pairs& a, const Pairs& b) {
    Pairs out;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    return out.size();
}

std::unique_ptr<Simulation> simulationOf(const Scene& scene, const BenchDevice& device) {
    // No watchdog: what overlaps is pushed apart in no time.
    const SimulationOptions options{
        .drawn = false, .timing = gpu::PassTimers::Mode::finish, .path = Path::fused, .watchdog = false};
    return std::make_unique<Simulation>(*device.context, compile(scene), options);
}

struct SearchRun {
    SearchShare share;
    std::unique_ptr<Simulation> simulation;
    std::vector<double> seconds;

    void visit() {
        simulation->restart();
        simulation->frame();
        const gpu::PassTimers& timers = simulation->timers();
        seconds.push_back(lastOf(timers, "contact grid") + lastOf(timers, "contact search"));
    }
};

std::vector<SearchRun> runsOf(double perCell, int count, const Molecule& point, const BenchDevice& device) {
    std::vector<SearchRun> out;
    Pairs expected;
    for (const ContactSearch search : searches) {
        SearchRun run;
        run.simulation = simulationOf(sceneOf(search, count, perCell, point), device);
        if (out.empty()) expected = reference::touching(spheresOf(run.simulation->plan().groups[0].start));
        run.share.search = search;
        run.share.perCell = perCell;
        run.share.contacts = expected.size();
        run.visit();
        run.seconds.clear();
        run.share.found = common(expected, run.simulation->contact()->found());
        out.push_back(std::move(run));
    }
    return out;
}

std::vector<SearchShare> measureShares(int count, const Molecule& point, const BenchDevice& device,
                                       const measure::Schedule& schedule, const BenchProgress& progress) {
    std::vector<SearchShare> out;
    const std::vector<double> densities = {0.05, 0.2, 1, 4};
    for (size_t d = 0; d < densities.size(); ++d) {
        progress(double(d) / double(densities.size()));
        std::vector<SearchRun> runs = runsOf(densities[d], count, point, device);
        measure::pinRasteriserThreads();
        const int rounds = std::max(schedule.leastSamples, int(schedule.seconds * 20));
        for (int i = 0; i < std::min(rounds, schedule.mostSamples); ++i)
            for (SearchRun& run : runs)
                run.visit();
        for (SearchRun& run : runs) {
            run.share.time = measure::spreadOf(std::move(run.seconds));
            out.push_back(run.share);
        }
    }
    return out;
}

// Spheres in flight: positions at time 0 and velocities whose differences have a mean length of 1 m/s.
struct Flight {
    GroupState start;
    std::vector<dvec3> positions, velocities;
    Pairs meet;  // those that touch in (0, window], and did not at 0
};

constexpr double window = 8 * radius;  // s: 8 radii of way

Flight flightOf(const GroupState& start) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    Flight out;
    out.start = start;
    for (const reference::Sphere& sphere : spheresOf(start)) {
        out.positions.push_back(sphere.position);
        const dvec3 direction(normal(random), normal(random), normal(random));
        out.velocities.push_back(glm::normalize(direction) * 0.75);  // the mean difference is 4/3 of it
    }
    for (size_t a = 0; a < out.positions.size(); ++a) {
        for (size_t b = a + 1; b < out.positions.size(); ++b) {
            const dvec3 d = out.positions[a] - out.positions[b], u = out.velocities[a] - out.velocities[b];
            const double reach = 4 * radius * radius;
            if (glm::dot(d, d) < reach) continue;
            const double nearest = std::clamp(-glm::dot(d, u) / std::max(glm::dot(u, u), 1e-30), 0.0, window);
            const dvec3 then = d + u * nearest;
            if (glm::dot(then, then) < reach) out.meet.emplace_back(int(a), int(b));
        }
    }
    return out;
}

StepShare lookEvery(double step, ContactSearch search, const Flight& flight, Simulation& simulation) {
    Pairs all;
    const int looks = int(std::lround(window / (step * radius)));
    for (int i = 1; i <= looks; ++i) {
        SavedState saved;
        saved.groups = {flight.start};
        for (size_t s = 0; s < flight.positions.size(); ++s)
            saved.groups[0].positions[s] += glm::vec3(flight.velocities[s] * (i * step * radius));
        simulation.load(saved);
        simulation.frame();
        const Pairs found = simulation.contact()->found();
        all.insert(all.end(), found.begin(), found.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return {search, step, flight.meet.size(), common(flight.meet, all)};
}

}  // namespace

SearchReport measureSearches(const Molecule& point, bool quick, const BenchDevice& device,
                             const measure::Schedule& schedule, const BenchProgress& progress) {
    SearchReport out;
    if (!device.context->info().computeShaders) return out;
    out.spheres = quick ? 2048 : 16384;
    out.movingSpheres = quick ? 1024 : 4096;
    out.movingPerCell = 0.2;
    out.shares =
        measureShares(out.spheres, point, device, schedule, [&](double share) { progress(share * 0.7); });
    for (const ContactSearch search : searches) {
        progress(0.7 + 0.1 * double(out.steps.size()) / 5);
        const auto simulation =
            simulationOf(sceneOf(search, out.movingSpheres, out.movingPerCell, point), device);
        const Flight flight = flightOf(simulation->plan().groups[0].start);
        for (const double step : {0.1, 0.5, 1.0, 2.0, 4.0})
            out.steps.push_back(lookEvery(step, search, flight, *simulation));
    }
    return out;
}

}  // namespace shoal::bench
