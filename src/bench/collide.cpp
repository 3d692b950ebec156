#include "bench/collide.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "bench/contact_baseline.h"
#include "gpu/gl.h"
#include "scene/field_kinds.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

using measure::Clock, measure::secondsSince;

constexpr double contactTime = 1.0 / 120;  // s: a frame is one contact step of two substeps

Scene sceneOf(const ContactCase& one, const Molecule& quad, bool contact) {
    Scene scene;
    scene.name = concat(one.quads, " quads");
    scene.frameRate = 1 / contactTime;
    scene.gravity = {0, -9.81, 0};
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 2;
    scene.contact.steps = 1;
    scene.fields.emplace_back().shape = UniformField{{2, 0, 0.5}};
    Group group;
    group.name = "quads";
    group.molecule = quad;
    group.count = one.quads;
    group.held = false;
    const double half = std::cbrt(one.room * one.quads) / 2;
    group.place.box = {glm::dvec3(-half), glm::dvec3(half)};
    group.place.turn = Placement::Turn::any;
    group.drag = {1, 1};
    if (contact) group.contact.emplace().radius = ContactCase::radius;
    scene.groups.push_back(group);
    return scene;
}

// Quads fly about as leaves do in gusts.
Plan planOf(const ContactCase& one, const Molecule& quad, bool contact) {
    Plan plan = compile(sceneOf(one, quad, contact));
    std::mt19937 random(3);
    std::uniform_real_distribution<float> speed(-1, 1);
    GroupState& start = plan.groups[0].start;
    const size_t vertices = quad.vertices.size();
    for (size_t m = 0; m < start.anchors.size(); ++m) {
        const glm::vec3 velocity(speed(random), speed(random), speed(random));
        std::fill_n(start.velocities.begin() + ptrdiff_t(m * vertices), vertices, velocity);
    }
    return plan;
}

// The last value of a pass, s.
double lastOf(const gpu::PassTimers& timers, const char* name) {
    for (const gpu::PassTime& pass : timers.report())
        if (pass.name == name) return pass.last;
    return 0;
}

class Entrant {
  public:
    Entrant(const ContactCase& one, const Molecule& quad, const BenchDevice& device)
        : contact_(*device.context, device.shaderRoot, planOf(one, quad, true), options(device)),
          plain_(*device.context, device.shaderRoot, planOf(one, quad, false), options(device)),
          baseline_(weightsOf(quad), one.quads, float(ContactCase::radius), device.cores) {
        result.one = one;
        const Plan& plan = contact_.plan();
        result.spheres = size_t(plan.contact.spheres);
        result.bytes = contact_.contact()->bytes();
        step_.stepTime = float(contactTime);
        step_.restSpeed = float(2 * glm::length(plan.gravity) * contactTime);
        step_.restitution = plan.contact.pairs[0].x;
        step_.friction = plan.contact.pairs[0].y;
        step_.iterations = plan.contact.settings.iterations;
        plain_.frame();
        start_ = plain_.save().groups[0];
    }

    // Not counted: compiles, touches memory, and compares what both find; then what a visit costs.
    void warmUp() {
        visit();
        result.dropped = contact_.contact()->dropped();
        const auto found = contact_.contact()->found(), expected = baseline_.found();
        result.contacts = found.size();
        result.baselineContacts = expected.size();
        std::vector<std::pair<int, int>> differ;
        std::set_symmetric_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                                      std::back_inserter(differ));
        if (differ.size() > 2 + found.size() / 100)
            throw Error(concat("bench collide: of ", found.size(), " contacts of ", result.one.quads,
                               " quads the baseline finds ", differ.size(), " otherwise"));
        const Clock::time_point start = Clock::now();
        visit();
        seconds = secondsSince(start);
        for (std::vector<double>* samples : {&fused_, &grid_, &search_, &response_, &all_, &cpu_})
            samples->clear();
    }

    void visit() {
        plain_.restart();
        plain_.frame();
        fused_.push_back(lastOf(plain_.timers(), "fused"));
        contact_.restart();
        contact_.frame();
        const gpu::PassTimers& timers = contact_.timers();
        grid_.push_back(lastOf(timers, "contact grid"));
        search_.push_back(lastOf(timers, "contact search"));
        response_.push_back(lastOf(timers, "contact response"));
        all_.push_back(grid_.back() + search_.back() + response_.back());
        baseline_.set(start_);
        const Clock::time_point start = Clock::now();
        baseline_.step(step_);
        cpu_.push_back(secondsSince(start));
    }

    ContactTimes finish() {
        result.fused = measure::spreadOf(fused_);
        result.grid = measure::spreadOf(grid_);
        result.search = measure::spreadOf(search_);
        result.response = measure::spreadOf(response_);
        result.contact = measure::spreadOf(all_);
        result.baseline = measure::spreadOf(cpu_);
        return result;
    }

    ContactTimes result;
    double seconds = 0;  // of a visit

  private:
    static SimulationOptions options(const BenchDevice& device) {
        SimulationOptions out;
        out.drawn = false;
        out.path = Path::fused;
        out.timing = gpu::PassTimers::Mode::finish;  // one frame at a time is waited for anyway
        out.cache = device.cache;
        return out;
    }
    static std::vector<float> weightsOf(const Molecule& quad) {
        std::vector<float> out;
        for (const Vertex& vertex : quad.vertices)
            out.push_back(float(1 / vertex.mass));
        return out;
    }

    Simulation contact_, plain_;
    ContactBaseline baseline_;
    ContactBaselineStep step_;
    GroupState start_;
    std::vector<double> fused_, grid_, search_, response_, all_, cpu_;  // s
};

}  // namespace

std::vector<ContactCase> contactCases(bool quick) {
    std::vector<ContactCase> out;
    const double moderate = std::pow(1.07 * 0.2 * std::sqrt(2.0), 3), dense = std::pow(0.15, 3);
    for (const int quads : {1024, 4096, 16384, 65536, 131072})
        if (!quick || quads <= 4096) out.push_back({"moderate", quads, moderate});
    for (const int quads : {1024, 4096, 16384, 65536, 131072})
        if (!quick || quads <= 1024) out.push_back({"dense", quads, dense});
    return out;
}

std::vector<ContactTimes> measureContact(const std::vector<ContactCase>& cases, const Molecule& quad,
                                         const BenchDevice& device, const measure::Schedule& schedule,
                                         const CollideProgress& progress) {
    std::vector<ContactTimes> out;
    std::vector<std::unique_ptr<Entrant>> entrants;
    std::vector<size_t> places;  // of the entrants in `out`
    std::vector<double> cost;
    for (const ContactCase& one : cases) {
        out.emplace_back().one = one;
        if (!device.context->info().computeShaders) {
            out.back().leftOut = "needs OpenGL 4.3";
            continue;
        }
        try {
            entrants.push_back(std::make_unique<Entrant>(one, quad, device));
        } catch (const gpu::OutOfMemory& error) {
            out.back().leftOut = error.message();
            continue;
        }
        measure::pinRasteriserThreads();
        entrants.back()->warmUp();
        places.push_back(out.size() - 1);
        cost.push_back(entrants.back()->seconds);
    }
    const measure::VisitPlan plan = measure::planVisits(cost, schedule);
    measure::takeTurns(
        plan, [&](int round) { progress(double(round) / plan.rounds); },
        [&](size_t i) { entrants[i]->visit(); });
    for (size_t i = 0; i < entrants.size(); ++i)
        out[places[i]] = entrants[i]->finish();
    device.context->checkErrors("bench collide");
    return out;
}

}  // namespace shoal::bench
