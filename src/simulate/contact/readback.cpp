#include "simulate/contact/readback.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "simulate/texture_layers.h"

namespace shoal {

namespace {

using gpu::Traffic;

// In a slot's count: its contacts, and that a collider may hold it (shaders/contact/flags.glsl).
constexpr uint32_t contactsMask = 0x1fffffffu, heldFlag = 0x20000000u, respondsFlag = 0x40000000u;

// All values of an array: with buffers as they lie; in fragments by number, layer after layer.
template <typename T>
std::vector<T> read(const ContactData& data, const std::string& name,
                    Traffic::Kind kind = Traffic::Kind::state) {
    if (data.textures) return readLayers<T>(data.arrays.texture(name), kind);
    const gpu::Buffer& buffer = data.arrays.buffer(name);
    std::vector<T> out(buffer.bytes() / sizeof(T));
    if (!out.empty()) buffer.download(kind, 0, out.data(), out.size() * sizeof(T));
    return out;
}

// The rest of it becomes zero.
template <typename T>
void write(ContactData& data, const std::string& name, std::vector<T> values) {
    if (data.textures) return writeLayers(data.arrays.texture(name), std::move(values));
    gpu::Buffer& buffer = data.arrays.buffer(name);
    values.resize(buffer.bytes() / sizeof(T));
    buffer.update(Traffic::Kind::state, 0, values.data(), values.size() * sizeof(T));
}

// Elements of a list's stride.
size_t strideOf(const ContactData& data) {
    if (!data.textures) return data.padded;
    const gpu::Texture& counts = data.arrays.texture("counts");
    return size_t(counts.width()) * size_t(counts.height());
}

// Entries of all elements, one after another.
std::vector<uint32_t> readLists(const ContactData& data, const std::string& name) {
    if (!data.textures) return read<uint32_t>(data, name);
    const auto lists = read<glm::uvec4>(data, name);  // four entries a texel
    const size_t stride = strideOf(data);
    std::vector<uint32_t> out;
    for (size_t e = 0; e < size_t(data.listLength); ++e)
        for (size_t slot = 0; slot < stride; ++slot)
            out.push_back(lists[e / 4 * stride + slot][int(e % 4)]);
    return out;
}

// How many contacts each sphere, or slot, remembers, with its flags.
std::vector<uint32_t> readCounts(const ContactData& data) {
    if (data.textures) return read<uint32_t>(data, "counts");
    std::vector<uint32_t> out;
    for (const glm::vec4& known : read<glm::vec4>(data, "warmStart"))
        out.push_back(std::bit_cast<uint32_t>(known.w) & ~respondsFlag);
    return out;
}

// The memory of fragments lies at the slots of the last step; with buffers a slot is a sphere.
ContactSlots readSlots(const ContactData& data) {
    const auto spheres = size_t(data.contact->spheres);
    ContactSlots out;
    out.stride = strideOf(data);
    out.slots.resize(spheres);
    std::iota(out.slots.begin(), out.slots.end(), 0u);
    if (data.textures) out.slots = read<uint32_t>(data, "slots");
    out.slots.resize(spheres);
    for (const uint32_t count : readCounts(data))
        out.counts.push_back(std::min(count & contactsMask, uint32_t(data.listLength)));
    out.lists = readLists(data, data.textures ? "lists" : "partners");
    out.pushes = read<glm::vec4>(data, data.textures ? "impulses" : "keptImpulses");
    out.anchors = read<glm::vec4>(data, data.textures ? "anchors" : "keptAnchors");
    out.known = read<glm::vec4>(data, "warmStart");
    out.loads = read<glm::vec4>(data, "loads");
    out.loads.resize(spheres);
    return out;
}

// Adds what colliders push, by sphere.
void readColliders(const ContactData& data, ContactSlots& out) {
    const auto spheres = size_t(data.contact->spheres);
    constexpr size_t most = size_t(ContactPlan::mostColliders);
    out.walls = read<glm::vec4>(data, "colliders");
    const auto pushes = read<glm::vec4>(data, "colliderImpulses");
    if (!data.textures) {
        out.walls.resize(2 * most * spheres);
        out.wallPushes.assign(pushes.begin(), pushes.begin() + ptrdiff_t(most * spheres));
        return;
    }
    out.walls = byElement(out.walls, out.stride, spheres);
    const auto counts = read<uint32_t>(data, "counts");
    for (const uint32_t slot : out.slots)
        for (size_t k = 0; k < most; ++k)
            out.wallPushes.push_back(counts[slot] == 0 ? glm::vec4(0)
                                                       : pushes[k * out.stride + slot] *
                                                             glm::vec4(glm::vec3(out.known[slot].w), 1));
}

void writeLists(ContactData& data, const std::string& name, const std::vector<uint32_t>& entries) {
    if (!data.textures) return write(data, name, entries);
    const size_t stride = strideOf(data);
    std::vector<glm::uvec4> lists(stride * size_t(data.listLength) / 4);
    for (size_t e = 0; e < size_t(data.listLength); ++e)
        for (size_t slot = 0; slot < stride; ++slot)
            lists[e / 4 * stride + slot][int(e % 4)] = entries[e * stride + slot];
    write(data, name, lists);
}

void writeColliders(ContactData& data, const ContactSlots& memory) {
    const auto spheres = size_t(data.contact->spheres);
    if (data.textures) {
        const size_t stride = strideOf(data);
        write(data, "colliders", byLayer(memory.walls, stride, spheres));
        return write(data, "colliderImpulses", byLayer(memory.wallPushes, stride, spheres));
    }
    std::vector<glm::vec4> normals;
    for (size_t i = 0; i < memory.walls.size(); i += 2)
        normals.push_back(memory.walls[i]);
    write(data, "oldNormals", normals);
    write(data, "colliderImpulses", memory.wallPushes);
}

}  // namespace

uint32_t droppedContacts(const ContactData& data) {
    const auto dropped = read<uint32_t>(data, "dropped", Traffic::Kind::control);
    const size_t count = data.textures ? size_t(data.contact->spheres) : 1;
    return std::accumulate(dropped.begin(), dropped.begin() + ptrdiff_t(count), 0u);
}

ContactConvergence convergenceOf(const ContactData& data) {
    const int iterations = data.contact->settings.iterations;
    const auto batches = read<glm::uvec4>(data, "batches", Traffic::Kind::control);
    if (batches[0].x == 0) return {0, 0.0f};
    if (iterations == 1) return {1, {}};
    size_t last = 0;
    while (int(last) + 1 < iterations / 2 && batches[last + 1].x > 0)
        ++last;
    return {2 * (int(last) + 1) + iterations % 2, std::bit_cast<float>(batches[last].w)};
}

float largestResidual(const ContactData& data) {
    uint32_t most = 0;
    for (const uint32_t bits : read<uint32_t>(data, "residuals", Traffic::Kind::control))
        most = std::max(most, bits);
    return std::bit_cast<float>(most);
}

std::vector<std::pair<int, int>> foundPairs(const ContactData& data) {
    std::vector<uint32_t> spheres;
    if (data.textures) {
        std::vector<uint32_t> slots = read<uint32_t>(data, "slots");
        spheres.resize(size_t(data.contact->spheres));
        for (size_t sphere = 0; sphere < spheres.size(); ++sphere)
            spheres[slots[sphere]] = uint32_t(sphere);
    } else {
        for (const glm::uvec2& pair : read<glm::uvec2>(data, "sorted"))
            spheres.push_back(pair.y);
        spheres.resize(size_t(data.contact->spheres));
    }
    const auto counts = read<uint32_t>(data, "counts"), lists = readLists(data, "lists");
    const size_t stride = strideOf(data);
    std::vector<std::pair<int, int>> out;
    for (size_t slot = 0; slot < spheres.size(); ++slot) {
        const size_t listed = std::min(size_t(counts[slot] & contactsMask), size_t(data.listLength));
        for (size_t e = 0; e < listed; ++e)
            out.emplace_back(std::minmax(int(spheres[slot]), int(spheres[lists[e * stride + slot]])));
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

ContactMemory readMemory(const ContactData& data) {
    if (!data.remembers) return {};
    const std::vector<uint32_t> counts = readCounts(data);
    if (!data.rests && std::all_of(counts.begin(), counts.end(), [](uint32_t count) { return count == 0; }))
        return {};
    ContactSlots in = readSlots(data);
    if (data.colliders) readColliders(data, in);
    ContactMemory out = bySphere(in);
    if (!data.rests) return out;
    // of what rests its load, of others where they were
    out.calm = read<glm::vec4>(data, "restPoses");
    const auto loads = read<glm::vec4>(data, "restLoads");
    out.calm.resize(in.loads.size());
    for (size_t sphere = 0; sphere < in.loads.size(); ++sphere)
        if (in.loads[sphere].w > 0) out.calm[sphere] = loads[sphere];
    return out;
}

void writeMemory(ContactData& data, const ContactMemory& memory) {
    if (!data.remembers) return;
    if (memory.counts.size() != size_t(data.contact->spheres)) {
        write<glm::vec4>(data, "warmStart", {});
        if (data.textures) write<uint32_t>(data, "counts", {});
        if (data.rests) write<glm::vec4>(data, "restPoses", {});
        return write<glm::vec4>(data, "loads", {});
    }
    ContactSlots in = bySlot(memory, strideOf(data), size_t(data.listLength));
    for (size_t sphere = 0; sphere < in.counts.size(); ++sphere)
        if (isHeld(in, sphere)) in.counts[sphere] |= heldFlag;
    for (size_t i = 0; i < in.known.size(); ++i)
        in.known[i].w = data.textures ? 1.0f : std::bit_cast<float>(in.counts[i] | respondsFlag);
    if (data.textures) {
        write(data, "counts", in.counts);
        write(data, "slots", in.slots);
    }
    writeLists(data, data.textures ? "lists" : "partners", in.lists);
    write(data, data.textures ? "impulses" : "keptImpulses", in.pushes);
    write(data, data.textures ? "anchors" : "keptAnchors", in.anchors);
    write(data, "warmStart", in.known);
    write(data, "loads", in.loads);
    if (data.rests) {
        write(data, "restPoses", memory.calm);
        write(data, "restLoads", memory.calm);
    }
    if (data.colliders && !in.walls.empty()) writeColliders(data, in);
}

}  // namespace shoal
