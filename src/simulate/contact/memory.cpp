#include "simulate/contact/memory.h"

#include <algorithm>
#include <numeric>

namespace shoal {

bool isHeld(const ContactSlots& memory, size_t sphere) {
    const size_t walls = memory.wallPushes.size() / std::max(memory.counts.size(), size_t(1));
    for (size_t i = walls * sphere; i < walls * (sphere + 1); ++i)
        if (memory.wallPushes[i] != glm::vec4(0)) return true;
    return false;
}

ContactMemory bySphere(const ContactSlots& from) {
    ContactMemory out;
    const size_t spheres = from.slots.size();
    std::vector<uint32_t> sphereOf(from.stride);
    for (size_t sphere = 0; sphere < spheres; ++sphere)
        sphereOf[from.slots[sphere]] = uint32_t(sphere);
    for (const uint32_t slot : from.slots) {
        out.counts.push_back(from.counts[slot]);
        out.known.emplace_back(glm::vec3(from.known[slot]), 0.0f);
        for (size_t e = 0; e < from.counts[slot]; ++e) {
            const size_t entry = e * from.stride + slot;
            out.partners.push_back(sphereOf[from.lists[entry]]);
            out.pushes.push_back(from.pushes[entry]);
            out.anchors.push_back(from.anchors[entry]);
        }
    }
    out.loads = from.loads;
    out.calm.resize(spheres);
    out.walls = from.walls;
    out.wallPushes = from.wallPushes;
    return out;
}

ContactSlots bySlot(const ContactMemory& from, size_t stride, size_t entries) {
    ContactSlots out;
    const size_t spheres = from.counts.size();
    out.stride = stride;
    out.slots.resize(spheres);
    std::iota(out.slots.begin(), out.slots.end(), 0u);
    out.lists.resize(entries * stride);
    out.pushes.resize(entries * stride);
    out.anchors.resize(entries * stride);
    size_t first = 0;
    for (size_t sphere = 0; sphere < spheres; ++sphere) {
        const size_t count = std::min(size_t(from.counts[sphere]), entries);
        out.counts.push_back(uint32_t(count));
        for (size_t e = 0; e < count; ++e) {
            out.lists[e * stride + sphere] = from.partners[first + e];
            out.pushes[e * stride + sphere] = from.pushes[first + e];
            out.anchors[e * stride + sphere] = from.anchors[first + e];
        }
        first += from.counts[sphere];
    }
    out.known = from.known;
    out.loads = from.loads;
    out.walls = from.walls;
    out.wallPushes = from.wallPushes;
    return out;
}

}  // namespace shoal
