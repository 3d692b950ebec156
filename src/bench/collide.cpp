#include "bench/collide.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <tuple>

#include "bench/contact_baseline.h"
#include "scene/field_kinds.h"
#include "simulate/simulation.h"

namespace shoal::bench {

namespace {

constexpr double contactTime = 1.0 / 120;  // s: a frame is one contact step of two substeps

Scene sceneOf(const ContactCase& contactCase, const Molecule& quad, bool contact) {
    Scene scene;
    scene.name = concat(contactCase.quads, " quads");
    scene.frameRate = 1 / contactTime;
    scene.gravity = {0, -9.81, 0};
    scene.solver.kind = SolverKind::leapfrog;
    scene.solver.substeps = 2;
    scene.contact.steps = 1;
    scene.fields.emplace_back().shape = UniformField{{2, 0, 0.5}};
    Group group;
    group.name = "quads";
    group.molecule = quad;
    group.count = contactCase.quads;
    group.held = false;
    const double half = std::cbrt(contactCase.room * contactCase.quads) / 2;
    group.place.box = {glm::dvec3(-half), glm::dvec3(half)};
    group.place.turn = Placement::Turn::any;
    group.drag = {1, 1};
    if (contact) group.contact.emplace().radius = ContactCase::radius;
    scene.groups.push_back(group);
    return scene;
}

// Quads fly about as leaves do in gusts.
Plan planOf(const ContactCase& contactCase, const Molecule& quad, bool contact) {
    Plan plan = compile(sceneOf(contactCase, quad, contact));
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

class ContactEntrant {
  public:
    ContactEntrant(ContactTimes& result, const Molecule& quad, const BenchDevice& device)
        : result_(result),
          contact_(*device.context, planOf(result.benchCase, quad, true), options()),
          plain_(*device.context, planOf(result.benchCase, quad, false), options()),
          baseline_(weightsOf(quad), result.benchCase.quads, float(ContactCase::radius), device.cores) {
        const Plan& plan = contact_.plan();
        result.spheres = size_t(plan.contact.spheres);
        result.bytes = contact_.contact()->bytes();
        step_.stepTime = float(contactTime);
        step_.restSpeed = float(2 * glm::length(plan.gravity) * contactTime);
        step_.restitution = plan.contact.pairs[0].x;
        step_.friction = plan.contact.pairs[0].y;
        step_.iterations = plan.contact.settings.iterations;
        step_.tolerance = float(plan.contact.settings.tolerance);
        step_.unlikeMasses = plan.contact.unlikeMasses;
        plain_.frame();
        start_ = plain_.save().groups[0];
        if (device.ownTimes)
            own_.emplace(*device.context, planOf(result.benchCase, quad, true),
                         options(gpu::PassTimers::Mode::query));
    }

    // Not counted: compiles, touches memory, and compares what both find; then what a visit costs.
    void warmUp() {
        visit();
        result_.dropped = contact_.contact()->dropped();
        const auto found = contact_.contact()->found(), expected = baseline_.found();
        result_.contacts = found.size();
        result_.baselineContacts = expected.size();
        std::vector<std::pair<int, int>> differ;
        std::set_symmetric_difference(found.begin(), found.end(), expected.begin(), expected.end(),
                                      std::back_inserter(differ));
        if (differ.size() > 2 + found.size() / 100)
            throw Error(concat("bench collide: of ", found.size(), " contacts of ", result_.benchCase.quads,
                               " quads the baseline finds ", differ.size(), " otherwise"));
        seconds = measure::secondsOf([&] { visit(); });
        for (std::vector<double>& samples : samples_)
            samples.clear();
        device_.clear();
    }

    void visit() {
        plain_.restart();
        plain_.frame();
        contact_.restart();
        contact_.frame();
        const gpu::PassTimers& timers = contact_.timers();
        if (own_) device_.push_back(ownTime());
        const double grid = lastOf(timers, "contact grid"), search = lastOf(timers, "contact search"),
                     response = lastOf(timers, "contact response");
        baseline_.set(start_);
        const double baseline = measure::secondsOf([&] { baseline_.step(step_); });
        const double taken[] = {lastOf(plain_.timers(), "fused"), grid,    search, response,
                                grid + search + response,         baseline};
        for (size_t i = 0; i < std::size(times); ++i)
            samples_[i].push_back(taken[i]);
    }

    void finish() {
        for (size_t i = 0; i < std::size(times); ++i)
            result_.*times[i] = measure::spreadOf(samples_[i]);
        result_.device = measure::spreadOf(device_);
    }

    double seconds = 0;  // of a visit

  private:
    static constexpr measure::Spread ContactTimes::*times[] = {
        &ContactTimes::fused,    &ContactTimes::grid,    &ContactTimes::search,
        &ContactTimes::response, &ContactTimes::contact, &ContactTimes::baseline};

    // The device's own, of the passes of contact together.
    double ownTime() {
        own_->restart();
        own_->frame();
        own_->timers().drain();
        double out = 0;
        for (const char* pass : {"contact grid", "contact search", "contact response"})
            out += lastOf(own_->timers(), pass);
        return out;
    }
    // One frame at a time is waited for anyway.
    static SimulationOptions options(gpu::PassTimers::Mode timing = gpu::PassTimers::Mode::finish) {
        return {.drawn = false, .timing = timing, .path = Path::fused};
    }
    static std::vector<float> weightsOf(const Molecule& quad) {
        std::vector<float> out;
        for (const Vertex& vertex : quad.vertices)
            out.push_back(float(1 / vertex.mass));
        return out;
    }

    ContactTimes& result_;
    Simulation contact_, plain_;
    std::optional<Simulation> own_;  // contact again, timed by queries
    ContactBaseline baseline_;
    ContactBaselineStep step_;
    GroupState start_;
    std::vector<double> samples_[std::size(times)], device_;  // s
};

}  // namespace

std::vector<ContactCase> contactCases(bool quick) {
    std::vector<ContactCase> out;
    const double moderate = std::pow(1.07 * 0.2 * std::sqrt(2.0), 3), dense = std::pow(0.15, 3);
    for (const auto& [density, room, most] :
         {std::tuple("moderate", moderate, 4096), std::tuple("dense", dense, 1024)})
        for (const int quads : {1024, 4096, 16384, 65536, 131072})
            if (!quick || quads <= most) out.push_back({density, quads, room});
    return out;
}

std::vector<ContactTimes> measureContact(const std::vector<ContactCase>& cases, const Molecule& quad,
                                         const BenchDevice& device, const measure::Schedule& schedule,
                                         const BenchProgress& progress) {
    std::vector<ContactTimes> out;
    out.reserve(cases.size());
    for (const ContactCase& contactCase : cases)
        out.push_back({.benchCase = contactCase,
                       .leftOut = device.context->info().computeShaders ? "" : "needs OpenGL 4.3"});
    measureInTurn(out, schedule, progress,
                  [&](ContactTimes& times) { return std::make_unique<ContactEntrant>(times, quad, device); });
    device.context->checkErrors("bench collide");
    return out;
}

}  // namespace shoal::bench
