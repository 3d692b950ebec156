// The fused path's state: buffers of 4-vectors, a set for each group, packed as shaders/fused/state.glsl
// says.
//
//   state     positions, then velocities (then the last changes of both), 3 floats a vertex
//             (two sides in turn; in place: one)
//   record    xyz anchor, m; w: 1 + seed, negative once pins are released    (a lane writes only its own)
//   constant  x scale, y phase, rad; only where instances differ
//   normal    3 floats a vertex, unit; only where something is drawn
//   matrix    what bdf2-newton works on, of the molecules of one dispatch
//
// A group that is larger than the device's blocks is split into parts, each a range of whole workgroups of
// molecules.
#pragma once

#include <array>
#include <vector>

#include "gpu/buffer.h"
#include "simulate/packed_state.h"

namespace shoal {

class GroupBuffers : public PackedState {
  public:
    // `together`: molecules that a workgroup takes. `largestPart`: molecules that one dispatch may take, 0
    // for no limit of its own. Error: out of memory; says of which group and how much it would take.
    GroupBuffers(gpu::Context& context, const GroupPlan& group, bool normals, bool inPlace, int together,
                 size_t largestPart);

    struct Part : MoleculeRange {
        std::array<gpu::BufferTexture, 2> state;
        gpu::BufferTexture record, constant, normal, steering;
    };
    const std::vector<Part>& parts() const { return parts_; }
    const gpu::BufferTexture& oldState(const Part& part) const { return part.state[size_t(current_)]; }
    // Locates what a dispatch over the part writes.
    struct Range {
        const gpu::Buffer* buffer;
        size_t offset, bytes;
    };
    Range newState(const Part& part) const {
        return rangeOf(part, state_[size_t(inPlace_ ? 0 : 1 - current_)], layout().stateElements());
    }
    Range currentState(const Part& part) const {  // to be changed between dispatches
        return rangeOf(part, state_[size_t(current_)], layout().stateElements());
    }
    Range records(const Part& part) const { return rangeOf(part, records_, 1); }
    Range constants(const Part& part) const { return rangeOf(part, constants_, 1); }
    Range normals(const Part& part) const { return rangeOf(part, normals_, layout().positionElements()); }
    const gpu::Buffer& steering() const { return steering_; }  // of all parts
    int together() const { return together_; }

    std::vector<MoleculeRange> ranges() const override { return {parts_.begin(), parts_.end()}; }
    void bindRead(const gpu::Program& program, size_t part) const override;
    // Gives a program in use what a step, or a pass that computes normals, writes of a part.
    void bindNew(const gpu::Program& program, const Part& part) const;
    void run(const gpu::Program& program, size_t part, Output output) const override;
    void flip() override { current_ = inPlace_ ? 0 : 1 - current_; }
    bool hasBefore() const override { return !inPlace_; }

    bool hasConstants() const override { return bool(constants_); }
    bool hasNormals() const override { return bool(normals_); }

  private:
    bool hasSteering() const override { return bool(steering_); }
    template <typename Self>
    static auto& bufferOf(Self& self, Values values);
    void upload(Values values, size_t first, const std::vector<glm::vec4>& packed) override;
    std::vector<glm::vec4> download(Values values) const override;
    std::vector<glm::vec4> download(Values values, size_t first, size_t count) const override;
    // A part of a buffer with so many 4-vectors a molecule.
    Range rangeOf(const Part& part, const gpu::Buffer& buffer, int elements) const;
    int workgroups(const Part& part) const { return (part.count + together_ - 1) / together_; }
    void split(gpu::Context& context, size_t largestPart);

    bool inPlace_ = false;
    int numbers_;  // doubles of a molecule that is worked on (compile/newton.h)
    int together_;
    int current_ = 0;
    std::array<gpu::Buffer, 2> state_;
    gpu::Buffer records_, constants_, normals_, steering_, matrixNumbers_;
    std::vector<Part> parts_;
};

// Binds a range where the program's storage block is.
void store(const gpu::Program& program, const char* block, const GroupBuffers::Range& range);

}  // namespace shoal
