#include "reference/sphere_response.h"

#include <algorithm>
#include <cmath>

namespace shoal::reference {

namespace {

using Contacts = std::vector<std::pair<int, int>>;

// The terms of a contact, known before its impulse.
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

// Returns the shaders' bound of the largest eigenvalue of `sum`, the sum of n n^T
// (shaders/physics/pair.glsl).
double effectiveCount(const glm::dmat3& sum) {
    double rows = 0, squares = 0;
    for (int i = 0; i < 3; ++i) {
        double row = 0;
        for (int k = 0; k < 3; ++k) {
            row += std::abs(sum[i][k]);
            squares += sum[i][k] * sum[i][k];
        }
        rows = std::max(rows, row);
    }
    const bool several = sum[0][0] + sum[1][1] + sum[2][2] > 1.5;
    return std::max(std::min(rows, std::sqrt(squares)), several ? 1.01 : 1.0);
}

class Response {
  public:
    Response(std::vector<Sphere>& spheres, const Contacts& contacts, const SphereResponse& settings)
        : spheres_(&spheres),
          contacts_(&contacts),
          settings_(settings),
          impulse_(spheres.size()),
          number_(spheres.size()) {
        std::vector<glm::dmat3> normals(spheres.size(), glm::dmat3(0));
        for (const auto& [a, b] : contacts) {
            meetings_.push_back(meetingOf(spheres[size_t(a)], spheres[size_t(b)], settings));
            const glm::dvec3& n = meetings_.back().normal;
            for (const int i : {a, b}) {
                normals[size_t(i)] += glm::outerProduct(n, n);
                ++number_[size_t(i)];
            }
        }
        for (size_t c = 0; c < contacts.size(); ++c)
            meetings_[c].share = 1 / std::max(effectiveCount(normals[size_t(contacts[c].first)]),
                                              effectiveCount(normals[size_t(contacts[c].second)]));
    }

    void run() {
        begin();
        std::vector<glm::dvec3> earlierImpulse = impulse_;
        std::vector<double> earlier = pushed_;
        for (int i = 0; i < settings_.iterations; ++i) {
            const double momentum = i == 0 ? 0 : double(i) / (i + 3);
            const std::vector<glm::dvec3> last = impulse_;
            const std::vector<double> lastPushed = pushed_;
            for (size_t k = 0; k < impulse_.size(); ++k)
                impulse_[k] += momentum * (last[k] - earlierImpulse[k]);
            for (size_t c = 0; c < pushed_.size(); ++c)
                pushed_[c] += momentum * (lastPushed[c] - earlier[c]);
            relax();
            earlierImpulse = last;
            earlier = lastPushed;
        }
        addFriction();
    }

  private:
    // A rest's push apart, in kg m.
    double push(size_t c) const {
        const Meeting& m = meetings_[c];
        return m.impact || m.weight == 0 ? 0 : m.share * m.depth / m.weight;
    }

    void exchange(std::vector<glm::dvec3>& sums, size_t c, const glm::dvec3& amount) const {
        sums[size_t((*contacts_)[c].first)] += amount;
        sums[size_t((*contacts_)[c].second)] -= amount;
    }

    glm::dvec3 velocity(int i, const std::vector<glm::dvec3>& sums) const {
        const Sphere& sphere = (*spheres_)[size_t(i)];
        return sphere.velocity + sphere.weight * sums[size_t(i)];
    }

    glm::dvec3 relative(size_t c, const std::vector<glm::dvec3>& sums) const {
        return velocity((*contacts_)[c].first, sums) - velocity((*contacts_)[c].second, sums);
    }

    void begin() {
        for (size_t c = 0; c < meetings_.size(); ++c) {
            pushed_.push_back(push(c) / settings_.stepTime);
            exchange(impulse_, c, pushed_[c] * meetings_[c].normal);
        }
    }

    void relax() {
        const std::vector<glm::dvec3> before = impulse_;
        for (size_t c = 0; c < meetings_.size(); ++c) {
            const Meeting& m = meetings_[c];
            if (m.weight == 0) continue;
            const double speed = glm::dot(relative(c, before), m.normal);
            const double change = std::max(m.share * (m.target - speed) / m.weight, -pushed_[c]);
            pushed_[c] += change;
            exchange(impulse_, c, change * m.normal);
        }
    }

    void addFriction() {
        constexpr int rounds = 4;
        std::vector<glm::dvec3> before, bounce, rest;
        for (int round = 0; round < rounds; ++round) {
            before = impulse_;
            bounce.assign(impulse_.size(), glm::dvec3(0));
            rest = bounce;
            for (size_t c = 0; c < meetings_.size(); ++c) {
                const Meeting& m = meetings_[c];
                if (m.weight == 0) continue;
                const glm::dvec3 u = relative(c, before);
                const glm::dvec3 along = u - glm::dot(u, m.normal) * m.normal;
                const double slip = glm::length(along);
                // the wall that may be there counts as one more
                const int number = 1 + std::max(number_[size_t((*contacts_)[c].first)],
                                                number_[size_t((*contacts_)[c].second)]);
                const bool alone = m.share > 0.995;  // effectiveCount both is 1
                const glm::dvec3 push = pushed_[c] * m.normal;
                const double spent = glm::length(before[size_t((*contacts_)[c].first)] - push);
                const double grip =
                    alone
                        ? std::min(std::max(settings_.friction * pushed_[c] - spent, 0.0), slip / m.weight)
                        : std::min(settings_.friction * pushed_[c] / rounds, 1.5 * slip / m.weight / number);
                const glm::dvec3 change = slip > 0 ? along * (-grip / slip) : glm::dvec3(0);
                exchange(impulse_, c, change);
                const glm::dvec3 whole = alone ? before[size_t((*contacts_)[c].first)] : push;
                if (m.impact) exchange(bounce, c, (whole + change) * m.since);
                exchange(rest, c, this->push(c) * m.normal);
            }
        }
        addCorrection(before, rest);
        for (size_t i = 0; i < spheres_->size(); ++i) {
            Sphere& sphere = (*spheres_)[i];
            sphere.velocity += sphere.weight * impulse_[i];
            sphere.position += sphere.weight * (bounce[i] + rest[i]);
        }
    }

    void addCorrection(const std::vector<glm::dvec3>& before, const std::vector<glm::dvec3>& rest) {
        std::vector<double> kept(rest.size());
        for (size_t i = 0; i < rest.size(); ++i) {
            const glm::dvec3 change = (*spheres_)[i].weight * rest[i] / settings_.stepTime;
            const double square = glm::dot(change, change);
            if (square > 0)
                kept[i] = std::clamp(-glm::dot(velocity(int(i), before), change) / square, 0.0, 1.0);
        }
        for (size_t c = 0; c < meetings_.size(); ++c) {
            const double part =
                std::min(kept[size_t((*contacts_)[c].first)], kept[size_t((*contacts_)[c].second)]);
            exchange(impulse_, c, push(c) / settings_.stepTime * part * meetings_[c].normal);
        }
    }

    std::vector<Sphere>* spheres_;
    const Contacts* contacts_;
    SphereResponse settings_;
    std::vector<Meeting> meetings_;
    std::vector<double> pushed_;  // N s
    std::vector<glm::dvec3> impulse_;
    std::vector<int> number_;
};

}  // namespace

void respond(std::vector<Sphere>& spheres, const Contacts& contacts, const SphereResponse& settings) {
    Response(spheres, contacts, settings).run();
}

}  // namespace shoal::reference
