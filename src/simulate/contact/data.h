// All stages of contact share the arrays on the GPU (shaders/contact/arrays.txt), the facts of the scene's
// contact, and the ways in which programs are made and run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compile/path.h"
#include "gpu/arrays.h"
#include "gpu/program.h"
#include "simulate/contact/facts.h"
#include "simulate/contact/memory.h"
#include "simulate/contact/state.h"
#include "simulate/step.h"
#include "simulate/tables.h"

namespace shoal {

// The times of a step of contact.
struct ContactStep {
    double step;       // s
    double restSpeed;  // m/s
    double substep;    // s
};

class ContactData : public ContactFacts {
  public:
    // Borrows all of them. `asOnGpu`: the passes that suit a GPU, or a CPU rasteriser, whatever the context
    // is. Error: more spheres than the context can hold, with how many it can; out of memory.
    ContactData(gpu::Context& usedContext, const Plan& usedPlan, const Tables& usedTables,
                ContactState& usedState, std::optional<bool> asOnGpu);

    // Lists with buffers are as long as the plan's, or as the context has room for, but no shorter than this:
    // as many as touch a sphere of their size at once without overlap.
    static constexpr size_t shortestList = 12;
    // Cells that a workgroup adds up (shaders/contact/grid/starts.pass.glsl).
    static constexpr size_t cellTile = 1024;
    // Where the workgroups of shaders/contact/rest/mark_groups.glsl begin, in bytes.
    static constexpr size_t awakeGroups = 0, markedGroups = 3 * sizeof(uint32_t),
                            struckGroups = 6 * sizeof(uint32_t);
    // Spheres that a context holds in buffers, with the shortest lists.
    static size_t most(const gpu::ContextInfo& info, const ContactPlan& contact);

    // A stage of all spheres, and of one group: FILE.pass.glsl below the shaders' root. Where a file has
    // several stages, the defines say which it is, and `name` what it is called; else it is called as its
    // file.
    gpu::Program stage(const std::string& file, const std::vector<std::string>& defines = {},
                       const std::string& name = {}) const;
    gpu::Program groupStage(const ContactGroup& group, const std::string& file,
                            const std::vector<std::string>& defines = {}, const std::string& name = {}) const;
    const gpu::Program& use(const gpu::Program& program) const { return arrays.use(program); }
    // With what all stages of the response are given.
    const gpu::Program& withResponse(const gpu::Program& program, const ContactStep& times) const;
    // With a part of a group: its state, and its spheres.
    const gpu::Program& withPart(const gpu::Program& program, const ContactGroup& group, size_t part) const;
    static void setTimes(const gpu::Program& program, const ContactStep& times);
    // Run what respond, one of all stages of the response.
    void runResponding(const gpu::Program& program);
    void runAll(const gpu::Program& program) { arrays.run(program, 0, contact->spheres); }

    const GroupPlan& planOf(const ContactGroup& group) const { return plan->groups[group.group]; }
    // Whether its spheres press on colliders within the response.
    bool collides(const ContactGroup& group) const { return colliders && planOf(group).needs.collide; }
    // Whether several spheres act on a vertex.
    bool manyAct(const ContactGroup& group) const { return group.triangles || isRigid(group); }
    bool isRigid(const ContactGroup& group) const { return rigid && planOf(group).rigid; }
    int keyMask() const { return (1 << contact->tableBits) - 1; }
    // Spheres of a part: the first, and how many.
    struct Spheres {
        int first, count;
    };
    Spheres spheresOf(const ContactGroup& group, const MoleculeRange& part) const {
        return {group.firstSphere + part.first * group.spheresOf, part.count * group.spheresOf};
    }
    // Calls visit(number of the group with contact, number of its part, part) for the parts of all groups.
    template <typename Visit>
    void forParts(const Visit& visit) const {
        for (size_t g = 0; g < contact->groups.size(); ++g) {
            const std::vector<MoleculeRange> parts = state->parts(contact->groups[g].group);
            for (size_t p = 0; p < parts.size(); ++p)
                visit(g, p, parts[p]);
        }
    }
    // The numbers of the colliders of a group.
    void setColliders(const gpu::Program& program, const ContactGroup& group, const Frame& frame) const;

    gpu::Context* context;
    const Plan* plan;
    const ContactPlan* contact;
    const Tables* tables;
    ContactState* state;
    size_t padded;  // spheres, to whole workgroups
    int listLength;
    gpu::ArrayTable table;
    gpu::Arrays arrays;

  private:
    gpu::ArraySizes sizes() const;
    void giveTables();
    gpu::ProgramOptions options(const std::string& file, const std::string& label) const;

    std::vector<int> firstShapes_;  // of each group with contact
};

}  // namespace shoal
