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
    virtual ~BulletBaseline() = default;
    virtual void frame(double seconds) = 0;  // one step
};

// `count` molecules on a grid, up to 6 m above the ground: a soft body of each, or all in one (`merged`),
// without any overhead of a body. Null unless bulletAvailable().
std::unique_ptr<BulletBaseline> makeBullet(const Molecule& molecule, int count, bool merged);

}  // namespace shoal
