// The grid of the baseline of contact (bench/contact_baseline.h): spheres in the order of their cells, sorted
// by counting, each thread a part of them.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/baseline_threads.h"
#include "compile/group_state.h"

namespace shoal::bench {

// A slot is a place in the order of the cells.
class SphereGrid {
  public:
    // near: m, below which two spheres are in contact. The threads have to stay where they are.
    SphereGrid(int vertices, int molecules, float near, PinnedThreads& threads);

    void build(const GroupState& state);
    // Appends the slots of the spheres of other molecules that this one is in contact with.
    void look(int slot, std::vector<int>& found) const;

    int sphereOf(int slot) const { return spheres_[size_t(slot)]; }
    const glm::vec3& position(int slot) const { return places_[size_t(slot)].position; }  // m, of the world

  private:
    struct Place {
        glm::vec3 position;
        int molecule;
    };
    // The part of one thread.
    struct Piece {
        std::vector<uint32_t>
            next;          // of each cell: how many spheres of the part, then the slot of the next one
        uint32_t sum = 0;  // of all parts' spheres in this part's cells
    };

    template <typename Work>
    void forSpheres(int thread, const GroupState& state, const Work& work) const;
    void count(int thread, const GroupState& state);
    void sumUp(int thread);
    void begin(int thread);
    void scatter(int thread, const GroupState& state);
    void meet(const Place& own, uint32_t from, uint32_t end, std::vector<int>& found) const;

    int vertices_, molecules_;
    float near_, scale_;  // m; cells a metre
    uint32_t mask_ = 15;  // of the table of cells
    PinnedThreads* threads_;
    std::vector<Piece> pieces_;
    std::vector<uint32_t> keys_;    // by sphere
    std::vector<uint32_t> starts_;  // of the cells, in slots
    std::vector<int> spheres_;      // by slot
    std::vector<Place> places_;     // by slot
};

}  // namespace shoal::bench
