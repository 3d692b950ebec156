// A baseline from a general-purpose physics library: the same molecules as soft bodies of Bullet 3 on one
// thread.
//
// Bullet solves positions (one pass over the links a step), not forces: its stiffness is no spring constant.
// It is a baseline of speed only. Gravity, wind and drag are one linear part as ours; the ground is the top
// of a box. Molecules do not collide with each other.
#pragma once

#include <memory>

#include "molecule/molecule.h"

namespace shoal {

bool bulletAvailable();  // built with Bullet

class BulletBaseline {
  public:
    enum class Form {
        bodies,  // a soft body per molecule
        merged   // all molecules in one soft body: no overhead per body
    };

    // `count` molecules on a grid, up to 6 m above the ground. Only where bulletAvailable().
    BulletBaseline(const Molecule& molecule, int count, Form form);
    ~BulletBaseline();
    BulletBaseline(const BulletBaseline&) = delete;
    BulletBaseline& operator=(const BulletBaseline&) = delete;

    void frame(double seconds);   // one step
    double meanHeight() const;    // m, of all vertices above the ground
    double lowestHeight() const;  // m

  private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace shoal
