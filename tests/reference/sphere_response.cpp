#include "reference/sphere_response.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace shoal::reference {

namespace {

using glm::dmat3;
using glm::dvec3;

// The unknowns of one contact.
struct Answer {
    dvec3 impulse{0};  // N s, on the first sphere
    double apart = 0;  // kg m, by which the two are pushed apart
};

struct Meeting {
    size_t a = 0, b = 0;
    double reach = 0;       // m
    dvec3 between{0};       // m, from b to a
    dvec3 normal{0, 1, 0};  // from b to a
    double depth = 0;       // m
    double speed = 0;       // m/s, along the normal
    bool struck = false;    // they had an impact in this step
    int bounces = 0;        // steps in which they had one, without one between
    bool takesPart = true;  // else it is listed and does nothing
    dvec3 anchor{0};        // m
    double held = 0;        // N s, what it remembers of the last step
    double weight = 0;      // 1/kg, of both spheres, each times the contacts that share it
    bool alone = false;     // neither sphere has another contact
    bool sticks = false;    // friction can hold all that it was asked to
    Answer now, before;     // after this iteration and the last
};

// An impulse within Coulomb's cone about the normal.
dvec3 withinCone(const dvec3& impulse, const dvec3& normal, double friction) {
    const double along = glm::dot(impulse, normal);
    if (along <= 0) return dvec3(0);
    const dvec3 across = impulse - along * normal;
    const double grip = glm::length(across);
    return grip <= friction * along ? impulse : along * normal + across * (friction * along / grip);
}

// The next impact of two spheres.
struct Impact {
    size_t contact = 0, a = 0, b = 0;
    double since = -1;  // s, since then
    double speed = 0;   // m/s, along the normal
    dvec3 normal{0, 1, 0};

    bool isBefore(const Impact& other) const {
        return std::tuple(-since, speed, a, b) < std::tuple(-other.since, other.speed, other.a, other.b);
    }
};

constexpr double ofFriction =
    0.4;  // how far an iteration answers slip, as a part of how far it answers the rest

// Among how many contacts a sphere is shared: a bound of the largest eigenvalue of the sum of
// n n^T + ofFriction (1 - n n^T) of them, the eighth root of the trace of its eighth power.
double sharedBy(const dmat3& sum, int number) {
    const dmat3 fourth = sum * sum * sum * sum, eighth = fourth * fourth;
    const double bound = std::pow(eighth[0][0] + eighth[1][1] + eighth[2][2], 1.0 / 8);
    return number < 2 ? 1 : std::max(bound, 1.01);
}

double momentum(int iteration, int iterations) {
    if (iteration == 0) return 0;
    return std::max(std::min(0.8, 1 - 1.6 / iterations), 0.0);
}

class Response {
  public:
    Response(std::vector<Sphere>& spheres, const SphereResponse& settings, ContactMemory& memory)
        : spheres_(&spheres), settings_(settings), memory_(&memory) {
        memory.loads.resize(spheres.size(), dvec3(0));
    }

    void run(const std::vector<std::pair<int, int>>& contacts) {
        for (const auto& [a, b] : contacts) {
            Meeting& m = meetings_.emplace_back();
            m.a = size_t(a);
            m.b = size_t(b);
            m.reach = sphere(m.a).radius + sphere(m.b).radius;
        }
        straight_.assign(spheres_->size(), settings_.stepTime);
        last_.assign(spheres_->size(), -1);
        for (int round = 0; round < std::min(settings_.iterations, 4); ++round)
            strike();
        for (Meeting& m : meetings_)
            prepare(m);
        share();
        for (int i = 0; i < settings_.iterations; ++i)
            relax(momentum(i, settings_.iterations));
        std::vector<dvec3> impulses = gather([](const Meeting& m) { return m.now.impulse; });
        const std::vector<dvec3> shifts = gather([this](const Meeting& m) { return shift(m); });
        for (size_t i = 0; i < spheres_->size(); ++i) {
            Sphere& sphere = (*spheres_)[i];
            sphere.velocity += sphere.weight * (impulses[i] - memory_->loads[i]);
            const dvec3 moved = sphere.weight * shifts[i];
            sphere.position +=
                moved * std::min(1.0, fastest * settings_.stepTime / (glm::length(moved) + 1e-30));
        }
        remember();
    }

  private:
    const Sphere& sphere(size_t i) const { return (*spheres_)[i]; }

    // Returns the sums over each sphere's contacts: `of` acts on the first sphere of a contact, and its
    // opposite on the second.
    template <typename Of>
    std::vector<dvec3> gather(Of of) const {
        std::vector<dvec3> out(spheres_->size(), dvec3(0));
        for (const Meeting& m : meetings_) {
            if (!m.takesPart) continue;
            out[m.a] += of(m);
            out[m.b] -= of(m);
        }
        return out;
    }

    bool isStruck(const Meeting& m) const { return last_[m.a] >= 0 || last_[m.b] >= 0; }

    const ContactMemory::Entry* known(const Meeting& m) const {
        const auto found = memory_->contacts.find({int(m.a), int(m.b)});
        return found == memory_->contacts.end() ? nullptr : &found->second;
    }

    // Whether they touch and have no impact, however fast they approach.
    bool isClosed(const Meeting& m) const {
        const ContactMemory::Entry* entry = known(m);
        if (!entry) return false;
        return entry->impulse != dvec3(0) || (entry->bounces > 1 && !isStruck(m));
    }

    // Whether nothing has moved the two since their impact.
    bool haveMet(size_t contact) const {
        const Meeting& m = meetings_[contact];
        const auto wasLast = [&](size_t s) { return sphere(s).weight <= 0 || last_[s] == int(contact); };
        return wasLast(m.a) && wasLast(m.b);
    }

    Impact impactOf(size_t contact) const {
        const Meeting& m = meetings_[contact];
        const Sphere &a = sphere(m.a), &b = sphere(m.b);
        Impact out{contact, m.a, m.b};
        if (a.weight + b.weight <= 0 || isClosed(m) || haveMet(contact)) return out;
        const double time = std::min(straight_[m.a], straight_[m.b]);
        const dvec3 u = a.velocity - b.velocity, start = a.position - b.position - u * time;
        const double p = glm::dot(start, u), gap = glm::dot(start, start) - m.reach * m.reach;
        const double under = p * p - glm::dot(u, u) * gap;
        if (p >= 0 || under <= 0) return out;
        const double wait = std::max(gap, 0.0) / (std::sqrt(under) - p);  // 0 where they overlap by then
        out.normal = glm::normalize(start + u * wait);
        out.speed = glm::dot(out.normal, u);
        if (wait <= time && out.speed < -settings_.restSpeed) out.since = time - wait;
        return out;
    }

    // The earliest impact of each sphere counts, where it is that of the other as well.
    void strike() {
        std::vector<Impact> earliest(spheres_->size());
        for (size_t i = 0; i < meetings_.size(); ++i) {
            const Impact impact = impactOf(i);
            for (const size_t s : {impact.a, impact.b})
                if (impact.since >= 0 && (earliest[s].since < 0 || impact.isBefore(earliest[s])))
                    earliest[s] = impact;
        }
        for (size_t s = 0; s < earliest.size(); ++s) {
            const Impact& impact = earliest[s];
            if (impact.since < 0 || sphere(s).weight <= 0) continue;
            const size_t other = impact.a == s ? impact.b : impact.a;
            const bool agrees = sphere(other).weight <= 0 || earliest[other].contact == impact.contact;
            if (agrees && (s == impact.a || sphere(other).weight <= 0)) strike(impact);
        }
    }

    void strike(const Impact& impact) {
        Meeting& m = meetings_[impact.contact];
        Sphere &a = (*spheres_)[m.a], &b = (*spheres_)[m.b];
        const dvec3 u = a.velocity - b.velocity;
        const dvec3 wanted = (-(1 + settings_.restitution) * impact.speed * impact.normal -
                              (u - impact.speed * impact.normal)) /
                             (a.weight + b.weight);
        const dvec3 impulse = withinCone(wanted, impact.normal, settings_.friction);
        a.velocity += impulse * a.weight;
        b.velocity -= impulse * b.weight;
        a.position += impulse * a.weight * impact.since;
        b.position -= impulse * b.weight * impact.since;
        if (a.weight > 0) straight_[m.a] = impact.since;
        if (b.weight > 0) straight_[m.b] = impact.since;
        for (const size_t s : {m.a, m.b})
            if (sphere(s).weight > 0) last_[s] = int(impact.contact);
        m.struck = true;
    }

    void prepare(Meeting& m) {
        const Sphere &a = sphere(m.a), &b = sphere(m.b);
        m.between = a.position - b.position;
        const double distance = glm::length(m.between);
        m.depth = m.reach - distance;
        if (distance > 1e-6 * m.reach) m.normal = m.between / distance;
        m.speed = glm::dot(m.normal, a.velocity - b.velocity);
        // what has not touched yet and comes fast will be an impact, and so will what the rounds have left
        // over
        const bool waits = !isClosed(m) && -m.speed > settings_.restSpeed &&
                           (m.depth <= 0 || -m.speed * settings_.restitution > settings_.restSpeed);
        m.takesPart = !waits && a.weight + b.weight > 0;
        if (!m.takesPart) return;
        // where they are deep in one another, they leave as they came in
        const ContactMemory::Entry* entry = known(m);
        const bool deep = m.depth > 0.25 * m.reach;
        m.anchor = entry && (entry->sticks || deep) ? entry->anchor : m.between;
        dvec3 slip = m.between - m.anchor;
        slip -= m.normal * glm::dot(slip, m.normal);
        const double far = glm::length(slip);
        if (!deep && far > 0.005 * m.reach) m.anchor += slip * (1 - 0.005 * m.reach / far);  // slid
        if (deep && glm::length(m.anchor) > 0) {
            m.normal = glm::normalize(m.anchor);
            m.depth = m.reach - glm::dot(m.between, m.normal);
        }
        if (m.struck) m.bounces = entry ? entry->bounces + 1 : 1;
        if (entry) m.now.impulse = withinCone(entry->impulse, m.normal, settings_.friction);
        if (entry && m.depth > 0) m.now.apart = 0.7 * entry->apart;
        m.held = glm::length(m.now.impulse);
    }

    void share() {
        std::vector<dmat3> sums(spheres_->size(), dmat3(0));
        std::vector<int> numbers(spheres_->size(), 0);
        for (const Meeting& m : meetings_) {
            if (!m.takesPart) continue;
            const dmat3 along = glm::outerProduct(m.normal, m.normal);
            for (const size_t i : {m.a, m.b}) {
                if (sphere(i).weight > 0) sums[i] += along + ofFriction * (dmat3(1) - along);
                ++numbers[i];
            }
        }
        for (Meeting& m : meetings_) {
            const double a = sharedBy(sums[m.a], numbers[m.a]), b = sharedBy(sums[m.b], numbers[m.b]);
            m.weight = sphere(m.a).weight * a + sphere(m.b).weight * b;
            m.alone = std::max(a, b) < 1.003;
        }
    }

    static constexpr double fastest = 1;  // m/s, at which what overlaps is pushed apart

    // m, of what overlaps beyond what may rest so: half a percent.
    static double tooDeep(const Meeting& m) { return m.depth - 0.005 * m.reach; }

    // m/s, that a contact is to have along its normal.
    double target(const Meeting& m) const {
        // it may close what is open, and what carries something lets go a tenth of what overlaps too much
        const double much = m.held > 0 ? 0.1 * tooDeep(m) : 0;
        return std::min(m.depth, 0.0) / settings_.stepTime + std::clamp(much / settings_.stepTime, 0.0, 0.1);
    }

    void relax(double momentum) {
        for (Meeting& m : meetings_) {
            const Answer last = m.now;
            m.now.impulse += momentum * (last.impulse - m.before.impulse);
            m.now.apart += momentum * (last.apart - m.before.apart);
            m.before = last;
        }
        std::vector<dvec3> velocities = gather([](const Meeting& m) { return m.now.impulse; });
        std::vector<dvec3> moves = gather([](const Meeting& m) { return m.now.apart * m.normal; });
        for (size_t i = 0; i < spheres_->size(); ++i) {
            velocities[i] = sphere(i).velocity + sphere(i).weight * (velocities[i] - memory_->loads[i]);
            moves[i] *= sphere(i).weight;
        }
        for (Meeting& m : meetings_)
            if (m.takesPart) improve(m, velocities[m.a] - velocities[m.b], moves[m.a] - moves[m.b]);
    }

    // u, moved: m/s and m, of the first sphere relative to the second, as all contacts make it.
    void improve(Meeting& m, const dvec3& u, const dvec3& moved) const {
        constexpr double larger = 1.3;
        const double along = glm::dot(u, m.normal);
        const double normalStep = m.alone ? 1 : larger, acrossStep = m.alone ? 1 : larger * ofFriction;
        const dvec3 wanted = m.now.impulse + m.normal * (target(m) - along) * (normalStep / m.weight) -
                             (u - along * m.normal) * (acrossStep / m.weight);
        m.now.impulse = withinCone(wanted, m.normal, settings_.friction);
        m.sticks = m.now.impulse == wanted;
        const double lacks = std::min(tooDeep(m), fastest * settings_.stepTime) - glm::dot(moved, m.normal);
        m.now.apart = std::max(m.now.apart + lacks * normalStep / m.weight, 0.0);
    }

    // How far a contact moves its spheres, kg m.
    dvec3 shift(const Meeting& m) const {
        dvec3 out = m.now.apart * m.normal;
        dvec3 slip = m.between - m.anchor;
        slip -= glm::dot(slip, m.normal) * m.normal;
        const double length = glm::length(slip), most = 0.002 * m.reach;
        if (m.sticks && length > 0) out -= slip * (std::min(1.0, most / length) / m.weight);
        return out;
    }

    void remember() {
        memory_->contacts.clear();
        for (const Meeting& m : meetings_) {
            if (!m.takesPart) continue;
            ContactMemory::Entry& entry = memory_->contacts[{int(m.a), int(m.b)}] = {
                dvec3(0), m.anchor, m.sticks && !m.struck, m.now.apart, m.bounces};
            const double length = glm::length(m.now.impulse);
            if (m.struck || length == 0) continue;
            // Memory takes in a tenth of what an impulse has grown by, and not much more than a weight.
            const double weight = sphere(m.a).weight + sphere(m.b).weight;
            const double most = std::min(m.held + 0.1 * std::max(length - m.held, 0.0),
                                         1.5 * m.held + settings_.restSpeed / weight);
            entry.impulse = m.now.impulse * std::min(1.0, most / length);
        }
        const std::vector<dvec3> sums = gather([](const Meeting& m) { return m.now.impulse; });
        std::vector<bool> touches(sums.size(), false);
        for (const Meeting& m : meetings_)
            touches[m.a] = touches[m.b] = true;
        for (size_t i = 0; i < sums.size(); ++i) {
            const dvec3 acted = memory_->loads[i], next = acted + 0.1 * (sums[i] - acted);
            const double most =
                1.5 * glm::length(acted) + settings_.restSpeed / std::max(sphere(i).weight, 1e-30);
            memory_->loads[i] =
                touches[i] ? next * std::min(1.0, most / (glm::length(next) + 1e-30)) : dvec3(0);
        }
    }

    std::vector<Sphere>* spheres_;
    SphereResponse settings_;
    ContactMemory* memory_;
    std::vector<Meeting> meetings_;
    std::vector<int> last_;         // the contact of each sphere's last impact
    std::vector<double> straight_;  // s, for how long each sphere has moved straight
};

}  // namespace

void respond(std::vector<Sphere>& spheres, const std::vector<std::pair<int, int>>& contacts,
             const SphereResponse& settings, ContactMemory& memory) {
    Response(spheres, settings, memory).run(contacts);
}

}  // namespace shoal::reference
