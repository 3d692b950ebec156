// Contact of molecules with one another on the ping-pong path (OpenGL 3.3): fragment passes between two
// substeps. Method, equations and what the other path has beyond it: docs/contact.md; what there is:
// compile/contact_plan.h. The stages and their GLSL are those of simulate/molecule_contact.h:
//
//   contact grid       spheres   records of every sphere from the state, a texel each
//                      keys      of their cells, two a texel
//                      sort      keys ascending (bitonic, sort/network_sort.h)
//                      starts    where each cell of the table begins, by bisection
//                      order     records in the order of the keys
//                      slots     of a sphere: its place in that order
//   contact search     find      the spheres that each touches (or `neighbors`: some of them)
//   contact response   respond   the impulses of all contacts, in Jacobi iterations (or `nearest`)
//                      apply     into the state
//
// Data by number (of a sphere, slot or key) lie in rows of 2^rowBits texels (ContactPlan::rowBits); lists and
// pushes in layers of four entries.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/texture.h"
#include "simulate/contact_passes.h"
#include "simulate/texture_state.h"
#include "sort/network_sort.h"

namespace shoal {

class TextureContact : public ContactPasses<TextureState> {
  public:
    // Entries of a list: with what else a pass draws, within the 8 draw buffers that OpenGL 3.3 promises.
    static constexpr int longestList = 24;

    // Borrows the plan and the tables. A step reads the current sides of positions and velocities and writes
    // the others; blending, tests and masks are off in it. Error: out of memory; the driver refuses a shader.
    TextureContact(gpu::Context& context, const std::string& shaderRoot, const Plan& plan,
                   const Tables& tables, gpu::ProgramCache* cache);

    uint32_t dropped() const override;
    int listLength() const override { return longestList; }
    std::vector<std::pair<int, int>> found() const override;
    size_t bytes() const override;

  private:
    struct GroupPrograms {
        gpu::Program spheres, apply;
    };
    using Into = std::vector<const gpu::Texture*>;

    void makeTextures(gpu::Context& context);
    void makePrograms(gpu::Context& context, const std::string& shaderRoot, gpu::ProgramCache* cache);
    void makeGroup(gpu::Context& context, const ContactGroup& group, const std::string& shaderRoot,
                   gpu::ProgramCache* cache);

    void makeSpheres(TextureState& state);
    void sortKeys(NetworkSort& sort, bool staggered);
    void buildGrid(const Frame& frame, TextureState& state) override;
    void search(TextureState& state) override;
    int bindResponse(const gpu::Program& program, const Times& times) const;  // the first unit that is free
    void runNearest(TextureState& state, const Times& times, const Totals& totals) override;
    void runEffective(TextureState& state, const Times& times) override;
    void runStage(TextureState& state, const gpu::Program& program, const Times& times,
                  const Totals& totals) override;
    void apply(TextureState& state, size_t impulses) override;

    void bindState(const gpu::Program& program, const ContactGroup& group, TextureState& state) const;
    void draw(TextureState& state, const Into& into, int firstRow, int rows) const;
    void drawAll(TextureState& state, const Into& into) const;  // the rows of all spheres
    int rowsOf(int numbers) const;

    int rowBits_;
    std::vector<GroupPrograms> groups_;
    gpu::Program keys_, starts_, order_, slots_;
    NetworkSort sort_;
    std::optional<NetworkSort> staggered_;
    gpu::Texture spherePlaces_, sphereMotions_, sphereCells_, places_, motions_, cells_;
    gpu::Texture startsOf_, slotsOf_, lists_, effectiveCounts_, shifts_, materials_;
    std::array<gpu::Texture, 2> counts_;
    size_t countsSide_ = 0;
    std::array<gpu::Texture, 3> impulses_, pushes_;
    gpu::VertexArray noAttributes_;
};

}  // namespace shoal
