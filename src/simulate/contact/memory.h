// The memory of contacts between molecules from step to step (docs/contact.md), outside the GPU: part of a
// saved state, the same for every path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace shoal {

// Nothing is remembered: all are empty. Spheres have their numbers of compile/contact_plan.h.
struct ContactMemory {
    std::vector<uint32_t> counts;  // contacts of each sphere
    // The contacts of one sphere after another have the other sphere, and both parts of a contact's impulse
    // (shaders/contact/response/impulse.glsl).
    std::vector<uint32_t> partners;
    std::vector<glm::vec4> pushes, anchors;
    std::vector<glm::vec4> known;  // N s, of each sphere: the sum of what its contacts remember
    // The acceleration of each sphere's vertex by those impulses, m/s^2, with in w who moves it
    // (shaders/contact/rest/states.glsl); and its rest pose or, while it rests, its rest load
    // (shaders/contact/arrays.txt).
    std::vector<glm::vec4> loads, calm;
    // Each sphere that may lie on colliders has 6 texels of `colliders`, and 3 impulses, N s, with in
    // w how far they push it off, kg m.
    std::vector<glm::vec4> walls, wallPushes;

    bool operator==(const ContactMemory&) const = default;
};

// Fragments keep it like this, in the order of slots: entry e of slot s at e * stride + s.
struct ContactSlots {
    size_t stride = 0;
    std::vector<uint32_t> slots;          // of each sphere
    std::vector<uint32_t> counts, lists;  // lists: slots
    std::vector<glm::vec4> pushes, anchors, known;
    std::vector<glm::vec4> loads, walls, wallPushes;  // by sphere
};

// Whether a collider pushes on a sphere.
bool isHeld(const ContactSlots& memory, size_t sphere);

ContactMemory bySphere(const ContactSlots& from);
// Slots are spheres. Of more contacts than `entries` a sphere keeps the first.
ContactSlots bySlot(const ContactMemory& from, size_t stride, size_t entries);

}  // namespace shoal
