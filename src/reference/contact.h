// Motion with contact, in continuous time: the limit that shaders/physics/collide.glsl aims at.
//
// A vertex that is not pinned stays outside every collider's rest surface (its thickness off the drawn one).
// With n the surface's normal, v_n = v . n, e the restitution and mu the friction:
//
//   impact    v_n becomes -e v_n; the rest of v loses min(mu (1 + e) |v_n|, itself) along its direction
//             (Coulomb). Found as an event: where the distance crosses 0 within a step.
//   rest      a rebound below 1e-8 m/s, or of less than 1e-13 m, ends bouncing. While the other forces press
//             the vertex into the surface it has no acceleration along n but that of following the surface; N
//             is the force that this takes.
//   stick     at speed 0 it stays where it is while the other forces along the surface are within mu N.
//   slide     otherwise mu N acts against its velocity, until that is 0.
//   release   when N would have to pull.
//
// Start and end of sticking, sliding and resting are events too. Between events the motion is smooth and
// every step is one of RungeKutta, so that the order survives contact. Up to three surfaces may hold a vertex
// at once.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <vector>

#include "reference/colliders.h"
#include "reference/problem.h"

namespace shoal::reference {

// Ends an integration that would take longer than its caller wants to wait.
struct OutOfTime {};  // thrown by Deadline::check, caught by solve

class Deadline {
  public:
    explicit Deadline(double seconds = std::numeric_limits<double>::infinity()) : seconds_(seconds) {}

    // Once a step.
    void check() {
        if (++calls_ % 16 == 0 && left() < 0) throw OutOfTime{};
    }
    double passed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double left() const { return seconds_ - passed(); }

  private:
    using Clock = std::chrono::steady_clock;
    double seconds_;
    Clock::time_point start_ = Clock::now();
    unsigned calls_ = 0;
};

struct ContactRun {
    State state;
    int64_t events = 0;
    // False when the events did not come to an end (bounces without number, contact that flickers) or the
    // state is not finite: the rest of the run was done without bounces, and is no solution.
    bool settled = true;
};

// `steps` equal steps over `duration`, each cut where something happens. What starts inside a collider is put
// onto its rest surface first.
// OutOfTime: the deadline has passed.
ContactRun integrateWithContact(const Problem& problem, const State& start, double duration, int64_t steps,
                                const Deadline& deadline = Deadline());

constexpr double restSpeed = 1e-8;  // m/s: slower than this along a normal is not moving

// The events that change how a vertex moves.
enum class Change { impact, release, slip, stop, press };

// The vertices that surfaces hold: which stick, which slide, and the forces that this takes (held.cpp). All
// forces are per mass, in m/s^2; `free` is a vertex's acceleration without contact.
class Held {
  public:
    // Borrows the surfaces.
    Held(const RestSurfaces& surfaces, size_t vertices) : surfaces_(&surfaces), contacts_(vertices) {}

    const std::vector<size_t>& list() const { return list_; }  // of held vertices
    bool any(size_t vertex) const { return contacts_[vertex].count > 0; }
    bool holds(size_t vertex, size_t collider) const;

    void hold(size_t vertex, size_t collider);  // a fourth surface at once is left out
    // Holds a vertex that is on its way out by the normal, and yet would run into the surface: a height
    // field's normals are smoother than its cells. It is shifted out and keeps its velocity, as on the GPU,
    // until it is off the surface or presses into it.
    void graze(size_t vertex, size_t collider);
    void release(size_t vertex, size_t collider);
    void releaseAll(size_t vertex);
    // Decides whether it sticks, slides or is released from now on. `slipped`: friction has just failed to
    // hold it.
    void classify(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, const glm::dvec3& free,
                  bool slipped);

    // Before a step: friction acts against these directions until it ends, also past a stop, which keeps the
    // motion smooth until the stop is found.
    void keepDirections(const std::vector<glm::dvec3>& velocity);
    // Turns the rates of change without contact into those with it.
    void constrain(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, glm::dvec3& rate,
                   glm::dvec3& acceleration) const;
    // After a step: takes back what its error has moved off the surfaces.
    void project(size_t vertex, glm::dvec3& x, glm::dvec3& v) const;

    // Calls see(change, collider) for all that may end how a vertex is held.
    template <typename See>
    void changes(size_t vertex, See&& see) const {
        const Contacts& c = contacts_[vertex];
        if (c.sticks) return see(Change::slip, c.collider[0]);
        if (c.grazes) see(Change::press, c.collider[0]);
        for (size_t j = 0; j < c.count; ++j)
            see(Change::release, c.collider[j]);
        if (rough(c) && !c.grazes) see(Change::stop, c.collider[0]);
    }
    // Each falls below 0 when its change happens: the force of the surface on a vertex that slides (the shift
    // of one that grazes), what friction could still take of one that sticks, the speed along the direction
    // of sliding, the speed off the surface of one that grazes.
    double pressure(size_t vertex, size_t collider, const glm::dvec3& x, const glm::dvec3& v,
                    const glm::dvec3& free) const;
    double grip(size_t vertex, const glm::dvec3& x, const glm::dvec3& free) const;
    // Friction against a vertex that slides, m/s^2; 0 for one that sticks or grazes.
    double friction(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, const glm::dvec3& free) const;
    double speedAlong(size_t vertex, const glm::dvec3& v) const {
        return glm::dot(v, contacts_[vertex].direction);
    }
    double speedOff(size_t vertex, const glm::dvec3& x, const glm::dvec3& v) const;

  private:
    static constexpr size_t most = 3;
    struct Contacts {
        size_t count = 0;
        std::array<size_t, most> collider{};
        bool sticks = false, grazes = false;  // else it slides; only a single surface is grazed
        glm::dvec3 direction{0};              // unit, of sliding; 0 before it has one
    };
    // The surfaces at a vertex, and the forces along their normals.
    struct Forces {
        std::array<Surface, most> surface;
        std::array<double, most> pressure{}, shift{};
    };
    struct Reply {
        glm::dvec3 acceleration{0};
        std::array<double, most> pressure{};
    };

    bool rough(const Contacts& contacts) const;
    double friction(size_t collider) const { return surfaces_->collider(collider).friction; }
    // Returns the forces of the surfaces on a vertex that slides.
    Forces forces(const Contacts& contacts, const glm::dvec3& x, const glm::dvec3& v,
                  const glm::dvec3& free) const;
    // Returns the reply of the surfaces to a vertex at rest: Coulomb's law at every surface.
    Reply reply(const Contacts& contacts, const glm::dvec3& x, const glm::dvec3& free) const;
    void classifyResting(size_t vertex, const glm::dvec3& x, const glm::dvec3& free, bool slipped);
    void classifySliding(size_t vertex, const glm::dvec3& x, const glm::dvec3& v, const glm::dvec3& free);

    const RestSurfaces* surfaces_;
    std::vector<Contacts> contacts_;  // of each vertex
    std::vector<size_t> list_;
};

}  // namespace shoal::reference
