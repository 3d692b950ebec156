// The grid of contact (shaders/contact/grid): the spheres of all molecules, from the state, in the order of
// their cells.
//
//   spheres    of each group: place, motion and cell, the key of that, and the colliders near it (for which
//              fragments have a pass `colliders`)
//   keys       ascending: with buffers by a radix sort or, on a GPU, by counting: starts, where each cell
//              begins, and members, the spheres of each; in fragments by a sorting network, and then starts
//              by bisection
//   order      places and cells in that order, and the slot of each sphere (in fragments, slots)
#pragma once

#include <optional>
#include <vector>

#include "simulate/contact/data.h"
#include "sort/network_sort.h"
#include "sort/radix_sort.h"

namespace shoal {

class ContactGrid {
  public:
    explicit ContactGrid(ContactData& data);

    // `wakes`: all that rests wakes.
    void build(const Frame& frame, bool wakes);
    size_t bytes() const;        // of the sorts
    int sortDispatches() const;  // of a step

  private:
    struct Group {
        gpu::Program spheres, colliders;
    };

    void makeSpheres(const Frame& frame, bool wakes, bool isStaggered);
    void makeColliders(const Frame& frame);
    void sortByRadix(bool isStaggered);
    void count(bool isStaggered);
    void sortByNetwork(bool isStaggered);
    void setStep(const gpu::Program& program, const ContactGroup& group, const Frame& frame) const;

    ContactData* data_;
    std::vector<Group> groups_;
    gpu::Program keys_, starts_, members_, order_, slots_;
    std::optional<RadixSort> radix_;
    std::vector<NetworkSort> networks_;  // of the grid and, if there is one, the staggered grid
};

}  // namespace shoal
