// Impacts against another method: an event at a time, in double precision, whatever the steps are.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "gl/agreement.h"
#include "gl/marbles.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;

namespace {

constexpr double radius = 0.1, duration = 0.3;  // m, s

// s; infinite where they do not meet.
double untilImpact(const reference::Sphere& a, const reference::Sphere& b) {
    const dvec3 d = a.position - b.position, u = a.velocity - b.velocity;
    const double along = glm::dot(d, u), gap = glm::dot(d, d) - 4 * radius * radius;
    const double inside = along * along - glm::dot(u, u) * gap;
    if (along >= 0 || inside < 0) return std::numeric_limits<double>::infinity();
    return std::max(gap / (std::sqrt(inside) - along), 0.0);
}

// Two spheres that touch, at their arms from the middles of their bodies: Newton's restitution along the line
// of the centres, then Coulomb's friction against what is left of the slip.
void strike(Body& a, const dvec3& armA, Body& b, const dvec3& armB, double restitution, double friction) {
    const dvec3 n = glm::normalize(a.center + armA - b.center - armB);
    const auto slip = [&] { return a.velocityAt(armA) - b.velocityAt(armB); };
    const auto weight = [&](const dvec3& along) { return a.weight(along, armA) + b.weight(along, armB); };
    const auto push = [&](const dvec3& impulse) {
        a.push(impulse, armA);
        b.push(-impulse, armB);
    };
    const double normal = -(1 + restitution) * glm::dot(slip(), n) / weight(n);
    push(normal * n);
    const dvec3 across = slip() - glm::dot(slip(), n) * n;
    const double speed = glm::length(across);
    if (speed > 0) push(-std::min(speed / weight(across / speed), friction * normal) * (across / speed));
}

struct Cluster {
    std::vector<reference::Sphere> spheres;
    std::vector<size_t> numbers;  // of the scene's

    // Moves them in straight lines from impact to impact. Returns how many there were, or -1 where they are
    // so many that some pair no longer parts.
    int run(double restitution, double friction) {
        double time = 0;
        for (int impacts = 0; impacts < 2000; ++impacts) {
            double next = duration - time;
            size_t first = 0, second = 0;
            for (size_t a = 0; a < spheres.size(); ++a) {
                for (size_t b = a + 1; b < spheres.size(); ++b) {
                    const double t = untilImpact(spheres[a], spheres[b]);
                    if (t < next) {
                        next = t;
                        first = a;
                        second = b;
                    }
                }
            }
            for (reference::Sphere& sphere : spheres)
                sphere.position += next * sphere.velocity;
            time += next;
            if (first == second) return impacts;
            reference::Sphere &one = spheres[first], &other = spheres[second];
            Body a({&one, 1}), b({&other, 1});
            strike(a, dvec3(0), b, dvec3(0), restitution, friction);
            one.velocity = a.velocity;
            other.velocity = b.velocity;
        }
        return -1;
    }
};

// m/s, weighted by mass.
double distanceOf(const Cluster& cluster, const std::vector<reference::Sphere>& others) {
    double sum = 0, mass = 0;
    for (size_t i = 0; i < cluster.spheres.size(); ++i) {
        const reference::Sphere& sphere = cluster.spheres[i];
        const dvec3 off = sphere.velocity - others[cluster.numbers[i]].velocity;
        sum += glm::dot(off, off) / sphere.weight;
        mass += 1 / sphere.weight;
    }
    return std::sqrt(sum / mass);
}

struct Case {
    double ratio, restitution, friction;
    double filled = 0.1;  // share of the cluster's cube
};

struct Errors {
    double median = 0, worst = 0;  // as a part of what impacts change
    size_t judged = 0;
    double impacts = 0;  // a sphere, in the mean
};

constexpr size_t clusters = 100, masses = 4;

// 100 clusters of 2 to 60 spheres, apart from one another, that fly at their middle and at random.
Clusters clustersOf(double filled) {
    std::mt19937 random(11);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    Clusters out(masses);
    for (size_t c = 0; c < clusters; ++c) {
        const int count = 2 + int(random() % 59);
        const double side = radius * std::cbrt(count * 4 * 3.14159265 / 3 / filled);
        std::vector<dvec3> places;
        while (places.size() < size_t(count)) {
            const dvec3 place(between(0, side), between(0, side), between(0, side));
            const bool fits = std::all_of(places.begin(), places.end(), [&](const dvec3& other) {
                return glm::distance(place, other) > 2.02 * radius;
            });
            if (!fits) continue;
            places.push_back(place);
            const dvec3 velocity = -2.0 * (place - dvec3(side / 2)) / side;
            out.add(random() % masses, place + dvec3(6 * double(c % 10), 6 * double(c / 10), 0),
                    velocity + dvec3(between(-1, 1), between(-1, 1), between(-1, 1)), c);
        }
    }
    return out;
}

Errors errorsOf(Path path, const Case& judged, int frames) {
    const Clusters built = clustersOf(judged.filled);
    const std::vector<size_t> owners = built.owners();
    Scene scene = built.scene(radius, std::pow(judged.ratio, 1.0 / (masses - 1)));
    setSteps(scene, duration / frames, 1);
    Simulation simulation = startedWith(scene, built.velocities(),
                                        glm::vec2(float(judged.restitution), float(judged.friction)), path);
    std::vector<Cluster> all(clusters);
    const std::vector<reference::Sphere> before = statesOf(simulation);
    for (size_t i = 0; i < before.size(); ++i) {
        all[owners[i]].spheres.push_back(before[i]);
        all[owners[i]].numbers.push_back(i);
    }
    test::run(simulation, frames);
    const std::vector<reference::Sphere> after = statesOf(simulation);
    Errors out;
    std::vector<double> errors;
    size_t spheres = 0;
    for (Cluster& cluster : all) {
        const int impacts = cluster.run(judged.restitution, judged.friction);
        if (impacts < 0) continue;
        const double changes = distanceOf(cluster, before);
        if (changes < 1e-4) continue;
        errors.push_back(distanceOf(cluster, after) / changes);
        out.impacts += 2 * impacts;
        spheres += cluster.spheres.size();
    }
    std::sort(errors.begin(), errors.end());
    out.median = errors[errors.size() / 2];
    out.worst = errors.back();
    out.judged = errors.size();
    out.impacts /= double(spheres);
    return out;
}

// A rigid body, in double precision.
struct Flying {
    Body body;
    std::vector<dvec3> arms;  // of its spheres, when they meet

    explicit Flying(std::span<const reference::Sphere> spheres) : body(spheres) {
        for (const reference::Sphere& sphere : spheres)
            arms.push_back(sphere.position - body.center);
    }
    // How it has turned so many seconds later.
    glm::dquat turn(double time) const {
        const double angle = glm::length(body.spin) * time;
        return angle > 0 ? glm::angleAxis(angle, glm::normalize(body.spin)) : glm::dquat(1, 0, 0, 0);
    }
    dvec3 placeOf(size_t sphere, double time) const {
        return body.center + time * body.velocity + turn(time) * arms[sphere];
    }
    dvec3 velocityOf(size_t sphere, double time) const { return body.velocityAt(turn(time) * arms[sphere]); }
};

// Two that do not turn until they meet.
struct BodyPair {
    Flying a, b;
    size_t first = 0, second = 0;  // their spheres that meet
    double meets = duration;       // s

    BodyPair(std::span<const reference::Sphere> ones, std::span<const reference::Sphere> others)
        : a(ones), b(others) {
        for (size_t i = 0; i < ones.size(); ++i) {
            for (size_t k = 0; k < others.size(); ++k) {
                const double time = untilImpact(ones[i], others[k]);
                if (time >= meets) continue;
                meets = time;
                first = i;
                second = k;
            }
        }
    }

    void strike(double restitution, double friction) {
        for (Body* body : {&a.body, &b.body})
            body->center += meets * body->velocity;
        shoal::strike(a.body, a.arms[first], b.body, b.arms[second], restitution, friction);
    }

    // Whether other spheres touch so many seconds later.
    bool touchAgain(double time) const {
        for (size_t i = 0; i < a.arms.size(); ++i)
            for (size_t k = 0; k < b.arms.size(); ++k)
                if ((i != first || k != second) &&
                    glm::distance(a.placeOf(i, time), b.placeOf(k, time)) < 2 * radius)
                    return true;
        return false;
    }

    // m/s, of how far the velocities of its spheres are off.
    double errorOf(std::span<const reference::Sphere> after, double time) const {
        double worst = 0;
        for (size_t i = 0; i < after.size(); ++i) {
            const bool isFirst = i < a.arms.size();
            const dvec3 right = isFirst ? a.velocityOf(i, time) : b.velocityOf(i - a.arms.size(), time);
            worst = std::max(worst, glm::distance(after[i].velocity, right));
        }
        return worst;
    }
};

}  // namespace

// Where a step has more impacts of one sphere than there are rounds, some wait for the next: then a cluster
// is off.
TEST_CASE("impacts of clusters are those of events", "[impacts]") {
    const Path path = pathHere();
    struct Bound {
        Case judged;
        int frames;
        double median, worst;
        size_t least;  // clusters
    };
    const Bound bound =
        GENERATE(Bound{{1, 1, 0}, 120, 1e-4, 1e-2, 95}, Bound{{1, 0.5, 0.5}, 60, 1e-4, 0.3, 95},
                 Bound{{1000, 0.8, 0.5}, 240, 1e-3, 0.3, 60});
    if (path != Path::fused && bound.frames > 120) return;  // half a minute
    const Errors errors = errorsOf(path, bound.judged, bound.frames);
    CAPTURE(name(path), bound.judged.ratio, bound.judged.restitution, errors.median, errors.worst,
            errors.judged, errors.impacts);
    CHECK(errors.judged >= bound.least);
    CHECK(errors.impacts > 2);
    CHECK(errors.median < bound.median);
    CHECK(errors.worst < bound.worst);
}

// 100 pairs, in the step of their impact. What it has turned within the step is of the order of the step.
TEST_CASE("impacts of rigid bodies are those of events", "[impacts]") {
    if (!canFuse()) return;
    const Path path = GENERATE(Path::fused, Path::fragments);
    const double e = GENERATE(1.0, 0.3), friction = GENERATE(0.0, 0.5);
    constexpr size_t pairs = 100, corners = 4;
    constexpr int frames = 240;
    std::mt19937 random(17);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    std::vector<Item> items;
    std::vector<dvec3> velocities;
    for (size_t p = 0; p < pairs; ++p) {
        const dvec3 middle(6 * double(p % 10), 6 * double(p / 10), 0);
        const dvec3 aside(0, between(-0.15, 0.15), between(-0.15, 0.15));
        for (const dvec3& place : {middle, middle - dvec3(0.75, 0, 0) + aside}) {
            const glm::dquat turn(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
            items.push_back(at(place, glm::normalize(turn)));
        }
        velocities.insert(velocities.end(), corners, dvec3(0));
        velocities.insert(velocities.end(), corners, dvec3(2, 0, 0));
    }
    Scene scene = sceneOf(tetrahedron(3 * radius, 1), SolverKind::bdf2Xpbd, items);
    scene.groups[0].contact.emplace().radius = radius;
    setSteps(scene, duration / frames, 1);
    Simulation simulation = startedWith(scene, velocities, glm::vec2(float(e), float(friction)), path);
    REQUIRE(simulation.plan().groups[0].rigid);
    const std::vector<reference::Sphere> before = statesOf(simulation);
    std::vector<BodyPair> judged;
    const auto pairIn = [&](const std::vector<reference::Sphere>& all, size_t p) {
        return std::span(all).subspan(2 * corners * p, 2 * corners);
    };
    for (size_t p = 0; p < pairs; ++p) {
        const auto both = pairIn(before, p);
        judged.emplace_back(both.first(corners), both.last(corners));
        judged.back().strike(e, friction);
    }
    std::vector<double> errors;  // as parts of the speed
    for (int frame = 1; frame <= frames; ++frame) {
        simulation.frame();
        const std::vector<reference::Sphere> after = statesOf(simulation);
        for (size_t p = 0; p < pairs; ++p) {
            const double since = frame * duration / frames - judged[p].meets;
            if (since <= 0 || since > duration / frames || judged[p].touchAgain(since)) continue;
            errors.push_back(judged[p].errorOf(pairIn(after, p), since) / 2);
        }
    }
    std::sort(errors.begin(), errors.end());
    CAPTURE(name(path), e, friction, errors.size(), errors[errors.size() / 2], errors.back());
    CHECK(errors.size() > 80);
    CHECK(errors[errors.size() / 2] < 0.003);
    CHECK(errors.back() < 0.01);
}

TEST_CASE("how far impacts are from those of events", "[.judge]") {
    for (const double ratio : {1.0, 1000.0}) {
        for (const double e : {1.0, 0.8, 0.5, 0.2}) {
            for (const double friction : {0.0, 0.5, 1.0}) {
                std::printf("| %g | %g | %g |", ratio, e, friction);
                for (const int frames : {15, 30, 60, 120, 240}) {
                    const Errors errors = errorsOf(pathHere(), {ratio, e, friction}, frames);
                    std::printf(" %.2g, %.2g (%zu, %.1f) |", 100 * errors.median, 100 * errors.worst,
                                errors.judged, errors.impacts);
                }
                std::printf("\n");
                std::fflush(stdout);
            }
        }
    }
}

}  // namespace shoal
