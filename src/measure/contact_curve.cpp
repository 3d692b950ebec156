#include "measure/contact_curve.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "measure/overlap.h"
#include "simulate/carry_over.h"

namespace shoal::measure {

namespace {

std::string drivenBy(const Scene& scene) {
    if (!scene.fields.empty()) return "fields";
    if (!scene.forces.empty()) return "forces";
    for (const Collider& collider : scene.colliders)
        if (collider.path) return "colliders that move";
    for (const Group& group : scene.groups) {
        if (group.school) return "steering";
        if (group.life) return "births";
        for (const Spring& spring : group.molecule.springs)
            if (spring.actuation) return "muscles";
    }
    return {};
}

// Of all molecules together.
struct Sum {
    double energy = 0, kinetic = 0, speeds = 0;  // J, J, kg m/s of m |v|
    glm::dvec3 momentum{0};                      // kg m/s
    bool isFinite() const { return std::isfinite(energy + kinetic); }
};

Sum sumOf(const Scene& scene, const Simulation& simulation) {
    Sum out;
    for (size_t g = 0; g < simulation.plan().groups.size(); ++g) {
        const GroupPlan& plan = simulation.plan().groups[g];
        const Group& group = scene.groups[plan.index];
        const Snapshot snapshot = simulation.snapshot(g);
        for (int m = 0; m < snapshot.count; ++m) {
            const reference::Problem problem =
                springsOf(scene, group, double(plan.constants.scales[size_t(m)]), 0);
            const reference::State state = ExactEnds::stateOf(snapshot, m);
            out.energy += reference::energy(problem, state);
            for (size_t v = 0; v < state.velocity.size(); ++v) {
                const double mass = group.molecule.vertices[v].mass, speed = glm::length(state.velocity[v]);
                out.kinetic += mass * speed * speed / 2;
                out.speeds += mass * speed;
                out.momentum += mass * state.velocity[v];
            }
        }
    }
    return out;
}

bool holdsPins(const Scene& scene) {
    return std::any_of(scene.groups.begin(), scene.groups.end(), [](const Group& group) {
        const std::vector<Vertex>& vertices = group.molecule.vertices;
        return group.held && std::any_of(vertices.begin(), vertices.end(),
                                         [](const Vertex& vertex) { return vertex.pinned; });
    });
}

class ContactSweep {
  public:
    ContactSweep(const Scene& scene, const ContactCurveOptions& options, const AccuracyDevice& device)
        : asked_(scene), scene_(scene), options_(options), device_(device) {
        scene_.contact.rest.reset();
        frames_ = std::max(1, int(std::lround(options.duration * scene.frameRate)));
        out_.scene = scene.name;
        out_.frameRate = scene.frameRate;
        out_.duration = frames_ / scene.frameRate;
        out_.driven = drivenBy(scene);
    }

    ContactCurve run() {
        const Plan own = compile(scene_);
        describe(own);
        choosePoints(own);
        const double runs = double(out_.points.size()) * (1 + options_.rounds);
        for (const size_t i : order_) {
            judge(i);
            options_.tell(++done_ / runs);
        }
        for (int round = 0; round < options_.rounds; ++round)
            for (const size_t i : order_) {
                time(i);
                options_.tell(++done_ / runs);
            }
        return conclude();
    }

  private:
    struct Timed {
        std::unique_ptr<Simulation> simulation;
        double seconds = 0;           // of a run, as the last one took
        std::vector<double> samples;  // s a frame
    };

    void describe(const Plan& plan) {
        std::set<std::string> solvers;
        for (const GroupPlan& group : plan.groups) {
            solvers.insert(name(group.solver));
            out_.molecules += group.count;
            const double mass = group.count * scene_.groups[group.index].molecule.mass();
            weight_ += mass * glm::length(scene_.gravity);
        }
        out_.solver = joined(std::vector<std::string>(solvers.begin(), solvers.end()), ", ");
        out_.spheres = plan.contact.spheres;
        for (const ContactGroup& group : plan.contact.groups) {
            const GroupPlan& own = plan.groups[group.group];
            leastEnergy_ += own.count * scene_.groups[own.index].molecule.mass() *
                            glm::length(scene_.gravity) * group.radius;
        }
    }

    void choosePoints(const Plan& plan) {
        const int substeps = plan.substeps, iterations = plan.contact.settings.iterations;
        const auto around = [](const std::vector<int>& given, int own, double least, int most) {
            std::set<int> out(given.begin(), given.end());
            if (given.empty())
                for (double factor = least; factor <= 4; factor *= 2)
                    out.insert(std::clamp(int(std::lround(own * factor)), 1, most));
            return out;
        };
        for (const int s : around(options_.substeps, substeps, 0.5, maxSubsteps))
            for (const int i :
                 around(options_.iterations, iterations, 0.25, ContactSettings::mostIterations)) {
                const bool scenes = s == substeps && i == iterations;
                order_.insert(scenes ? order_.begin() : order_.end(), out_.points.size());
                out_.points.push_back({.substeps = s, .iterations = i, .scenes = scenes});
            }
        timed_.resize(out_.points.size());
    }

    Scene sceneAt(const ContactPoint& point) const {
        Scene out = scene_;
        out.solver.substeps = point.substeps;
        out.contact.iterations = point.iterations;
        return out;
    }

    // A run whose every frame is looked at.
    void judge(size_t i) {
        ContactPoint& point = out_.points[i];
        if (i != order_.front() && limit_.over(0.5)) {
            point.why = "there was no time for it";
            ++withoutTime_;
            return;
        }
        const Scene scene = sceneAt(point);
        try {
            timed_[i].simulation =
                std::make_unique<Simulation>(*device_.context, compile(scene), simulationOptions(device_));
        } catch (const Error& error) {
            point.outcome = Outcome::refused;
            point.why = error.message();
            return;
        }
        Simulation& simulation = *timed_[i].simulation;
        point.steps = simulation.plan().contact.steps;
        Sum sum = sumOf(scene, simulation);
        double least = sum.energy, kinetic = sum.kinetic, given = 0, square = 0;
        size_t contacts = 0;
        for (int frame = 0; frame < frames_; ++frame) {
            timed_[i].seconds += secondsOf([&] {
                simulation.frame();
                glFinish();
            });
            sum = sumOf(scene, simulation);
            if (!sum.isFinite()) {
                point.outcome = Outcome::notFinite;
                point.why = "positions or velocities are no numbers any more";
                return;
            }
            given = std::max(given, sum.energy - least);
            least = std::min(least, sum.energy);
            kinetic = std::max(kinetic, sum.kinetic);
            const Overlap overlap = overlapOf(simulation);
            point.errors.largestOverlap = std::max(point.errors.largestOverlap, overlap.largest);
            square += overlap.rms * overlap.rms * double(overlap.contacts);
            contacts += overlap.contacts;
        }
        point.errors.overlap = std::sqrt(square / double(std::max<size_t>(1, contacts)));
        point.contacts = double(contacts) / frames_;
        const double scale = std::max(kinetic, leastEnergy_);
        if (out_.driven.empty()) point.errors.energyGiven = scale > 0 ? given / scale : given;
        if (!holdsPins(scene_) && out_.driven.empty())
            point.errors.momentum = momentumError(scene, simulation);
        point.outcome = Outcome::measured;
    }

    // Contact alone, from the state at the end.
    double momentumError(Scene scene, const Simulation& simulation) const {
        scene.colliders.clear();
        scene.gravity = glm::dvec3(0);
        for (Group& group : scene.groups)
            group.drag = {};
        Simulation alone(*device_.context, compile(scene), simulationOptions(device_));
        alone.load(goOn(simulation.save(), simulation.plan(), alone.plan()).state);
        const Sum before = sumOf(scene, alone);
        alone.frame();
        const Sum after = sumOf(scene, alone);
        const double scale = before.speeds + weight_ / scene.frameRate;
        const double change = glm::length(after.momentum - before.momentum);
        return scale > 0 ? change / scale : change;
    }

    void time(size_t i) {
        ContactPoint& point = out_.points[i];
        if (point.outcome != Outcome::measured) return;
        if (i != order_.front() && timed_[i].seconds > limit_.left()) return;
        Simulation& simulation = *timed_[i].simulation;
        simulation.restart();
        glFinish();
        timed_[i].seconds = secondsOf([&] {
            for (int frame = 0; frame < frames_; ++frame)
                simulation.frame();
            glFinish();
        });
        timed_[i].samples.push_back(timed_[i].seconds / frames_);
    }

    ContactCurve conclude() {
        if (std::none_of(out_.points.begin(), out_.points.end(),
                         [](const ContactPoint& point) { return point.outcome == Outcome::measured; }))
            throw Error(concat("contact cannot be measured: ", out_.points[order_.front()].why));
        for (size_t i = 0; i < timed_.size(); ++i)
            out_.points[i].time = spreadOf(timed_[i].samples);
        markFront(out_.points);
        if (withoutTime_ > 0)
            out_.notes.push_back(concat("--seconds ", *options_.seconds, " is too short for ", withoutTime_,
                                        " of ", out_.points.size(), " points"));
        if (!out_.driven.empty())
            out_.notes.push_back(concat("energy that contact gives is not told: ", out_.driven,
                                        " move the molecules as well"));
        if (asked_.contact.rest) out_.notes.push_back("nothing rests: \"rest\" is left out");
        device_.context->checkErrors("measure");
        return std::move(out_);
    }

    const Scene& asked_;
    Scene scene_;
    const ContactCurveOptions& options_;
    const AccuracyDevice& device_;
    int frames_ = 60;
    double leastEnergy_ = 0, weight_ = 0;  // J, N
    ContactCurve out_;
    std::vector<size_t> order_;  // of the points: the scene's own first
    std::vector<Timed> timed_;   // of each point
    TimeLimit limit_{options_.seconds};
    int done_ = 0, withoutTime_ = 0;
};

}  // namespace

void markFront(std::vector<ContactPoint>& points) {
    std::vector<std::pair<double, double>> pairs;
    std::vector<size_t> places;
    for (size_t i = 0; i < points.size(); ++i) {
        points[i].front = false;
        if (points[i].time.samples == 0) continue;
        pairs.emplace_back(points[i].time.min, points[i].errors.overlap);
        places.push_back(i);
    }
    for (const size_t i : paretoFront(pairs))
        points[places[i]].front = true;
}

ContactCurve measureContact(const Scene& scene, const ContactCurveOptions& options,
                            const AccuracyDevice& device) {
    if (std::none_of(scene.groups.begin(), scene.groups.end(),
                     [](const Group& group) { return group.contact.has_value(); }))
        throw Error(Location{scene.file, 0, 0, {}},
                    "no group of the scene has contact between molecules: there is no contact to measure");
    return ContactSweep(scene, options, device).run();
}

}  // namespace shoal::measure
