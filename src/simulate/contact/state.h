// Where contact reads molecules, and changes them: in the state of each path.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gpu/array_table.h"
#include "gpu/program.h"
#include "simulate/packed_state.h"

namespace shoal {

class ContactState {
  public:
    virtual ~ContactState() = default;
    using Form = gpu::ArrayTable::Form;
    virtual Form form() const = 0;
    // Whether it is the fused step's, with which spheres may lie on triangles, touch their own molecule, and
    // answer colliders within the response.
    virtual bool fused() const { return true; }
    // The defines with which shaders read a group.
    virtual std::vector<std::string> defines(size_t group) const = 0;
    // What one pass may take.
    virtual std::vector<MoleculeRange> parts(size_t group) const = 0;
    // Gives a program in use what it reads of a part of the state and, with buffers, changes.
    virtual void bind(const gpu::Program& program, size_t group, size_t part) = 0;
    // In fragments: adds to the vertices of a group what their spheres have gained; `give` gives a program in
    // use `gains` and its first sphere.
    using Gains = std::function<void(const gpu::Program& program)>;
    virtual void apply(size_t, const Gains&) {}
};

}  // namespace shoal
