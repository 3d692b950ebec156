#include "bench/contact_baseline_grid.h"

#include <algorithm>
#include <utility>

namespace shoal::bench {

using glm::ivec3;
using glm::vec3;

namespace {

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

SphereGrid::SphereGrid(int vertices, int molecules, float near, PinnedThreads& threads)
    : vertices_(vertices),
      molecules_(molecules),
      near_(near),
      scale_(1 / (2.01f * near)),  // a little wider than needed, so that rounding loses nothing
      threads_(&threads),
      pieces_(size_t(threads.count())) {
    const size_t spheres = size_t(molecules) * size_t(vertices);
    while (mask_ + 1 < spheres)
        mask_ = 2 * mask_ + 1;
    for (Piece& piece : pieces_)
        piece.next.resize(size_t(mask_) + 1);
    starts_.resize(size_t(mask_) + 2);
    keys_.resize(spheres);
    places_.resize(spheres);
    spheres_.resize(spheres);
}

// Calls work(sphere, position, molecule) for the spheres of a thread.
template <typename Work>
void SphereGrid::forSpheres(int thread, const GroupState& state, const Work& work) const {
    const auto [first, last] = threads_->part(size_t(molecules_), thread);
    for (size_t m = first; m < last; ++m)
        for (size_t s = m * size_t(vertices_); s < (m + 1) * size_t(vertices_); ++s)
            work(s, state.anchors[m] + state.positions[s], int(m));
}

void SphereGrid::count(int thread, const GroupState& state) {
    std::vector<uint32_t>& next = pieces_[size_t(thread)].next;
    std::fill(next.begin(), next.end(), 0u);
    forSpheres(thread, state, [&](size_t s, const vec3& position, int) {
        const ivec3 cell = cellAt(position * scale_);
        keys_[s] = (rowKey(cell.y, cell.z) + uint32_t(cell.x)) & mask_;
        ++next[keys_[s]];
    });
}

void SphereGrid::sumUp(int thread) {
    const auto [first, last] = threads_->part(size_t(mask_) + 1, thread);
    uint32_t& sum = pieces_[size_t(thread)].sum;
    sum = 0;
    for (const Piece& other : pieces_)
        for (size_t k = first; k < last; ++k)
            sum += other.next[k];
}

void SphereGrid::begin(int thread) {
    uint32_t slot = 0;
    for (int before = 0; before < thread; ++before)
        slot += pieces_[size_t(before)].sum;
    const auto [first, last] = threads_->part(size_t(mask_) + 1, thread);
    for (size_t k = first; k < last; ++k) {
        starts_[k] = slot;
        for (Piece& piece : pieces_)
            slot += std::exchange(piece.next[k], slot);
    }
    if (last == size_t(mask_) + 1) starts_[last] = slot;
}

void SphereGrid::scatter(int thread, const GroupState& state) {
    std::vector<uint32_t>& next = pieces_[size_t(thread)].next;
    forSpheres(thread, state, [&](size_t s, const vec3& position, int molecule) {
        const uint32_t slot = next[keys_[s]]++;
        places_[slot] = {position, molecule};
        spheres_[slot] = int(s);
    });
}

void SphereGrid::build(const GroupState& state) {
    threads_->run([&](int thread) { count(thread, state); });
    threads_->run([&](int thread) { sumUp(thread); });
    threads_->run([&](int thread) { begin(thread); });
    threads_->run([&](int thread) { scatter(thread, state); });
}

void SphereGrid::meet(const Place& own, uint32_t from, uint32_t end, std::vector<int>& found) const {
    for (uint32_t slot = from; slot < end; ++slot) {
        const Place& other = places_[slot];
        const vec3 d = own.position - other.position;
        if (glm::dot(d, d) < near_ * near_ && own.molecule != other.molecule) found.push_back(int(slot));
    }
}

// A cell is twice as wide as a contact is long: only the eight on a sphere's side can hold one that it
// touches, four rows of two.
void SphereGrid::look(int slot, std::vector<int>& found) const {
    const Place& own = places_[size_t(slot)];
    const vec3 scaled = own.position * scale_;
    const ivec3 cell = cellAt(scaled);
    const vec3 inCell = scaled - vec3(cell);
    const int x = cell.x - (inCell.x < 0.5f);
    const int y[] = {cell.y, cell.y + (inCell.y < 0.5f ? -1 : 1)};
    const int z[] = {cell.z, cell.z + (inCell.z < 0.5f ? -1 : 1)};
    const auto first = ptrdiff_t(found.size());
    uint32_t seen[4];
    for (int r = 0; r < 4; ++r) {
        const uint32_t key = (rowKey(y[r & 1], z[r >> 1]) + uint32_t(x)) & mask_;
        seen[r] = key;
        const auto before = ptrdiff_t(found.size());
        if (key < mask_) {
            meet(own, starts_[key], starts_[key + 2], found);
        } else {
            meet(own, starts_[key], starts_[key + 1], found);
            meet(own, starts_[0], starts_[1], found);
        }
        // rows whose keys are next to each other share cells: what an earlier one has found is there twice
        for (int q = 0; q < r && ptrdiff_t(found.size()) > before; ++q) {
            if (((key - seen[q] + 1) & mask_) > 2) continue;
            const auto has = [&](int other) {
                return std::find(found.begin() + first, found.begin() + before, other) !=
                       found.begin() + before;
            };
            found.erase(std::remove_if(found.begin() + before, found.end(), has), found.end());
        }
    }
}

}  // namespace shoal::bench
