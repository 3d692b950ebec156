// The state of a group as the fused step keeps it, packed into 4-vectors as shaders/fused/state.glsl says,
// wherever these lie: in buffers (simulate/buffer_state.h) or in the layers of textures
// (simulate/layer_state.h). This packs and unpacks them.
#pragma once

#include <array>
#include <vector>

#include "compile/plan.h"
#include "gpu/program.h"

namespace shoal {

struct MoleculeRange {
    int first = 0, count = 0;
};

class PackedState {
  public:
    virtual ~PackedState() = default;

    // What one dispatch, or the draws of one pass, take of the molecules.
    virtual std::vector<MoleculeRange> ranges() const = 0;
    // Gives a program in use what it reads of a range: the state, records, constants and steering.
    virtual void bindRead(const gpu::Program& program, size_t range) const = 0;
    // Runs a program in use over a range, into the other side of the state, the normals, or nothing (a draw
    // inside a query).
    enum class Output { state, normals, nothing };
    virtual void run(const gpu::Program& program, size_t range, Output output) const = 0;
    virtual void flip() = 0;
    // Whether the side before the last frame is kept.
    virtual bool hasBefore() const = 0;

    void write(const GroupPlan& group, const GroupState& state);
    GroupState read(const GroupPlan& group) const { return readSide(group, false); }
    // Reads so many molecules, and little beside them. Their scales and phases are in `looks`.
    GroupState readSome(size_t first, size_t count) const;
    // The side before the last frame, with two of them.
    GroupState readBefore(const GroupPlan& group) const { return readSide(group, true); }
    std::vector<glm::vec3> readNormals(
        const GroupPlan& group) const;  // index = molecule * vertexCount + vertex

    const BufferLayout& layout() const { return layout_; }
    virtual bool hasConstants() const = 0;
    virtual bool hasNormals() const = 0;

  protected:
    enum class Values { state, stateBefore, records, recordsBefore, constants, steering, normals };

    // `molecules`: with what the last are padded to; `together`: those that lie in one block.
    PackedState(const GroupPlan& group, size_t molecules, size_t together);
    int elements(Values values) const;  // 4-vectors a molecule
    size_t molecules() const { return molecules_; }
    // Scales and phases at the start.
    void writeConstants(const GroupPlan& group);

    // The 4-vectors of so many molecules, which are whole blocks and rows, from `first` on.
    virtual void upload(Values values, size_t first, const std::vector<glm::vec4>& packed) = 0;
    virtual std::vector<glm::vec4> download(Values values) const = 0;
    // The 4-vectors of so many molecules, one molecule behind the other.
    virtual std::vector<glm::vec4> download(Values values, size_t first, size_t count) const = 0;
    virtual bool hasSteering() const = 0;

  private:
    template <typename Fill>
    void uploadPieces(Values values, size_t count, Fill fill);
    void writeMotion(size_t count, const GroupState& state);
    void writeRecords(size_t count, const GroupState& state);
    GroupState readSide(const GroupPlan& group, bool before) const;

    BufferLayout layout_;
    size_t molecules_, together_;
    std::vector<uint32_t> seeds_;
};

}  // namespace shoal
