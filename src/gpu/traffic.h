// Bytes that crossed the bus, so that "the GPU keeps the state" can be asserted instead of believed.
//
// A frame after start-up moves 0 bytes of state and at most 256 bytes of control. Uniforms are not counted
// one by one: they are a few hundred bytes of arguments, not data. Textures and buffers are.
#pragma once

#include <cstddef>
#include <cstdint>

namespace shoal::gpu {

struct Traffic {
    enum class Kind {
        state,       // particle data: positions, velocities, normals; set-up and exports only
        parameters,  // tables, meshes, images, fields: what a scene is made of, and pictures that come back
        control,     // watchdog, counters, timers
        births,      // places that allocators on the CPU hand out, 4 bytes a newborn
    };
    static constexpr const char* names[] = {"state", "parameters", "control",
                                            "births"};  // in the order of Kind
    static constexpr int kinds = 4;
    static constexpr uint64_t controlBytesPerFrame = 256;  // at most, all readers together

    uint64_t uploaded[kinds] = {};
    uint64_t readBack[kinds] = {};

    void countUpload(Kind kind, size_t bytes) { uploaded[static_cast<size_t>(kind)] += bytes; }
    void countReadBack(Kind kind, size_t bytes) { readBack[static_cast<size_t>(kind)] += bytes; }
    uint64_t up(Kind kind) const { return uploaded[static_cast<size_t>(kind)]; }
    uint64_t down(Kind kind) const { return readBack[static_cast<size_t>(kind)]; }
    uint64_t total(Kind kind) const { return up(kind) + down(kind); }
    void reset() { *this = Traffic{}; }
};

// Returns the bytes that crossed between two readings of the counters.
inline Traffic operator-(const Traffic& after, const Traffic& before) {
    Traffic difference;
    for (int i = 0; i < Traffic::kinds; ++i) {
        difference.uploaded[i] = after.uploaded[i] - before.uploaded[i];
        difference.readBack[i] = after.readBack[i] - before.readBack[i];
    }
    return difference;
}

}  // namespace shoal::gpu
