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
//   contact response   prepare, constrain, relax, settle (or `nearest`), each in a draw or several, as
//                      many entries a draw as there are targets, and then their sums
//                      gains     what all that does to a vertex
//                      apply     into the state
//
// Data by number (of a sphere, slot or key) lie in rows of 2^rowBits texels (ContactPlan::rowBits); lists in
// layers of four entries, what is known of an entry in a layer each.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/framebuffer.h"
#include "gpu/named_arrays.h"
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
    // Adds to the vertices of a group what their spheres have gained; `bind` gives a program in use `gains`
    // and its first sphere.
    using Gains = std::function<void(const gpu::Program& program)>;
    virtual void apply(size_t group, const Gains& bind) = 0;
};

class TextureContact : public ContactPasses<ContactState> {
  public:
    static constexpr int longestList = ContactPlan::fragmentList;
    // OpenGL 3.3 promises eight draw buffers: relax draws so many entries at once, and prepare half as many.
    static constexpr int entriesADraw = 8;

    // Borrows the plan and the tables; `state`: only for its defines. Blending, tests and masks are off in a
    // step. Error: out of memory; the driver refuses a shader.
    TextureContact(gpu::Context& context, const Plan& plan, const Tables& tables, const ContactState& state);

    // Binds to the step of a group of the plan what its contacts remember, if it has any.
    void bindLoads(const gpu::Program& program, size_t group) const;

    uint32_t dropped() const override;
    int listLength() const override { return longestList; }
    std::vector<std::pair<int, int>> found() const override;
    ContactMemory memory() const override;
    void remember(const ContactMemory& memory);
    size_t bytes() const override;

  private:
    using Into = std::vector<gpu::ColorTarget>;

    void makeTextures(gpu::Context& context);
    void nameTextures();
    void makePrograms(gpu::Context& context);
    // Holds what belongs to one group with contact.
    struct OfGroup {
        gpu::Program spheres, walls, effectiveSum, spread, gains;
        gpu::Texture shapes;
    };
    OfGroup makeGroup(gpu::Context& context, const ContactGroup& group, const ContactState& state) const;
    gpu::Texture table(gpu::Context& context, gpu::Format format, size_t texels, const void* data,
                       const char* label) const;
    void makeTables(gpu::Context& context);

    void makeSpheres(const Frame& frame, ContactState& state);
    void makeWalls(const Frame& frame, ContactState& state);
    void sortKeys(NetworkSort& sort, bool staggered);
    void buildGrid(const Frame& frame, ContactState& state) override;
    void search(ContactState& state, const Times& times) override;
    // Use a program, with all textures that it declares but those of the state.
    const gpu::Program& with(const gpu::Program& program) const;
    const gpu::Program& withResponse(const gpu::Program& program, const Times& times) const;
    const gpu::Program& withGroup(const gpu::Program& program, size_t group) const;
    void runNearest(ContactState& state, const Times& times) override;
    void prepare(ContactState& state, const Times& times) override;
    void countEffective();
    void constrain(const Times& times);
    void relax(ContactState& state, const Times& times, int iteration) override;
    void spread(ContactState& state, const gpu::Texture& earlier, float momentum);
    void settle(ContactState& state, const Times& times) override;
    void apply(ContactState& state, const Times& times) override;

    void draw(const Into& into, int firstRow, int rows);
    void drawAll(const Into& into);                  // the rows of all spheres
    void drawGroup(const Into& into, size_t group);  // those of a group's spheres, by number
    int rowsOf(int numbers) const;
    int spheresIn(const ContactGroup& group) const;

    int rowBits_;
    std::vector<OfGroup> groups_;  // with contact
    gpu::Program keys_, starts_, order_, slot_, find_, nearest_;
    gpu::Program prepare_, prepareSums_, constrain_, relax_, relaxSums_, settle_;
    NetworkSort sort_;
    std::optional<NetworkSort> staggered_;
    gpu::Texture spherePlaces_, sphereMotions_, sphereCells_, places_, motions_, cells_;
    gpu::Texture startsOf_, materials_, apart_, groupsOf_;
    // This step's, and what the last one has left to it.
    std::array<gpu::Texture, 2> slots_, counts_, lists_, anchors_, known_, nearWalls_;
    gpu::Texture loads_;
    gpu::Texture normals_, amounts_;  // shaders/contact/constraint.glsl
    // In turn: the last stage's, those before, the next.
    std::array<gpu::Texture, 3> pushes_, wallPushes_, totals_;
    gpu::Texture effectiveCounts_, contactSums_, motionsNow_, bodies_, gains_;
    gpu::NamedArrays arrays_;  // all above, by their names in the shaders
    gpu::Framebuffers targets_;
};

}  // namespace shoal
