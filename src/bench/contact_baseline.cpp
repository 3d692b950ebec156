#include "bench/contact_baseline.h"

#include <algorithm>
#include <cmath>

#include "bench/baseline_threads.h"
#include "compile/contact_plan.h"

namespace shoal::bench {

using glm::ivec3;
using glm::vec3;

namespace {

// By slot: a place in the order of the cells.
struct Place {
    vec3 position;  // m, of the world
    int molecule;
};

struct Motion {
    vec3 velocity;
    float weight;
};

// A contact with another slot, in the list of the slot that it acts on.
struct Contact {
    int other;              // slot
    vec3 normal;            // from the other
    float mass;             // kg, that both together put against an impulse
    float target;           // m/s, along the normal afterwards
    float since;            // s, since they touched; 0 where they rest
    float push;             // kg m: how far those that rest are pushed; m until the shares are known
    float share;            // of the impulse that the contact alone would take
    float pushed, earlier;  // N s, so far, and an iteration before
};

struct Active {
    int slot, begin, end;  // of the thread's contacts
};

// The part of one thread: what it found among its slots, and works on.
struct Piece {
    std::vector<uint32_t> next;  // of each cell: how many spheres of the piece, then the slot of the next one
    std::vector<Contact> contacts;
    std::vector<Active> active;
    uint32_t sum = 0;  // of all pieces' spheres in this piece's cells
};

ivec3 cellAt(const vec3& scaled) {
    const ivec3 cut(scaled);
    return cut - ivec3(scaled.x < float(cut.x), scaled.y < float(cut.y), scaled.z < float(cut.z));
}

// Cells of a row along x follow one another.
uint32_t rowKey(int y, int z) {
    uint32_t h = uint32_t(y) * 0x9E3779B1u ^ uint32_t(z) * 0x85EBCA77u;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    return h ^ (h >> 13);
}

}  // namespace

struct ContactBaseline::Data {
    Data(std::vector<float> given, int count, float r, int threadCount)
        : weights(std::move(given)),
          vertices(int(weights.size())),
          molecules(count),
          spheres(size_t(count) * weights.size()),
          reach(2 * r),
          scale(1 / (4.02f * r)),  // a little wider than two diameters, so that rounding loses nothing
          threads(threadCount),
          pieces(size_t(threadCount)) {
        while (mask + 1 < spheres)
            mask = 2 * mask + 1;
        for (Piece& piece : pieces)
            piece.next.resize(size_t(mask) + 1);
        starts.resize(size_t(mask) + 2);
        keys.resize(spheres);
        places.resize(spheres);
        motions.resize(spheres);
        for (std::vector<int>* of : {&sphereOf, &numbers})
            of->resize(spheres);
        for (std::vector<float>* of : {&effectiveCounts, &kept})
            of->resize(spheres);
        for (std::vector<vec3>* of : {&impulses, &newImpulses, &earlierImpulses, &shifts})
            of->resize(spheres);
    }

    std::vector<float> weights;
    int vertices, molecules;
    size_t spheres;
    float reach, scale;  // m; cells a metre
    uint32_t mask = 15;
    PinnedThreads threads;
    std::vector<Piece> pieces;

    GroupState state;
    std::vector<uint32_t> keys;          // by sphere
    std::vector<uint32_t> starts;        // of the cells, in slots
    std::vector<int> sphereOf, numbers;  // by slot: whose it is, and how many it touches
    std::vector<Place> places;
    // By slot, set where it is in contact.
    std::vector<Motion> motions;
    std::vector<float> effectiveCounts, kept;
    std::vector<vec3> impulses, newImpulses, earlierImpulses;  // N s
    std::vector<vec3> shifts;                                  // kg m

    template <typename Work>
    void each(Work work) {
        threads.run([this, &work](int thread) { work(thread, pieces[size_t(thread)]); });
    }

    // Returns the impulse that an iteration begins with, extrapolated from the last two.
    vec3 impulse(int slot, float momentum) const {
        const vec3 last = impulses[size_t(slot)];
        return last + (last - earlierImpulses[size_t(slot)]) * momentum;
    }
    vec3 velocity(int slot, const vec3& impulse) const {
        return motions[size_t(slot)].velocity + impulse * motions[size_t(slot)].weight;
    }

    // Calls work(sphere, position, molecule) for the spheres of a thread.
    template <typename Work>
    void forSpheres(int thread, const Work& work) {
        const auto [first, last] = threads.part(size_t(molecules), thread);
        for (size_t m = first; m < last; ++m)
            for (size_t s = m * size_t(vertices); s < (m + 1) * size_t(vertices); ++s)
                work(s, state.anchors[m] + state.positions[s], int(m));
    }

    void count(int thread, Piece& piece) {
        std::fill(piece.next.begin(), piece.next.end(), 0u);
        forSpheres(thread, [&](size_t s, const vec3& position, int) {
            const ivec3 cell = cellAt(position * scale);
            keys[s] = (rowKey(cell.y, cell.z) + uint32_t(cell.x)) & mask;
            ++piece.next[keys[s]];
        });
    }

    void sumUp(int thread, Piece& piece) {
        const auto [first, last] = threads.part(size_t(mask) + 1, thread);
        piece.sum = 0;
        for (const Piece& other : pieces)
            for (size_t k = first; k < last; ++k)
                piece.sum += other.next[k];
    }

    void begin(int thread) {
        uint32_t slot = 0;
        for (int before = 0; before < thread; ++before)
            slot += pieces[size_t(before)].sum;
        const auto [first, last] = threads.part(size_t(mask) + 1, thread);
        for (size_t k = first; k < last; ++k) {
            starts[k] = slot;
            for (Piece& piece : pieces)
                slot += std::exchange(piece.next[k], slot);
        }
        if (last == size_t(mask) + 1) starts[last] = slot;
    }

    void scatter(int thread, Piece& piece) {
        forSpheres(thread, [&](size_t s, const vec3& position, int molecule) {
            const uint32_t slot = piece.next[keys[s]]++;
            places[slot] = {position, molecule};
            sphereOf[slot] = int(s);
        });
    }

    void buildGrid() {
        each([this](int thread, Piece& piece) { count(thread, piece); });
        each([this](int thread, Piece& piece) { sumUp(thread, piece); });
        each([this](int thread, Piece&) { begin(thread); });
        each([this](int thread, Piece& piece) { scatter(thread, piece); });
    }

    void meet(const Place& own, uint32_t from, uint32_t end, Piece& piece) const {
        for (uint32_t slot = from; slot < end; ++slot) {
            const Place& other = places[slot];
            const vec3 d = own.position - other.position;
            if (glm::dot(d, d) < reach * reach && own.molecule != other.molecule)
                piece.contacts.emplace_back().other = int(slot);
        }
    }

    // Cells are two diameters wide: only the eight on a sphere's side can hold one that it touches, four rows
    // of two.
    void look(int slot, Piece& piece) const {
        const Place& own = places[size_t(slot)];
        const vec3 scaled = own.position * scale;
        const ivec3 cell = cellAt(scaled);
        const vec3 inCell = scaled - vec3(cell);
        const int x = cell.x - (inCell.x < 0.5f);
        const int y[] = {cell.y, cell.y + (inCell.y < 0.5f ? -1 : 1)};
        const int z[] = {cell.z, cell.z + (inCell.z < 0.5f ? -1 : 1)};
        uint32_t seen[4];
        for (int r = 0; r < 4; ++r) {
            const uint32_t key = (rowKey(y[r & 1], z[r >> 1]) + uint32_t(x)) & mask;
            seen[r] = key;
            const size_t before = piece.contacts.size();
            if (key < mask) {
                meet(own, starts[key], starts[key + 2], piece);
            } else {
                meet(own, starts[key], starts[key + 1], piece);
                meet(own, starts[0], starts[1], piece);
            }
            // rows whose keys are next to each other share cells: what an earlier one has found is there
            // twice
            for (int q = 0; q < r && piece.contacts.size() > before; ++q) {
                if (((key - seen[q] + 1) & mask) > 2) continue;
                const auto has = [&](const Contact& c) {
                    return std::any_of(piece.contacts.begin() + ptrdiff_t(piece.active.back().begin),
                                       piece.contacts.begin() + ptrdiff_t(before),
                                       [&](const Contact& known) { return known.other == c.other; });
                };
                piece.contacts.erase(
                    std::remove_if(piece.contacts.begin() + ptrdiff_t(before), piece.contacts.end(), has),
                    piece.contacts.end());
            }
        }
    }

    void find(int thread, Piece& piece) {
        piece.contacts.clear();
        piece.active.clear();
        const auto [first, last] = threads.part(spheres, thread);
        for (size_t slot = first; slot < last; ++slot) {
            const int begin = int(piece.contacts.size());
            piece.active.push_back({int(slot), begin, begin});
            look(int(slot), piece);
            const int end = int(piece.contacts.size());
            numbers[slot] = end - begin;
            piece.active.back().end = end;
            if (begin == end) {
                piece.active.pop_back();
                continue;
            }
            const auto sphere = size_t(sphereOf[slot]);
            motions[slot] = {state.velocities[sphere], weights[sphere % size_t(vertices)]};
        }
    }

    Contact known(int slot, int other, const ContactBaselineStep& step) const {
        const auto a = size_t(slot), b = size_t(other);
        const float w = motions[a].weight + motions[b].weight, mass = w > 0 ? 1 / w : 0;
        const vec3 d = places[a].position - places[b].position;
        const vec3 u = motions[a].velocity - motions[b].velocity;
        const float squared = glm::dot(d, d), along = glm::dot(d, u), fast = glm::dot(u, u);
        const float inside = std::max(reach * reach - squared, 0.0f);
        const float root = std::sqrt(along * along + fast * inside);  // |d - u t| = reach
        const float since =
            along < 0 ? inside / std::max(root - along, 1e-30f) : (along + root) / std::max(fast, 1e-30f);
        const vec3 touch = (d - u * since) / reach;
        const float speed = glm::dot(touch, u);
        if (since <= step.stepTime && speed < -step.restSpeed)
            return {other, touch, mass, -step.restitution * speed, since, 0, 0, 0, 0};
        const float apart = std::sqrt(squared);
        const vec3 normal = apart > 1e-6f * reach ? d / apart : vec3(0, slot < other ? 1.0f : -1.0f, 0);
        return {other, normal, mass, std::max(glm::dot(normal, u), 0.0f), 0, reach - apart, 0, 0, 0};
    }

    // A bound of the largest eigenvalue of the sum of n n^T: how many contacts push the same way.
    void know(Piece& piece, const ContactBaselineStep& step) {
        for (const Active& active : piece.active) {
            vec3 squares(0), mixed(0);
            for (int c = active.begin; c < active.end; ++c) {
                Contact& contact = piece.contacts[size_t(c)];
                contact = known(active.slot, contact.other, step);
                const vec3 n = contact.normal;
                squares += n * n;
                mixed += vec3(n.y * n.z, n.z * n.x, n.x * n.y);
            }
            const vec3 m = glm::abs(mixed);
            const vec3 rows = squares + vec3(m.y + m.z, m.z + m.x, m.x + m.y);
            const float norm = std::sqrt(glm::dot(squares, squares) + 2 * glm::dot(m, m));
            effectiveCounts[size_t(active.slot)] =
                std::max(std::min(std::max(rows.x, std::max(rows.y, rows.z)), norm),
                         active.end - active.begin > 1 ? 1.01f : 1.0f);
        }
    }

    void startPushing(Piece& piece, const ContactBaselineStep& step) {
        for (const Active& active : piece.active) {
            const auto slot = size_t(active.slot);
            vec3 sum(0);
            for (int c = active.begin; c < active.end; ++c) {
                Contact& contact = piece.contacts[size_t(c)];
                contact.share = 1 / std::max(effectiveCounts[slot], effectiveCounts[size_t(contact.other)]);
                contact.push *= contact.share * contact.mass;
                contact.pushed = contact.earlier = contact.push / step.stepTime;
                sum += contact.normal * contact.pushed;
            }
            impulses[slot] = earlierImpulses[slot] = sum;
        }
    }

    void relax(Piece& piece, float momentum) {
        for (const Active& active : piece.active) {
            vec3 sum = impulse(active.slot, momentum);
            const vec3 own = velocity(active.slot, sum);
            for (int c = active.begin; c < active.end; ++c) {
                Contact& contact = piece.contacts[size_t(c)];
                const vec3 relative = own - velocity(contact.other, impulse(contact.other, momentum));
                const float pushed = contact.pushed + (contact.pushed - contact.earlier) * momentum;
                const float gap = contact.target - glm::dot(relative, contact.normal);
                const float change = std::max(contact.share * contact.mass * gap, -pushed);
                contact.earlier = contact.pushed;
                contact.pushed = pushed + change;
                sum += contact.normal * change;
            }
            newImpulses[size_t(active.slot)] = sum;
        }
    }

    // A round of friction, how far all of it moves the spheres, and what part of the pushes' speed they are
    // to keep.
    void addFriction(Piece& piece, const ContactBaselineStep& step) {
        for (const Active& active : piece.active) {
            const auto slot = size_t(active.slot);
            vec3 sum = impulses[slot], bounce(0), rest(0);
            const vec3 own = velocity(active.slot, sum);
            for (int c = active.begin; c < active.end; ++c) {
                const Contact& contact = piece.contacts[size_t(c)];
                const vec3 relative = own - velocity(contact.other, impulses[size_t(contact.other)]);
                const vec3 along = relative - contact.normal * glm::dot(relative, contact.normal);
                const float slip = glm::length(along);
                const int number = 1 + std::max(numbers[slot], numbers[size_t(contact.other)]);
                const bool alone =
                    contact.share > 0.995f;  // its spheres exchange a push and friction, and nothing else
                const float spent = glm::length(sum - contact.normal * contact.pushed);
                const float grip =
                    alone ? std::min(std::max(step.friction * contact.pushed - spent, 0.0f),
                                     slip * contact.mass)
                          : std::min(step.friction * contact.pushed / 4,
                                     1.5f * slip * contact.mass / float(number));
                const vec3 change = along * (-grip / std::max(slip, 1e-30f));
                sum += change;
                bounce += (alone ? sum : contact.normal * contact.pushed + change) * contact.since;
                rest += contact.normal * contact.push;
            }
            newImpulses[slot] = sum;
            shifts[slot] = bounce + rest;
            const vec3 gained = rest * (motions[slot].weight / step.stepTime);
            const float square = glm::dot(gained, gained);
            kept[slot] = square > 0 ? std::clamp(-glm::dot(own, gained) / square, 0.0f, 1.0f) : 0.0f;
        }
    }

    void apply(Piece& piece, const ContactBaselineStep& step) {
        for (const Active& active : piece.active) {
            const auto slot = size_t(active.slot);
            vec3 sum = newImpulses[slot];
            for (int c = active.begin; c < active.end; ++c) {
                const Contact& contact = piece.contacts[size_t(c)];
                const float part = std::min(kept[slot], kept[size_t(contact.other)]);
                sum += contact.normal * (contact.push / step.stepTime * part);
            }
            const auto sphere = size_t(sphereOf[slot]);
            state.velocities[sphere] += sum * motions[slot].weight;
            state.positions[sphere] += shifts[slot] * motions[slot].weight;
        }
    }
};

ContactBaseline::ContactBaseline(std::vector<float> weights, int molecules, float radius, int threads)
    : data_(std::make_unique<Data>(std::move(weights), molecules, radius, threads)) {}
ContactBaseline::~ContactBaseline() = default;

void ContactBaseline::set(const GroupState& state) {
    data_->state = state;
}

void ContactBaseline::get(GroupState& state) const {
    state.positions = data_->state.positions;
    state.velocities = data_->state.velocities;
}

void ContactBaseline::step(const ContactBaselineStep& step) {
    Data& data = *data_;
    data.buildGrid();
    data.each([&](int thread, Piece& piece) { data.find(thread, piece); });
    data.each([&](int, Piece& piece) { data.know(piece, step); });
    data.each([&](int, Piece& piece) { data.startPushing(piece, step); });
    for (int i = 0; i < step.iterations; ++i) {
        const float momentum = i == 0 ? 0.0f : float(i) / float(i + 3);
        data.each([&](int, Piece& piece) { data.relax(piece, momentum); });
        data.earlierImpulses.swap(data.impulses);
        data.impulses.swap(data.newImpulses);
    }
    for (int i = 0; i < 4; ++i) {
        data.each([&](int, Piece& piece) { data.addFriction(piece, step); });
        data.impulses.swap(data.newImpulses);
    }
    data.newImpulses.swap(data.impulses);
    data.each([&](int, Piece& piece) { data.apply(piece, step); });
}

std::vector<std::pair<int, int>> ContactBaseline::found() const {
    std::vector<std::pair<int, int>> out;
    for (const Piece& piece : data_->pieces) {
        for (const Active& active : piece.active) {
            const int own = data_->sphereOf[size_t(active.slot)];
            for (int c = active.begin; c < active.end; ++c) {
                const int other = data_->sphereOf[size_t(piece.contacts[size_t(c)].other)];
                if (own < other) out.emplace_back(own, other);
            }
        }
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace shoal::bench
