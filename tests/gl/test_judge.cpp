// Contact against another method that has converged: projected Gauss-Seidel in double precision, a contact at
// a time [Jean and Moreau 1992, Unilaterality and dry friction in the dynamics of rigid body collections].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "gl/marbles.h"
#include "support/catch.h"

namespace shoal {

using namespace test;
using glm::dvec3;

namespace {

constexpr double radius = 0.1, step = 0.01, gravity = 9.81;  // m, s, m/s^2

struct Cluster {
    std::vector<reference::Sphere> spheres;  // of a molecule one after another
    std::vector<size_t> numbers;             // of the scene's

    // Whether the sweeps have converged, to `tolerance` of the fastest. Velocities become those after the
    // response. `backwards`: the last pair of a sweep comes first.
    bool solve(double friction, double tolerance, bool backwards) {
        std::vector<Body> bodies;
        std::vector<size_t> bodyOf;
        makeBodies(bodies, bodyOf);
        const auto armOf = [&](size_t sphere) {
            return spheres[sphere].position + step * spheres[sphere].velocity - bodies[bodyOf[sphere]].center;
        };
        struct Pair {
            size_t a, b;
            dvec3 normal, impulse{0};
            double target;
            dvec3 armA, armB;
        };
        std::vector<Pair> pairs;
        for (size_t a = 0; a < spheres.size(); ++a) {
            for (size_t b = a + 1; b < spheres.size(); ++b) {
                if (bodyOf[a] == bodyOf[b]) continue;
                // contact sees the spheres at the end of the step
                const dvec3 apart = spheres[a].position - spheres[b].position +
                                    step * (spheres[a].velocity - spheres[b].velocity);
                const double distance = glm::length(apart);
                if (distance < 1.1 * 2 * radius)
                    pairs.push_back({a, b, apart / distance, dvec3(0),
                                     std::min(2 * radius - distance, 0.0) / step, armOf(a), armOf(b)});
            }
        }
        if (backwards) std::reverse(pairs.begin(), pairs.end());
        bool converged = false;
        for (int sweep = 0; sweep < 50000 && !converged; ++sweep) {
            double fastest = 0, changed = 0;
            for (Pair& pair : pairs) {
                Body &a = bodies[bodyOf[pair.a]], &b = bodies[bodyOf[pair.b]];
                const auto weight = [&](const dvec3& direction) {
                    return a.weight(direction, pair.armA) + b.weight(direction, pair.armB);
                };
                const auto slip = [&] { return a.velocityAt(pair.armA) - b.velocityAt(pair.armB); };
                const auto push = [&](const dvec3& gained) {
                    a.push(gained, pair.armA);
                    b.push(-gained, pair.armB);
                    pair.impulse += gained;
                    const double size = glm::length(gained);
                    if (size > 0) changed = std::max(changed, size * weight(gained / size));
                };
                const dvec3 n = pair.normal;
                const double before = glm::dot(pair.impulse, n);
                const double along = std::max(before + (pair.target - glm::dot(slip(), n)) / weight(n), 0.0);
                push((along - before) * n);
                // any step that is short enough ends where the cone's condition holds
                const dvec3 side =
                    glm::normalize(glm::cross(n, std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 0, 1)));
                const double most = weight(side) + weight(glm::cross(n, side));
                const dvec3 grips = pair.impulse - along * n, u = slip();
                dvec3 across =
                    grips - (u - glm::dot(u, n) * n) / (bodies.size() == spheres.size() ? most / 2 : most);
                const double grip = glm::length(across);
                if (grip > friction * along) across *= friction * along / grip;
                push(across - grips);
                fastest = std::max({fastest, glm::length(a.velocity), glm::length(b.velocity)});
            }
            converged = changed <= tolerance * fastest;
        }
        for (size_t i = 0; i < spheres.size(); ++i)
            spheres[i].velocity = bodies[bodyOf[i]].velocityAt(armOf(i));
        return converged;
    }

  private:
    // As the molecules are at the end of the step, before contact: none of them turns.
    void makeBodies(std::vector<Body>& bodies, std::vector<size_t>& bodyOf) const {
        std::vector<reference::Sphere> ended = spheres;
        for (reference::Sphere& sphere : ended)
            sphere.position += step * sphere.velocity;
        for (size_t first = 0, end = 0; first < spheres.size(); first = end) {
            for (; end < spheres.size() && spheres[end].molecule == spheres[first].molecule; ++end)
                bodyOf.push_back(bodies.size());
            bodies.emplace_back(std::span(ended).subspan(first, end - first));
        }
    }
};

// m/s, weighted by mass.
double distanceOf(const std::vector<dvec3>& a, const std::vector<dvec3>& b, const Cluster& cluster) {
    double sum = 0, mass = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        sum += glm::dot(a[i] - b[i], a[i] - b[i]) / cluster.spheres[i].weight;
        mass += 1 / cluster.spheres[i].weight;
    }
    return std::sqrt(sum / mass);
}

std::vector<dvec3> velocitiesOf(const Cluster& cluster) {
    std::vector<dvec3> out;
    for (const reference::Sphere& sphere : cluster.spheres)
        out.push_back(sphere.velocity);
    return out;
}

struct Errors {
    double median = 0, worst = 0;  // as a part of what contact changes
    size_t judged = 0;
};

// 100 clusters, whose masses differ by a factor of up to `ratio`, and of each vertex its velocity and
// cluster.
struct Clusters100 {
    Scene scene;
    std::vector<dvec3> velocities;
    std::vector<size_t> owners;
};

constexpr size_t clusters = 100, masses = 4;

// 2 to 60 spheres that overlap and approach one another too slowly for an impact.
Clusters100 ofMarbles(double ratio) {
    std::mt19937 random(5);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    Clusters built(masses);
    for (size_t c = 0; c < clusters; ++c) {
        const int count = 2 + int(random() % 59);
        const double side = 1.5 * radius * std::cbrt(count);
        for (int i = 0; i < count; ++i) {
            const size_t mass = random() % masses;
            const dvec3 place = dvec3(4 * double(c % 10), 4 * double(c / 10), 0) +
                                dvec3(between(0, side), between(0, side), between(0, side));
            const dvec3 velocity(between(-0.05, 0.05), between(-0.05, 0.05), between(-0.05, 0.05));
            built.add(mass, place, velocity, c);
        }
    }
    return {built.scene(radius, std::pow(ratio, 1.0 / (masses - 1))), built.velocities(), built.owners()};
}

// 2 to 15 tetrahedra that are rigid bodies, of edges of three radii.
Clusters100 ofBodies(double ratio) {
    std::mt19937 random(7);
    const auto between = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random);
    };
    std::vector<std::vector<Item>> items(masses);
    std::vector<std::vector<dvec3>> velocities(masses);
    std::vector<std::vector<size_t>> owners(masses);
    for (size_t c = 0; c < clusters; ++c) {
        const int count = 2 + int(random() % 14);
        const double side = 3.2 * radius * std::cbrt(count);
        for (int i = 0; i < count; ++i) {
            const size_t mass = random() % masses;
            const glm::dquat turn(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
            items[mass].push_back(at(dvec3(6 * double(c % 10), 6 * double(c / 10), 0) +
                                         dvec3(between(0, side), between(0, side), between(0, side)),
                                     glm::normalize(turn)));
            const dvec3 velocity(between(-0.05, 0.05), between(-0.05, 0.05), between(-0.05, 0.05));
            velocities[mass].insert(velocities[mass].end(), 4, velocity);
            owners[mass].insert(owners[mass].end(), 4, c);
        }
    }
    Clusters100 out;
    for (size_t mass = 0; mass < masses; ++mass) {
        const double factor = std::pow(ratio, double(mass) / (masses - 1));
        Scene part = sceneOf(tetrahedron(3 * radius, factor), SolverKind::bdf2Xpbd, items[mass]);
        part.groups[0].name = concat("mass ", mass);
        part.groups[0].contact.emplace().radius = radius;
        if (mass == 0)
            out.scene = part;
        else
            out.scene.groups.push_back(part.groups[0]);
        out.velocities.insert(out.velocities.end(), velocities[mass].begin(), velocities[mass].end());
        out.owners.insert(out.owners.end(), owners[mass].begin(), owners[mass].end());
    }
    return out;
}

// The velocities that the sweeps make of each cluster, none where they do not converge, or lead to others in
// the opposite order: with friction there may be several answers.
struct Judgement {
    std::vector<Cluster> clusters;
    std::vector<std::vector<dvec3>> velocities;
};

Simulation started(Path path, Clusters100 built, double friction, int iterations) {
    setSteps(built.scene, step, 1);
    built.scene.gravity = {0, -gravity, 0};
    built.scene.contact.iterations = iterations;
    return startedWith(built.scene, built.velocities, glm::vec2(0, float(friction)), path);
}

Judgement judge(Path path, const Clusters100& built, double friction) {
    Judgement out{std::vector<Cluster>(clusters), {}};
    const std::vector<reference::Sphere> spheres = statesOf(started(path, built, friction, 1));
    for (size_t i = 0; i < spheres.size(); ++i) {
        out.clusters[built.owners[i]].spheres.push_back(spheres[i]);
        out.clusters[built.owners[i]].numbers.push_back(i);
    }
    for (const Cluster& cluster : out.clusters) {
        Cluster one = cluster, other = cluster;
        std::vector<dvec3>& right = out.velocities.emplace_back();
        if (!one.solve(friction, 1e-9, false) || !other.solve(friction, 1e-9, true)) continue;
        const std::vector<dvec3> found = velocitiesOf(one);
        const double changes = distanceOf(found, velocitiesOf(cluster), cluster);
        if (changes > 1e-4 && distanceOf(found, velocitiesOf(other), cluster) < 1e-4 * changes) right = found;
    }
    return out;
}

// One step of contact.
Errors errorsOf(const Judgement& judgement, Path path, const Clusters100& built, double friction,
                int iterations) {
    Simulation simulation = started(path, built, friction, iterations);
    simulation.frame();
    CHECK(simulation.contact()->dropped() == 0);
    const std::vector<reference::Sphere> after = statesOf(simulation);
    std::vector<double> errors;
    for (size_t c = 0; c < clusters; ++c) {
        const Cluster& cluster = judgement.clusters[c];
        const std::vector<dvec3>& right = judgement.velocities[c];
        if (right.empty()) continue;
        std::vector<dvec3> found;
        for (const size_t i : cluster.numbers)
            found.push_back(after[i].velocity + dvec3(0, gravity * step, 0));
        errors.push_back(distanceOf(found, right, cluster) /
                         distanceOf(right, velocitiesOf(cluster), cluster));
    }
    std::sort(errors.begin(), errors.end());
    return {errors[errors.size() / 2], errors.back(), errors.size()};
}

struct Bound {
    double ratio, friction;
    int iterations;
    double median, worst;
};

// At least so many clusters are judged.
void hold(Path path, Clusters100 (*clustersOf)(double ratio), const Bound& bound, size_t judged) {
    const Clusters100 built = clustersOf(bound.ratio);
    const Errors errors =
        errorsOf(judge(path, built, bound.friction), path, built, bound.friction, bound.iterations);
    CAPTURE(name(path), bound.ratio, bound.friction, bound.iterations);
    CHECK(errors.judged >= judged);
    CHECK(errors.median < bound.median);
    CHECK(errors.worst < bound.worst);
}

// In percent, median and worst.
void printErrors(Clusters100 (*clustersOf)(double ratio)) {
    for (const double ratio : {1.0, 10.0, 100.0, 1000.0}) {
        for (const double friction : {0.0, 0.5, 1.0}) {
            std::printf("| %g | %g |", ratio, friction);
            const Clusters100 built = clustersOf(ratio);
            const Judgement judgement = judge(pathHere(), built, friction);
            size_t judged = clusters;
            for (const int iterations : {4, 8, 16, 32, 64, 256}) {
                const Errors errors = errorsOf(judgement, pathHere(), built, friction, iterations);
                std::printf(" %.2g, %.2g |", 100 * errors.median, 100 * errors.worst);
                judged = std::min(judged, errors.judged);
            }
            std::printf(" %zu |\n", judged);
            std::fflush(stdout);
        }
    }
}

}  // namespace

TEST_CASE("contact converges to what projected Gauss-Seidel does", "[molecule contact]") {
    const Path path = pathHere();
    const Bound bound = GENERATE(Bound{1, 0, 4, 0.25, 0.4}, Bound{1, 0, 16, 0.04, 0.08},
                                 Bound{1, 0, 64, 2e-4, 0.02}, Bound{1, 0.5, 64, 0.003, 0.05},
                                 Bound{100, 0, 64, 0.008, 0.3}, Bound{1, 0.5, 256, 1e-5, 0.02},
                                 Bound{100, 0, 256, 5e-4, 0.04}, Bound{10, 0.5, 256, 5e-4, 0.06});
    hold(path, ofMarbles, bound, 95);
}

TEST_CASE("contact of rigid bodies converges to what projected Gauss-Seidel does", "[molecule contact]") {
    const Path path = pathHere();
    if (path == Path::pingPong) return;
    const Bound bound =
        GENERATE(Bound{1, 0, 16, 0.07, 0.6}, Bound{1, 0, 64, 1e-3, 0.45}, Bound{1, 0.5, 64, 0.06, 0.4});
    hold(path, ofBodies, bound, 90);
}

// The tables of docs/contact-figures.md.
TEST_CASE("how far marbles are from what projected Gauss-Seidel makes of them", "[.judge]") {
    printErrors(ofMarbles);
}

TEST_CASE("how far rigid bodies are from what projected Gauss-Seidel makes of them", "[.judge]") {
    printErrors(ofBodies);
}

}  // namespace shoal
