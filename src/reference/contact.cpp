// A step is tried whole. Events are looked for between its ends; the earliest is located and the step ends
// there; what happens is applied, and the rest of the step is tried again.
#include "reference/contact.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "reference/equations.h"

namespace shoal::reference {

namespace {

// m, and the share of a coordinate: what is closer to a surface is on it.
constexpr double onSurface = 1e-12, rounding = 1e-15;
// The share of a step that events are located to.
constexpr double located = 1e-13;
// Events are at most so many and one a step; more do not come to an end.
constexpr int64_t fewEvents = 20000;
// rad, that what slides turns in a step, unless that were shorter than this share of one: what stops or
// begins to slide turns ever faster the slower it is, and steps that pass over it are of first order.
constexpr double mostTurn = 0.5, leastShare = 1 / 64.0;
// A distance above this, in m, is to nothing.
constexpr double nothing = 1e20;
// So many events in a row that take less than this share of a step are one that repeats itself.
constexpr int mostAtOnce = 200;
constexpr double atOnceShare = 1e-10;

bool finite(const State& state) {
    glm::dvec3 sum(0);
    for (size_t i = 0; i < state.position.size(); ++i)
        sum += state.position[i] + state.velocity[i];
    return std::isfinite(sum.x + sum.y + sum.z);
}

double slack(const glm::dvec3& x) {
    return onSurface + rounding * (std::abs(x.x) + std::abs(x.y) + std::abs(x.z));
}

// The cubic through both ends of a step with their velocities.
struct Path {
    glm::dvec3 x0, v0, x1, v1;  // v in m per step
    glm::dvec3 position(double s) const {
        const double r = 1 - s;
        return x0 * (r * r * (1 + 2 * s)) + x1 * (s * s * (1 + 2 * r)) + v0 * (s * r * r) - v1 * (s * s * r);
    }
    double length() const { return glm::length(x1 - x0); }
    double bend() const {
        return (glm::length(v0) + glm::length(v1)) * (4 / 27.0);
    }  // at most, off the chord
};

// Something that happens to one vertex when `value` falls below 0.
struct Event {
    Change kind = Change::impact;
    size_t vertex = 0;
    size_t collider = 0;  // of impact and release
    double share = 1;     // of the step: it has happened by then
    bool operator==(const Event& o) const {
        return kind == o.kind && vertex == o.vertex && collider == o.collider;
    }
};

// Impact with a surface of unit normal n: the velocity after it.
glm::dvec3 afterImpact(const glm::dvec3& velocity, const glm::dvec3& n, double restitution, double friction) {
    const double vn = glm::dot(velocity, n);
    const glm::dvec3 tangential = velocity - vn * n;
    const double speed = glm::length(tangential), lost = friction * (1 + restitution) * std::abs(vn);
    return (speed > lost ? tangential * (1 - lost / speed) : glm::dvec3(0)) - restitution * vn * n;
}

class ContactIntegrator {
  public:
    ContactIntegrator(const Problem& problem, const State& start)
        : equations_(problem),
          surfaces_(problem.colliders),
          method_(start.position.size()),
          held_(surfaces_, start.position.size()),
          state_(start),
          trial_(start) {
        equations_.everything(state_.position, state_.velocity, state_.time, free_);
        for (size_t i = 0; i < state_.position.size(); ++i) {
            if (!equations_.pinned(i)) putOutside(i);
        }
        classify({});
    }

    ContactRun run(double duration, int64_t steps, const Deadline& deadline) {
        const double begin = state_.time, h = duration / double(steps);
        budget_ = fewEvents + steps;
        deadline_ = deadline;
        for (int64_t i = 0; i < steps && isFinite_; ++i) {
            step(h);
            state_.time = begin + double(i + 1) * h;
        }
        return {std::move(state_), events_, settled_ && isFinite_};
    }

  private:
    // ---- the motion between events

    void tryStep(double h) {
        method_.step(
            state_, h,
            [this](const Vectors& x, const Vectors& v, double time, RungeKutta::Rates& out) {
                equations_.everything(x, v, time, out.velocity);
                out.position = v;
                for (const size_t i : held_.list())
                    held_.constrain(i, x[i], v[i], out.position[i], out.velocity[i]);
            },
            trial_);
    }

    void step(double h) {
        double left = h;
        int atOnce = 0;
        while (left > 0) {
            deadline_.check();
            held_.keepDirections(state_.velocity);
            const double most = settled_ ? std::min(left, longestSlide(h)) : left;
            tryStep(most);
            isFinite_ = finite(trial_);
            if (!isFinite_) return accept();
            if (events_ >= budget_ || atOnce > mostAtOnce) settled_ = false;
            if (!settled_) {
                if (most < left) tryStep(left);
                return finishWithoutEvents();
            }
            double until = most;
            const std::optional<Event> event = earliest(until);
            accept();
            left = !event && most == left ? 0 : left - until;
            if (!event) continue;
            apply(*event);
            ++events_;
            atOnce = until > atOnceShare * h ? 0 : atOnce + 1;
        }
    }

    // The longest step, in s, in which friction (m/s^2) over speed, the rate at which what slides turns,
    // lets nothing turn far.
    double longestSlide(double h) {
        double out = h;
        if (held_.list().empty()) return out;
        equations_.everything(state_.position, state_.velocity, state_.time, free_);
        for (const size_t i : held_.list()) {
            const glm::dvec3 &x = state_.position[i], &v = state_.velocity[i];
            const double friction = held_.friction(i, x, v, free_[i]);
            if (friction > 0) out = std::min(out, mostTurn * glm::length(v) / friction);
        }
        return std::max(out, leastShare * h);
    }

    void accept() {
        std::swap(state_, trial_);
        for (const size_t i : held_.list())
            held_.project(i, state_.position[i], state_.velocity[i]);
    }

    // Keeps what comes out of it outside and finite, no more.
    void finishWithoutEvents() {
        accept();
        for (size_t i = 0; i < state_.position.size(); ++i) {
            for (size_t c = 0; c < surfaces_.count() && !equations_.pinned(i); ++c) {
                const Surface s = surfaces_.surfaceOf(c, state_.position[i]);
                if (s.distance >= 0) continue;
                state_.position[i] -= s.distance * s.normal;
                state_.velocity[i] -= std::min(glm::dot(state_.velocity[i], s.normal), 0.0) * s.normal;
            }
        }
    }

    // ---- looking for events

    // The first event of the step that was tried; `until` becomes its time in the step and trial_ its state.
    std::optional<Event> earliest(double& until) {
        std::optional<Event> first;
        known_.clear();
        while (const std::optional<Event> next = find(until)) {
            known_.push_back(*next);
            if (locate(*next, until)) first = next;
        }
        return first;
    }

    // An event between state_ and trial_ that is not yet known, the earliest as far as a glance tells.
    std::optional<Event> find(double h) {
        std::optional<Event> best;
        const auto consider = [&](const Event& event) {
            if (best && event.share >= best->share) return;
            if (std::find(known_.begin(), known_.end(), event) == known_.end()) best = event;
        };
        for (size_t i = 0; i < state_.position.size(); ++i) {
            if (!equations_.pinned(i)) findImpacts(i, h, consider);
        }
        if (held_.list().empty()) return best;
        equations_.everything(trial_.position, trial_.velocity, trial_.time, free_);
        for (const size_t i : held_.list()) {
            held_.changes(i, [&](Change kind, size_t collider) {
                const Event event{kind, i, collider, 1};
                if (value(event, trial_) < 0) consider(event);
            });
        }
        return best;
    }

    template <typename Consider>
    void findImpacts(size_t i, double h, Consider&& consider) {
        const Path path{state_.position[i], h * state_.velocity[i], trial_.position[i],
                        h * trial_.velocity[i]};
        const double reach = path.length() + path.bend();
        for (size_t c = 0; c < surfaces_.count(); ++c) {
            if (held_.holds(i, c) || surfaces_.clear(c, path.x0, reach)) continue;
            const double share = firstInside(c, path);
            if (share <= 1) consider({Change::impact, i, c, share});
        }
    }

    // The first share of the path seen inside a collider; 2 when it never is.
    double firstInside(size_t c, const Path& path) const {
        const auto inside = [&](double s) {
            const glm::dvec3 x = path.position(s);
            return surfaces_.surfaceOf(c, x).distance < -slack(x);
        };
        const int pieces = int(std::clamp(std::ceil(path.length() / surfaces_.feature(c)), 1.0, 256.0));
        for (int k = 1; k <= pieces; ++k) {
            if (inside(double(k) / pieces)) return double(k) / pieces;
            const double lowest = lowestShare(c, path, double(k - 1) / pieces, double(k) / pieces);
            if (lowest > 0 && inside(lowest)) return lowest;
        }
        return 2;
    }

    // Where the distance has its minimum between two shares; 0 when it has none.
    double lowestShare(size_t c, const Path& path, double low, double high) const {
        const double tiny = 1e-4 * (high - low);
        const auto distance = [&](double s) { return surfaces_.surfaceOf(c, path.position(s)).distance; };
        if (distance(low + tiny) >= distance(low) || distance(high - tiny) >= distance(high)) return 0;
        constexpr double golden = 0.6180339887498949;
        for (int i = 0; i < 40; ++i) {
            const double a = high - golden * (high - low), b = low + golden * (high - low);
            if (distance(a) < distance(b)) {
                high = b;
            } else {
                low = a;
            }
        }
        return (low + high) / 2;
    }

    // Falls below 0 at the event. Uses free_, the accelerations without contact at `state`, for forces.
    double value(const Event& event, const State& state) const {
        const size_t i = event.vertex;
        const glm::dvec3 &x = state.position[i], &v = state.velocity[i];
        switch (event.kind) {
        case Change::impact:
            return surfaces_.surfaceOf(event.collider, x).distance;
        case Change::release:
            return held_.pressure(i, event.collider, x, v, free_[i]);
        case Change::slip:
            return held_.grip(i, x, free_[i]);
        case Change::press:
            return held_.speedOff(i, x, v);
        default:
            return held_.speedAlong(i, v);
        }
    }

    double valueAt(const Event& event, double time) {
        tryStep(time);
        if (event.kind == Change::release || event.kind == Change::slip)
            equations_.everything(trial_.position, trial_.velocity, trial_.time, free_);
        return value(event, trial_);
    }

    // Finds the time within [0, until] at which the event's value falls below 0, by the Illinois method and
    // bisection in turn; leaves trial_ there. False, with trial_ at `until`, when it does not.
    bool locate(const Event& event, double& until) {
        double low = 0, high = until * event.share;
        double atHigh = valueAt(event, high);
        if (!(atHigh < 0)) {
            tryStep(until);
            return false;
        }
        if (event.kind == Change::release || event.kind == Change::slip)
            equations_.everything(state_.position, state_.velocity, state_.time, free_);
        double atLow = value(event, state_);
        // from a 0 at the start (just off the surface) the way to the next is not a straight line
        if (atLow < std::max(1e-9 * -atHigh, slack(state_.position[event.vertex]))) atLow = 0;
        const double close = located * until;
        int side = 0;  // that moved last
        for (int i = 0; i < 150 && high - low > close; ++i) {
            const double secant = low + (high - low) * atLow / (atLow - atHigh);
            const bool halve = i % 4 == 3 || atLow > nothing || !(secant > low) || !(secant < high);
            const double time = halve ? (low + high) / 2 : secant;
            const double value = valueAt(event, time);
            // what a straight line to the other end says is left
            const double other = value < 0 ? atLow : -atHigh;
            const bool near = other < nothing && std::abs(value) * (high - low) < close * other;
            if (value < 0) {
                high = time, atHigh = value;
                if (side > 0) atLow /= 2;
                side = 1;
            } else {
                low = time, atLow = value;
                if (side < 0) atHigh /= 2;
                side = -1;
            }
            if (near) high = std::min(high, time + close), low = std::max(low, time - close);
        }
        // from before it, where the motion is still smooth
        tryStep(low);
        until = low;
        return true;
    }

    // ---- what happens

    void apply(const Event& event) {
        const size_t i = event.vertex;
        equations_.everything(state_.position, state_.velocity, state_.time, free_);
        switch (event.kind) {
        case Change::impact:
            onto(i, event.collider);
            strike(i);
            if (!surfaces_.exact(event.collider)) held_.graze(i, event.collider);
            break;
        case Change::press:
            held_.releaseAll(i);
            holdWhereSlow(i);
            break;
        case Change::release:
            held_.release(i, event.collider);
            break;
        case Change::slip:
            break;
        case Change::stop:
            if (glm::length(state_.velocity[i]) < restSpeed) state_.velocity[i] = glm::dvec3(0);
            break;
        }
        classify(event);
    }

    void onto(size_t i, size_t collider) {
        const Surface surface = surfaces_.surfaceOf(collider, state_.position[i]);
        state_.position[i] -= surface.distance * surface.normal;
    }

    // Impact of a vertex with every surface that it touches.
    void strike(size_t i) {
        const glm::dvec3& x = state_.position[i];
        glm::dvec3& v = state_.velocity[i];
        bool struck = true;
        for (int round = 0; round < 20 && struck; ++round) {
            struck = false;
            for (size_t c = 0; c < surfaces_.count(); ++c) {
                const Surface s = surfaces_.surfaceOf(c, x);
                if (s.distance > 10 * slack(x) || glm::dot(v, s.normal) >= -restSpeed) continue;
                v = afterImpact(v, s.normal, surfaces_.collider(c).restitution,
                                surfaces_.collider(c).friction);
                struck = true;
            }
        }
        if (struck) v = glm::dvec3(0);  // wedged in
        holdWhereSlow(i);
    }

    // Every surface that the vertex touches and does not leave holds it, until classify() says otherwise.
    void holdWhereSlow(size_t i) {
        const glm::dvec3& x = state_.position[i];
        glm::dvec3& v = state_.velocity[i];
        held_.releaseAll(i);
        for (size_t c = 0; c < surfaces_.count(); ++c) {
            const Surface s = surfaces_.surfaceOf(c, x);
            if (std::abs(s.distance) > 10 * slack(x) || glm::dot(v, s.normal) > slow(i, c, s)) continue;
            v -= glm::dot(v, s.normal) * s.normal;
            held_.hold(i, c);
        }
        if (glm::length(v) < restSpeed && held_.any(i)) v = glm::dvec3(0);
    }

    // m/s: a rebound below this is none. It would not rise by what a position can tell apart. On a height
    // field it is also the speed at which the vertex and the cell part because normals are smoother than
    // cells: it would hop without end.
    double slow(size_t i, size_t c, const Surface& s) const {
        const glm::dvec3 &x = state_.position[i], &v = state_.velocity[i];
        const double press = std::max(-glm::dot(free_[i], s.normal), 0.0);
        const double low = std::max(restSpeed, std::sqrt(2 * press * slack(x) / 10));
        if (surfaces_.exact(c)) return low;
        return low + std::abs(surfaces_.following(c, s, x, v - glm::dot(v, s.normal) * s.normal).shift);
    }

    // At the start: onto the surfaces that it is inside of, as an impact if it moves further in.
    void putOutside(size_t i) {
        for (size_t c = 0; c < surfaces_.count(); ++c) {
            const double distance = surfaces_.surfaceOf(c, state_.position[i]).distance,
                         near = slack(state_.position[i]);
            if (distance < -near) onto(i, c);
            if (distance < near) strike(i);
        }
    }

    // After something has happened at `event`: which held vertices stick, slide or are released.
    void classify(const std::optional<Event>& event) {
        equations_.everything(state_.position, state_.velocity, state_.time, free_);
        for (const size_t i : std::vector<size_t>(held_.list())) {
            const bool slipped = event && event->kind == Change::slip && event->vertex == i;
            held_.classify(i, state_.position[i], state_.velocity[i], free_[i], slipped);
        }
    }

    Equations equations_;
    RestSurfaces surfaces_;
    RungeKutta method_;
    Held held_;
    State state_, trial_;
    Vectors free_;              // accelerations without contact
    std::vector<Event> known_;  // in the step at hand
    int64_t events_ = 0, budget_ = 0;
    Deadline deadline_;
    bool settled_ = true, isFinite_ = true;
};

}  // namespace

ContactRun integrateWithContact(const Problem& problem, const State& start, double duration, int64_t steps,
                                const Deadline& deadline) {
    return ContactIntegrator(problem, start).run(duration, steps, deadline);
}

}  // namespace shoal::reference
