#include "bench/contact_baseline.h"

#include <algorithm>
#include <cmath>

#include "bench/contact_baseline_grid.h"
#include "bench/contact_baseline_impacts.h"
#include "compile/contact_plan.h"

namespace shoal::bench {

using glm::vec3;

namespace {

constexpr float frictionStep = 0.4f;  // shaders/physics/pair.glsl

// A contact with another slot, in the list of the slot that it acts on.
struct Contact {
    int other = 0;           // slot
    vec3 normal{0};          // from the other
    float target = 0;        // m/s, along the normal afterwards
    float lacks = 0;         // m, by which the two are to be pushed apart
    float stepAlong = 0;     // kg, of an iteration: of an impulse along the normal,
    float stepAcross = 0;    // and across it; both 1/mass of the two until their counts are known
    vec3 impulse{0};         // N s, so far
    vec3 earlier{0};         // and an iteration before
    float apart = 0;         // kg m, by which they are pushed apart, so far
    float earlierApart = 0;  // and an iteration before
    bool sticks = false;     // friction holds all that it was asked to
    bool takesPart = false;  // it is more than listed
    int bounces = 0;         // steps up to this with an impact
    float mass = 0;          // kg, that both together put against an impulse, as their contacts share it
    float held = 0;          // N s, what it remembers
    vec3 anchor{0};          // m, from the other's centre where they began to stick
};

// A contact leaves this for the next step.
struct Kept {
    int other;    // sphere
    bool sticks;  // the rest as of Contact
    vec3 impulse;
    vec3 anchor;
    float apart;
    int bounces;
};

// A sphere's contacts leave this for the next step.
struct Memory {
    uint32_t step = 0;  // that left it: nothing is remembered for longer
    int piece = 0, begin = 0, end = 0;
    vec3 load{0};  // N s, all impulses
};

// A sphere as the impulses make it move.
struct Going {
    vec3 velocity;  // m/s
    vec3 move;      // m
};

struct Active {
    int slot, begin, end;  // of the thread's contacts
    vec3 acted;            // N s, what is remembered, which has acted as a force since the last step
    vec3 total;            // N s, of the impulses, without what has acted
    vec3 shift;            // kg m, of what pushes apart
};

// The part of one thread: what it found among its slots, and works on.
struct Piece {
    std::vector<int> found;         // slots that others touch, those of one behind one another
    std::vector<Contact> contacts;  // with them
    std::vector<Active> active;
    std::vector<Kept> kept;
    float residual = 0;  // of the last iteration
};

}  // namespace

struct ContactBaseline::Data {
    Data(std::vector<float> given, int count, float r, int threadCount)
        : weights(std::move(given)),
          spheres(size_t(count) * weights.size()),
          reach(2 * r),
          threads(threadCount),
          grid(int(weights.size()), count, float(ContactPlan::near) * reach, threads),
          pieces(size_t(threadCount)),
          memory(spheres),
          impacts(spheres, reach),
          counts(spheres),
          going(spheres),
          newGoing(spheres) {}

    std::vector<float> weights;
    size_t spheres;
    float reach;  // m
    PinnedThreads threads;
    SphereGrid grid;
    std::vector<Piece> pieces;

    GroupState state;
    uint32_t number = 1;         // of the step
    std::vector<Memory> memory;  // by sphere
    ContactImpacts impacts;
    // By slot, set where it takes part.
    std::vector<float> counts;  // of contacts, as they act on it together
    std::vector<Going> going, newGoing;

    template <typename Work>
    void each(Work work) {
        threads.run([this, &work](int thread) { work(thread, pieces[size_t(thread)]); });
    }

    // Returns what the last step has left of a sphere.
    Memory remembered(size_t sphere) const {
        const Memory& known = memory[sphere];
        return known.step + 1 == number ? known : Memory();
    }

    void find(int thread, Piece& piece) {
        piece.found.clear();
        piece.active.clear();
        const auto [first, last] = threads.part(spheres, thread);
        for (size_t slot = first; slot < last; ++slot) {
            const int begin = int(piece.found.size());
            grid.look(int(slot), piece.found);
            const int end = int(piece.found.size());
            const auto sphere = size_t(grid.sphereOf(int(slot)));
            const Memory known = remembered(sphere);
            // what is remembered has to be taken back, even where nothing is touched any more
            if (begin == end && known.begin == known.end) continue;
            piece.active.push_back({int(slot), begin, end, known.load, vec3(0), vec3(0)});
            impacts.spheres[slot] = {grid.position(int(slot)), state.velocities[sphere],
                                     weights[sphere % weights.size()]};
        }
        piece.contacts.resize(piece.found.size());
    }

    void beginImpacts(Piece& piece, float stepTime) {
        for (const Active& active : piece.active)
            impacts.begin(active.slot, grid.sphereOf(active.slot),
                          {&piece.found[0] + active.begin, size_t(active.end - active.begin)}, stepTime);
    }

    void choose(Piece& piece, uint32_t round, float restSpeed) {
        for (const Active& active : piece.active) {
            const auto sphere = size_t(grid.sphereOf(active.slot));
            impacts.choose(active.slot, round, restSpeed, [&](int other, bool struck) {
                return isClosed(keptOf(remembered(sphere), grid.sphereOf(other)), struck);
            });
        }
    }

    static bool isClosed(const Kept* known, bool struck) {
        return known && (known->impulse != vec3(0) || (known->bounces > 1 && !struck));
    }

    const Kept* keptOf(const Memory& known, int other) const {
        const std::vector<Kept>& kept = pieces[size_t(known.piece)].kept;
        for (int k = known.begin; k < known.end; ++k)
            if (kept[size_t(k)].other == other) return &kept[size_t(k)];
        return nullptr;
    }

    Contact contactOf(int slot, int other, const Memory& memoryOfOwn, const ContactBaselineStep& step) const {
        const auto a = size_t(slot), b = size_t(other);
        Contact out;
        out.other = other;
        const Kept* known = keptOf(memoryOfOwn, grid.sphereOf(other));
        const BaselineSphere &own = impacts.spheres[a], &theirs = impacts.spheres[b];
        const vec3 d = own.place - theirs.place;
        const float distance = glm::length(d);
        out.normal = distance > 1e-6f * reach ? d / distance : vec3(0, slot < other ? 1.0f : -1.0f, 0);
        out.anchor = d;
        out.lacks = reach - distance;
        out.stepAlong = own.weight;
        out.stepAcross = theirs.weight;
        const float speed = -glm::dot(out.normal, own.velocity - theirs.velocity);
        const bool waits = !isClosed(known, impacts.isStruck(slot, other)) && speed > step.restSpeed &&
                           (out.lacks <= 0 || speed * step.restitution > step.restSpeed);
        out.takesPart = !waits && out.stepAlong + out.stepAcross > 0;
        if (!out.takesPart) return out;
        if (impacts.hasHit(slot, other)) out.bounces = known ? known->bounces + 1 : 1;
        const bool deep = out.lacks > 0.25f * reach;
        if (known && (known->sticks || deep)) out.anchor = known->anchor;
        vec3 slip = d - out.anchor;
        slip -= out.normal * glm::dot(slip, out.normal);
        const float far = glm::length(slip);
        if (!deep && far > 0.005f * reach)
            out.anchor += slip * (1 - 0.005f * reach / far);  // what is further has slid
        if (const float length = glm::length(out.anchor); deep && length > 1e-6f * reach) {
            out.normal = out.anchor / length;
            out.lacks = reach - glm::dot(d, out.normal);
        }
        if (known) out.impulse = withinFriction(known->impulse, out.normal, step.friction, out.sticks);
        if (known && out.lacks > 0) out.apart = out.earlierApart = 0.7f * known->apart;
        out.earlier = out.impulse;
        out.held = glm::length(out.impulse);
        const float open = std::min(out.lacks, 0.0f);
        out.lacks -= 0.005f * reach;  // so much may rest as it is
        const float much = out.held > 0 ? std::clamp(0.1f * out.lacks, 0.0f, 0.1f * step.stepTime) : 0;
        out.target = (open + much) / step.stepTime;
        out.lacks = std::min(out.lacks, step.stepTime);  // at 1 m/s
        return out;
    }

    void prepare(Piece& piece, const ContactBaselineStep& step) {
        for (Active& active : piece.active) {
            const auto slot = size_t(active.slot);
            const Memory known = remembered(size_t(grid.sphereOf(active.slot)));
            glm::mat3 sum(0);
            int acting = 0;
            active.total = -active.acted;
            for (int c = active.begin; c < active.end; ++c) {
                Contact& contact = piece.contacts[size_t(c)];
                contact = contactOf(active.slot, piece.found[size_t(c)], known, step);
                active.total += contact.impulse;
                active.shift += contact.normal * contact.apart;
                if (!contact.takesPart) continue;
                const glm::mat3 along = glm::outerProduct(contact.normal, contact.normal);
                if (impacts.spheres[slot].weight > 0) sum += along + frictionStep * (glm::mat3(1) - along);
                ++acting;
            }
            counts[slot] = acting < 2 ? 1 : countOf(sum);
            going[slot] = {impacts.spheres[slot].velocity + active.total * impacts.spheres[slot].weight,
                           active.shift * impacts.spheres[slot].weight};
        }
    }

    // Returns a bound of the largest eigenvalue: the eighth root of the trace of the eighth power, of which
    // the fourth is symmetric.
    static float countOf(const glm::mat3& sum) {
        const glm::mat3 squared = sum * sum, fourth = squared * squared;
        float trace = 0;
        for (int i = 0; i < 3; ++i)
            trace += glm::dot(fourth[i], fourth[i]);
        return std::max(std::sqrt(std::sqrt(std::sqrt(trace))), 1.01f);
    }

    void share(Piece& piece) {
        for (const Active& active : piece.active) {
            const float own = counts[size_t(active.slot)];
            for (int c = active.begin; c < active.end; ++c) {
                Contact& contact = piece.contacts[size_t(c)];
                const float other = counts[size_t(contact.other)];
                const float weight = contact.stepAlong * own + contact.stepAcross * other;
                const bool alone = std::max(own, other) < 1.003f;
                contact.mass = contact.takesPart ? 1 / weight : 0;
                contact.stepAlong = contact.mass * (alone ? 1 : 1.3f);
                contact.stepAcross = contact.mass * (alone ? 1 : 1.3f * frictionStep);
            }
        }
    }

    // Does an iteration, from the impulses of the last two, extrapolated by `momentum`. The spheres' motion
    // is extrapolated by `nextMomentum`, for the next iteration.
    // Leaves the residual of what it answers (shaders/contact/response/iteration.glsl).
    void relax(Piece& piece, const ContactBaselineStep& step, float momentum, float nextMomentum) {
        piece.residual = 0;
        for (Active& active : piece.active) {
            const Going own = going[size_t(active.slot)];
            vec3 total = -active.acted, shift(0);
            for (int c = active.begin; c < active.end; ++c) {
                Contact& contact = piece.contacts[size_t(c)];
                const vec3 n = contact.normal;
                const Going& other = going[size_t(contact.other)];
                const vec3 u = own.velocity - other.velocity;
                const float along = glm::dot(u, n);
                const vec3 ahead = contact.impulse + (contact.impulse - contact.earlier) * momentum;
                const vec3 wanted = ahead + n * ((contact.target - along) * contact.stepAlong) -
                                    (u - n * along) * contact.stepAcross;
                const float lacks = contact.lacks - glm::dot(own.move - other.move, n);
                const float apart = contact.apart + (contact.apart - contact.earlierApart) * momentum;
                contact.earlier = contact.impulse;
                contact.earlierApart = contact.apart;
                contact.impulse = withinFriction(wanted, n, step.friction, contact.sticks);
                contact.apart = std::max(apart + lacks * contact.stepAlong, 0.0f);
                if (contact.takesPart) {
                    const vec3 change = contact.impulse - ahead;
                    const float pushed = glm::dot(change, n);
                    const float speed = std::max(std::abs(pushed) / contact.stepAlong,
                                                 glm::length(change - n * pushed) / contact.stepAcross);
                    const float move = std::abs(contact.apart - apart) / contact.stepAlong;
                    piece.residual = std::max(
                        {piece.residual, speed / std::max(step.restSpeed, 1e-20f), 2 * move / reach});
                }
                total += contact.impulse;
                shift += n * contact.apart;
            }
            const BaselineSphere& motion = impacts.spheres[size_t(active.slot)];
            newGoing[size_t(active.slot)] = {
                motion.velocity + (total + (total - active.total) * nextMomentum) * motion.weight,
                (shift + (shift - active.shift) * nextMomentum) * motion.weight};
            active.total = total;
            active.shift = shift;
        }
    }

    // Moves the spheres and keeps what their contacts remember.
    void apply(int thread, Piece& piece, const ContactBaselineStep& step) {
        piece.kept.clear();
        for (const Active& active : piece.active) {
            const auto slot = size_t(active.slot), sphere = size_t(grid.sphereOf(active.slot));
            Memory& known = memory[sphere];
            known = {number, thread, int(piece.kept.size()), 0, vec3(0)};
            vec3 shift = active.shift;
            for (int c = active.begin; c < active.end; ++c) {
                const Contact& contact = piece.contacts[size_t(c)];
                if (!contact.takesPart) continue;
                shift += settle(active.slot, contact);
                piece.kept.push_back(keptOf(active.slot, contact, step.restSpeed));
            }
            known.end = int(piece.kept.size());
            const float weight = impacts.spheres[slot].weight;
            if (active.begin < active.end) known.load = actsNext(active, weight, step.restSpeed);
            shift *=
                std::min(1.0f, step.stepTime / std::max(glm::length(shift) * weight, 1e-30f));  // at 1 m/s
            state.velocities[sphere] += (active.total + impacts.impulse(active.slot) + known.load) * weight;
            state.positions[sphere] += (shift + impacts.shift(active.slot)) * weight;
        }
    }

    // Returns what acts on a sphere over the next step, N s: what has acted, with a tenth of what was
    // missing, and not much more than a weight.
    static vec3 actsNext(const Active& active, float weight, float restSpeed) {
        const vec3 next = active.acted + active.total * 0.1f;
        const float most = 1.5f * glm::length(active.acted) + restSpeed / std::max(weight, 1e-30f);
        return next * std::min(1.0f, most / std::max(glm::length(next), 1e-30f));
    }

    // Returns how far a contact moves the sphere beside what pushes it apart, kg m.
    vec3 settle(int slot, const Contact& contact) const {
        if (!contact.sticks) return vec3(0);
        vec3 slip = impacts.spheres[size_t(slot)].place - impacts.spheres[size_t(contact.other)].place -
                    contact.anchor;
        slip -= contact.normal * glm::dot(slip, contact.normal);
        return slip * (-contact.mass * std::min(1.0f, 0.002f * reach / std::max(glm::length(slip), 1e-30f)));
    }

    Kept keptOf(int slot, const Contact& contact, float restSpeed) const {
        const int other = grid.sphereOf(contact.other);
        if (contact.bounces > 0)
            return {other, false, vec3(0), contact.anchor, contact.apart, contact.bounces};
        // memory takes in a tenth of what an impulse has grown by, and not much more than a weight
        const float weight =
            impacts.spheres[size_t(slot)].weight + impacts.spheres[size_t(contact.other)].weight;
        const float magnitude = glm::length(contact.impulse),
                    grown = std::max(magnitude - contact.held, 0.0f);
        const float most = std::min(contact.held + 0.1f * grown, 1.5f * contact.held + restSpeed / weight);
        return {other,
                contact.sticks,
                contact.impulse * std::min(1.0f, most / std::max(magnitude, 1e-30f)),
                contact.anchor,
                contact.apart,
                0};
    }
};

ContactBaseline::ContactBaseline(std::vector<float> weights, int molecules, float radius, int threads)
    : data_(std::make_unique<Data>(std::move(weights), molecules, radius, threads)) {}
ContactBaseline::~ContactBaseline() = default;

void ContactBaseline::set(const GroupState& state) {
    data_->state = state;
    ++data_->number;  // what the step before has left is not of this state
}

void ContactBaseline::get(GroupState& state) const {
    state.positions = data_->state.positions;
    state.velocities = data_->state.velocities;
}

void ContactBaseline::step(const ContactBaselineStep& step) {
    Data& data = *data_;
    data.grid.build(data.state);
    data.each([&](int thread, Piece& piece) { data.find(thread, piece); });
    data.each([&](int, Piece& piece) { data.beginImpacts(piece, step.stepTime); });
    const int rounds = std::min(step.iterations, ContactPlan::mostRounds);
    for (uint32_t round = 1; round <= uint32_t(rounds); ++round) {
        data.each([&](int, Piece& piece) { data.choose(piece, round, step.restSpeed); });
        data.each([&](int, Piece& piece) {
            for (const Active& active : piece.active)
                data.impacts.strike(active.slot, round, step);
        });
    }
    data.each([&](int, Piece& piece) { data.prepare(piece, step); });
    data.each([&](int, Piece& piece) { data.share(piece); });
    const auto momentum = [&step](int i) {
        return i < step.iterations ? ContactPlan::momentum(i, step.iterations, step.unlikeMasses) : 0;
    };
    for (int i = 0; i < step.iterations; ++i) {
        data.each([&](int, Piece& piece) { data.relax(piece, step, momentum(i), momentum(i + 1)); });
        data.going.swap(data.newGoing);
        const auto isDone = [&](const Piece& piece) { return piece.residual <= step.tolerance; };
        const bool endsBatch = i > 0 && (step.iterations - i) % 2 == 1;
        if (endsBatch && std::all_of(data.pieces.begin(), data.pieces.end(), isDone)) break;
    }
    data.each([&](int thread, Piece& piece) { data.apply(thread, piece, step); });
    ++data.number;
}

std::vector<std::pair<int, int>> ContactBaseline::found() const {
    std::vector<std::pair<int, int>> out;
    for (const Piece& piece : data_->pieces) {
        for (const Active& active : piece.active) {
            const int own = data_->grid.sphereOf(active.slot);
            for (int c = active.begin; c < active.end; ++c) {
                const int other = data_->grid.sphereOf(piece.found[size_t(c)]);
                if (own < other) out.emplace_back(own, other);
            }
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace shoal::bench
