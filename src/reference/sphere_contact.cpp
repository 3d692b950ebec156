#include "reference/sphere_contact.h"

#include <algorithm>
#include <cmath>

namespace shoal::reference {

namespace {

using Contacts = std::vector<std::pair<int, int>>;

// What is known of a contact before its impulse.
struct Meeting {
    glm::dvec3 normal{0, 1, 0};  // from the second to the first
    double since = 0;            // s
    double depth = 0;            // m
    double target = 0;           // m/s, along the normal afterwards
    double share = 1;
    double weight = 0;  // 1/kg, of both
    bool impact = false;
};

Meeting meetingOf(const Sphere& a, const Sphere& b, const SphereResponse& settings) {
    Meeting out;
    const double reach = a.radius + b.radius;
    const glm::dvec3 d = a.position - b.position, u = a.velocity - b.velocity;
    out.weight = a.weight + b.weight;
    out.depth = reach - glm::length(d);
    // |d - u t| = reach
    const double p = glm::dot(d, u), q = glm::dot(u, u), inside = reach * reach - glm::dot(d, d);
    const double since = q > 0 ? (p + std::sqrt(p * p + q * inside)) / q : 1e300;
    const glm::dvec3 touch = (d - u * since) / reach;
    const double speed = glm::dot(touch, u);
    out.impact = since <= settings.stepTime && speed < -settings.restSpeed;
    if (out.impact) {
        out.normal = touch;
        out.since = since;
        out.target = -settings.restitution * speed;
        return out;
    }
    if (glm::length(d) > 1e-6 * reach) out.normal = glm::normalize(d);
    out.target = std::max(glm::dot(out.normal, u), 0.0);
    return out;
}

}  // namespace

Contacts touching(const std::vector<Sphere>& spheres) {
    Contacts out;
    for (size_t a = 0; a < spheres.size(); ++a) {
        for (size_t b = a + 1; b < spheres.size(); ++b) {
            const double reach = spheres[a].radius + spheres[b].radius;
            const glm::dvec3 d = spheres[a].position - spheres[b].position;
            if (glm::dot(d, d) < reach * reach && spheres[a].molecule != spheres[b].molecule)
                out.emplace_back(int(a), int(b));
        }
    }
    return out;
}

void respond(std::vector<Sphere>& spheres, const Contacts& contacts, const SphereResponse& settings) {
    std::vector<int> crowd(spheres.size());
    for (const auto& [a, b] : contacts) {
        ++crowd[size_t(a)];
        ++crowd[size_t(b)];
    }
    std::vector<Meeting> meetings;
    std::vector<double> pushed;
    std::vector<glm::dvec3> impulse(spheres.size()), shift(spheres.size());
    const auto exchange = [&](std::vector<glm::dvec3>& sums, const std::pair<int, int>& contact,
                              const glm::dvec3& amount) {
        sums[size_t(contact.first)] += amount;
        sums[size_t(contact.second)] -= amount;
    };
    for (const auto& contact : contacts) {
        const Sphere &a = spheres[size_t(contact.first)], &b = spheres[size_t(contact.second)];
        Meeting m = meetingOf(a, b, settings);
        m.share = 1.0 / std::max(crowd[size_t(contact.first)], crowd[size_t(contact.second)]);
        const double push = m.impact || m.weight == 0 ? 0 : m.share * m.depth / m.weight;
        exchange(shift, contact, push * m.normal);
        pushed.push_back(push / settings.stepTime);
        exchange(impulse, contact, pushed.back() * m.normal);
        meetings.push_back(m);
    }
    const auto relativeTo = [&](const std::pair<int, int>& contact, const std::vector<glm::dvec3>& sums) {
        const auto velocity = [&](int i) {
            return spheres[size_t(i)].velocity + spheres[size_t(i)].weight * sums[size_t(i)];
        };
        return velocity(contact.first) - velocity(contact.second);
    };
    for (int i = 0; i < settings.iterations; ++i) {
        const std::vector<glm::dvec3> before = impulse;
        for (size_t c = 0; c < contacts.size(); ++c) {
            const Meeting& m = meetings[c];
            if (m.weight == 0) continue;
            const double speed = glm::dot(relativeTo(contacts[c], before), m.normal);
            const double change = std::max(m.share * (m.target - speed) / m.weight, -pushed[c]);
            pushed[c] += change;
            exchange(impulse, contacts[c], change * m.normal);
        }
    }
    const std::vector<glm::dvec3> before = impulse;
    for (size_t c = 0; c < contacts.size(); ++c) {
        const Meeting& m = meetings[c];
        if (m.weight == 0) continue;
        const glm::dvec3 relative = relativeTo(contacts[c], before);
        const glm::dvec3 along = relative - glm::dot(relative, m.normal) * m.normal;
        const double slip = glm::length(along);
        const double grip = std::min(settings.friction * pushed[c], m.share * slip / m.weight);
        const glm::dvec3 rub = slip > 0 ? along * (-grip / slip) : glm::dvec3(0);
        exchange(impulse, contacts[c], rub);
        if (m.impact) exchange(shift, contacts[c], (pushed[c] * m.normal + rub) * m.since);
    }
    for (size_t i = 0; i < spheres.size(); ++i) {
        spheres[i].velocity += spheres[i].weight * impulse[i];
        spheres[i].position += spheres[i].weight * shift[i];
    }
}

}  // namespace shoal::reference
