// The equations of a problem made ready for many evaluations: masses, rest lengths and factors are worked
// out once, and no evaluation allocates. The equations themselves: reference/problem.h.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/problem.h"

namespace shoal::reference {

class Equations {
  public:
    // Borrows the problem and its molecule.
    explicit Equations(const Problem& problem);

    const Problem& problem() const { return *problem_; }
    size_t vertices() const { return inverseMass_.size(); }
    bool pinned(size_t vertex) const { return inverseMass_[vertex] == 0; }

    // Each takes and fills one entry per vertex, in m, m/s and m/s^2. Velocities of pinned vertices must be
    // 0; their accelerations are.
    void springs(const Vectors& position, const Vectors& velocity, double time, Vectors& out);
    void everything(const Vectors& position, const Vectors& velocity, double time, Vectors& out);

  private:
    // A spring with the problem's factors: N/m, N s/m, m.
    struct Link {
        uint32_t a, b;
        double stiffness, damping, restLength;
    };
    struct Muscle {
        size_t link;
        double restLength;        // m, relaxed
        double amplitude;         // share of it
        double angularFrequency;  // rad/s
        double phase;             // rad, the problem's included
    };

    void addLink(const Spring& spring);
    void flex(double time);
    void addForces(const Vectors& position, const Vectors& velocity, double time, Vectors& out);
    void addDrag(const Vectors& position, const Vectors& velocity, double time, Vectors& out);

    const Problem* problem_;
    std::vector<double> inverseMass_;  // 1/kg, 0 where pinned
    std::vector<Link> links_;
    std::vector<Muscle> muscles_;
    Vectors normals_;
};

}  // namespace shoal::reference
