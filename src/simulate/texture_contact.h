// Contact of molecules with one another in fragment passes (OpenGL 3.3), between two substeps: on the
// ping-pong path, and on the fused one in fragments. Method, equations and what compute has beyond it:
// docs/contact.md; what there is: compile/contact_plan.h. The stages and their GLSL are those of
// simulate/molecule_contact.h:
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
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/texture.h"
#include "simulate/contact_passes.h"
#include "sort/network_sort.h"

namespace shoal {

// Where these passes read molecules, and change them.
class ContactState {
  public:
    virtual ~ContactState() = default;
    // Whether it is the fused step's, with which spheres may lie on triangles, touch their own molecule, and
    // answer walls within the response.
    virtual bool fused() const = 0;
    // The defines with which contact/spheres.frag reads a group.
    virtual std::vector<std::string> defines(size_t group) const = 0;
    // Binds what it reads then, beside the topology.
    virtual void bind(const gpu::Program& program, size_t group) = 0;
    // Adds to the vertices of a group what their spheres have gained; `bind` gives a program in use slots,
    // counts, impulses, shifts and shapes, in texture units from `firstUnit` on.
    using Gains = std::function<void(const gpu::Program& program, int firstUnit)>;
    virtual void apply(size_t group, const Gains& bind) = 0;
};

class TextureContact : public ContactPasses<ContactState> {
  public:
    static constexpr int longestList = ContactPlan::fragmentList;

    // Borrows the plan and the tables; `state`: only for its defines. Blending, tests and masks are off in a
    // step. Error: out of memory; the driver refuses a shader.
    TextureContact(gpu::Context& context, const std::string& shaderRoot, const Plan& plan,
                   const Tables& tables, const ContactState& state, gpu::ProgramCache* cache);

    uint32_t dropped() const override;
    int listLength() const override { return longestList; }
    std::vector<std::pair<int, int>> found() const override;
    size_t bytes() const override;

  private:
    using Into = std::vector<const gpu::Texture*>;

    void makeTextures(gpu::Context& context);
    void makePrograms(gpu::Context& context, const std::string& shaderRoot, gpu::ProgramCache* cache);
    // Holds what belongs to one group with contact; sum and spread only where there are spheres on triangles.
    struct OfGroup {
        gpu::Program spheres, effectiveSum, spread;
        gpu::Texture shapes;
    };
    OfGroup makeGroup(gpu::Context& context, const ContactGroup& group, const ContactState& state,
                      const std::string& shaderRoot, gpu::ProgramCache* cache) const;
    gpu::Texture table(gpu::Context& context, gpu::Format format, size_t texels, const void* data,
                       const char* label) const;
    void makeTables(gpu::Context& context);

    void makeSpheres(const Frame& frame, ContactState& state);
    void setWalls(const gpu::Program& program, const ContactGroup& group, const Frame& frame) const;
    const gpu::Program& useGroup(const gpu::Program& program, size_t group) const;
    void sortKeys(NetworkSort& sort, bool staggered);
    void buildGrid(const Frame& frame, ContactState& state) override;
    void search(ContactState& state) override;
    int bindResponse(const gpu::Program& program, const Times& times) const;  // the first unit that is free
    void runNearest(ContactState& state, const Times& times) override;
    void prepare(ContactState& state, const Times& times) override;
    void relax(ContactState& state, const Times& times, float momentum) override;
    void settle(ContactState& state, const Times& times) override;
    void apply(ContactState& state, const Times& times) override;

    void draw(const Into& into, int firstRow, int rows);
    void drawAll(const Into& into);  // the rows of all spheres
    int rowsOf(int numbers) const;

    int rowBits_;
    bool triangles_ = false, self_ = false, walls_ = false;
    std::vector<OfGroup> groups_;  // with contact
    gpu::Program keys_, starts_, order_, slots_, find_;
    NetworkSort sort_;
    std::optional<NetworkSort> staggered_;
    gpu::Texture spherePlaces_, sphereMotions_, sphereCells_, places_, motions_, cells_;
    gpu::Texture startsOf_, slotsOf_, lists_, effectiveCounts_, shifts_, materials_;
    gpu::Texture sphereWalls_, nearWalls_, wallFriction_;  // where there are walls
    gpu::Texture diagonals_, besides_, velocities_;        // where spheres lie on triangles
    gpu::Texture apart_, groupsOf_;                        // where molecules touch themselves
    std::array<gpu::Texture, 2> counts_;
    size_t countsSide_ = 0;
    std::array<gpu::Texture, 3> impulses_, pushes_;
    gpu::Framebuffers targets_;
    gpu::VertexArray noAttributes_;
};

}  // namespace shoal
