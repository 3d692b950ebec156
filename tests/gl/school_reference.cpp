#include "gl/school_reference.h"
#include "scene/collider_kinds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shoal::test {

namespace {

using glm::dvec3;

uint32_t hashSeed(uint32_t seed, uint32_t counter) {
    const uint32_t state = (seed ^ (counter * 2654435769u)) * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

double uniform(uint32_t seed, uint32_t counter) {
    return double(hashSeed(seed, counter) >> 8) / 16777216.0;
}

dvec3 atMost(const dvec3& v, double most) {
    const double size = glm::length(v);
    return size > most ? v * (most / size) : v;
}

dvec3 inTurn(const dvec3& first, const dvec3& then, double most) {
    const dvec3 a = atMost(first, most);
    return a + atMost(then, std::max(most - glm::length(a), 0.0));
}

// (1 - |d| / radius) towards d.
dvec3 towards(const dvec3& d, double radius) {
    const double size = glm::length(d);
    return size > 0 && size < radius ? d / size * (1 - size / radius) : dvec3(0);
}

double wander(double t, double a, double b, double c) {
    const auto rate = [](double least, double random) { return (least + std::floor(256 * random)) / 256; };
    return (std::sin(t * rate(230, a) + 40 * b) + std::sin(t * rate(435, b) + 40 * c) +
            std::sin(t * rate(666, c) + 40 * a)) /
           3;
}

dvec3 backHome(const School& school, const dvec3& place) {
    if (!school.home) return dvec3(0);
    const SchoolHome& home = *school.home;
    if (home.box) return home.strength * (glm::clamp(place, home.box->low, home.box->high) - place);
    const dvec3 d = home.center - place;
    const double r = glm::length(d);
    return r > home.radius ? home.strength * (r - home.radius) * d / r : dvec3(0);
}

double steepnessOf(const dvec3& v) {
    return std::atan2(v.y, std::hypot(v.x, v.z));
}

// The turn from one unit vector to the direction that is wanted, no steeper than allowed: about the vertical,
// and in steepness.
dvec3 turnTo(const dvec3& from, const dvec3& wanted, double steepest) {
    const double pitch = std::clamp(steepnessOf(wanted), -steepest, steepest) - steepnessOf(from);
    const double yaw =
        std::remainder(std::atan2(wanted.x, wanted.z) - std::atan2(from.x, from.z), 2 * std::numbers::pi);
    return yaw * dvec3(0, 1, 0) + pitch * glm::normalize(glm::cross(from, dvec3(0, 1, 0)));
}

}  // namespace

std::vector<SchoolBody> SchoolReference::bodies(size_t group, const GroupState& state) const {
    const GroupPlan& plan = plan_->groups[group];
    const Molecule& molecule = scene_->groups[plan.index].molecule;
    double mass = 0;
    dvec3 middle(0);
    for (const Vertex& vertex : molecule.vertices) {
        mass += vertex.mass;
        middle += vertex.mass * vertex.position;
    }
    middle /= mass;
    std::vector<SchoolBody> out(size_t(plan.count));
    const size_t vertices = molecule.vertices.size();
    for (size_t m = 0; m < out.size(); ++m) {
        dvec3 along(0), upward(0), turning(0), rolling(0);
        SchoolBody& body = out[m];
        body.place = state.anchors[m];
        body.velocity = dvec3(0);
        for (size_t v = 0; v < vertices; ++v) {
            const double share = molecule.vertices[v].mass / mass;
            const dvec3 arm = molecule.vertices[v].position - middle;
            const dvec3 x = state.positions[m * vertices + v], w = state.velocities[m * vertices + v];
            body.place += share * x;
            body.velocity += share * w;
            along += share * arm.z * x;
            turning += share * arm.z * w;
            upward += share * arm.y * x;
            rolling += share * arm.y * w;
        }
        body.forward = glm::normalize(along);
        body.upper = glm::normalize(upward - body.forward * glm::dot(upward, body.forward));
        body.spin =
            glm::cross(body.forward, turning) / glm::length(along) +
            body.forward * (glm::dot(glm::cross(body.upper, rolling), body.forward) / glm::length(upward));
        body.seed = plan.constants.seeds[m] + 1;
    }
    return out;
}

double SchoolReference::clearance(const dvec3& place) const {
    double least = 1e30;
    for (const Collider& collider : scene_->colliders) {
        double distance = 0;
        if (const auto* plane = std::get_if<PlaneCollider>(&*collider.shape))
            distance = glm::dot(glm::normalize(plane->normal), place - plane->point);
        if (const auto* sphere = std::get_if<SphereCollider>(&*collider.shape))
            distance = glm::distance(place, sphere->center) - sphere->radius;
        least = std::min(least, distance - collider.thickness);
    }
    return least;
}

dvec3 SchoolReference::fromWalls(const School& school, const SchoolBody& body) const {
    if (scene_->colliders.empty() || school.walls == 0) return dvec3(0);
    const dvec3 ahead = body.place + school.look * body.velocity;
    const double distance = std::min(clearance(ahead), clearance(body.place));
    if (distance >= school.walls) return dvec3(0);
    const double nudge = 0.1 * school.walls;
    const dvec3 slope = dvec3(clearance(ahead + dvec3(nudge, 0, 0)), clearance(ahead + dvec3(0, nudge, 0)),
                              clearance(ahead + dvec3(0, 0, nudge))) -
                        clearance(ahead);
    return glm::normalize(slope) *
           (school.acceleration * std::clamp(2 - 2 * distance / school.walls, 0.0, 1.0));
}

dvec3 SchoolReference::meetTargets(const School& school, const SavedState& state,
                                   const SchoolBody& body) const {
    dvec3 a(0);
    const auto meet = [&](const SchoolTarget& target, bool flees) {
        dvec3 sum(0);
        double weight = 0;
        for (size_t g = 0; g < plan_->groups.size(); ++g) {
            if (scene_->groups[plan_->groups[g].index].name != target.group) continue;
            for (const SchoolBody& other : bodies(g, state.groups[g])) {
                const dvec3 way = towards(other.place - body.place, target.radius);
                sum += way;
                weight += glm::length(way);
            }
        }
        a += flees ? -target.strength * sum : target.strength * sum / std::max(weight, 1e-6);
    };
    for (const SchoolTarget& target : school.flees)
        meet(target, true);
    for (const SchoolTarget& target : school.hunts)
        meet(target, false);
    return a;
}

std::vector<Steered> SchoolReference::steer(size_t group, const SavedState& state, double duration) const {
    const School& school = *scene_->groups[plan_->groups[group].index].school;
    const Molecule& molecule = scene_->groups[plan_->groups[group].index].molecule;
    double low = 1e30, high = -1e30;
    for (const Vertex& vertex : molecule.vertices) {
        low = std::min(low, vertex.position.z);
        high = std::max(high, vertex.position.z);
    }
    const std::vector<SchoolBody> all = bodies(group, state.groups[group]);
    std::vector<Steered> out(all.size());
    for (size_t m = 0; m < all.size(); ++m) {
        const SchoolBody& body = all[m];
        const double speed = glm::dot(body.velocity, body.forward);
        dvec3 apart(0), velocity(0), place(0);
        double theirSpeed = 0;
        for (size_t o = 0; o < all.size(); ++o) {
            const dvec3 d = all[o].place - body.place;
            const double distance = glm::length(d), along = glm::dot(d, body.forward);
            if (o == m || distance >= school.radius) continue;
            if (along < 0 && along < -std::cos(school.blind) * distance) continue;
            apart -= towards(d, school.separationRadius);
            velocity += all[o].velocity;
            theirSpeed += glm::dot(all[o].velocity, all[o].forward);
            place += d;
            ++out[m].others;
        }
        const dvec3 urgent =
            inTurn(fromWalls(school, body), meetTargets(school, state, body) + backHome(school, body.place),
                   school.acceleration);
        dvec3 liked = school.separation * apart;
        if (const double n = out[m].others; n > 0)
            liked += school.alignment * (velocity / n - body.forward * glm::dot(velocity / n, body.forward) +
                                         body.forward * (theirSpeed / n - speed)) +
                     school.cohesion * place / n;
        if (school.depth)
            liked.y += school.depthStrength *
                       (std::clamp(body.place.y, school.depth->x, school.depth->y) - body.place.y);
        const double a = uniform(body.seed, 0x5c0002u), b = uniform(body.seed, 0x5c0003u),
                     c = uniform(body.seed, 0x5c0004u), t = state.time;
        liked += school.wander *
                 (glm::cross(body.upper, body.forward) * wander(t, a, b, c) +
                  body.upper * (0.4 * wander(t, b, c, a)) + body.forward * (0.5 * wander(t, c, a, b)));
        const dvec3 earlier = state.groups[group].steering[3 * m + 2];
        const dvec3 steered = glm::mix(earlier, inTurn(urgent, liked, school.acceleration),
                                       1 - std::exp(-duration / school.reaction));
        const dvec3 wanted = body.forward * std::max(speed, school.slowest) + steered * school.reaction;
        dvec3 turning = atMost(turnTo(body.forward, wanted, school.steepest) / school.reaction, school.turn);
        const double wantedSpeed =
            std::clamp(school.cruise + glm::dot(steered, body.forward) * 2 * school.reaction, school.slowest,
                       school.fastest);
        const double drag = scene_->groups[plan_->groups[group].index].drag.tangent;
        const double push =
            school.fins * std::clamp((wantedSpeed - speed) / school.reaction + drag * wantedSpeed,
                                     -school.acceleration, school.acceleration);
        const double most = school.bend / (high - low);
        const double curvature =
            std::clamp(glm::dot(turning, body.upper) / std::max(speed, 0.5 * school.cruise), -most, most);
        dvec3 above = dvec3(0, 1, 0) + 0.1 * (steered - body.forward * glm::dot(steered, body.forward));
        above -= body.forward * glm::dot(above, body.forward);
        turning +=
            body.forward * std::clamp(6 * std::atan2(glm::dot(glm::cross(body.upper, above), body.forward),
                                                     glm::dot(body.upper, above)),
                                      -8.0, 8.0);
        const dvec3 answer = (turning - body.spin) * std::min(20.0, 0.5 / duration);
        const double rate = school.beat > 0 ? std::max(wantedSpeed, 0.3 * school.cruise) / school.beat : 1;
        double clock = double(state.groups[group].steering[3 * m + 2].w) + rate * duration;
        const double period = plan_->groups[group].musclePeriod;
        if (period > 0) clock -= period * std::floor(clock / period);
        out[m].record = {glm::dvec4(body.forward * push, curvature), glm::dvec4(answer, rate),
                         glm::dvec4(steered, clock)};
    }
    return out;
}

}  // namespace shoal::test
