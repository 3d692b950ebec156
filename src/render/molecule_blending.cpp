// Of MoleculeDrawer: what is blended.
#include <algorithm>

#include "render/molecule_drawer.h"
#include "render/molecule_state.h"

namespace shoal {

// The blends of groups that give the same picture in any order.
static bool commute(const std::vector<Blend>& blends) {
    return std::all_of(blends.begin(), blends.end(),
                       [&](Blend blend) { return blend == blends.front() && blend != Blend::alpha; });
}

bool MoleculeDrawer::blends(const Scene& scene, const Plan& plan) {
    return std::any_of(plan.groups.begin(), plan.groups.end(), [&](const GroupPlan& group) {
        return group.count > 0 && scene.groups[group.index].molecule.material.blend != Blend::none;
    });
}

void MoleculeDrawer::makeOrders(gpu::Context& context, const Scene& scene, const Plan& plan, int slabs) {
    std::vector<Blend> blends;
    for (const Drawn& group : groups_)
        if (group.blend != Blend::none) blends.push_back(group.blend);
    blends_ = !blends.empty();
    const bool inSlabs = blends.size() > 1 && !commute(blends) && slabs > 1;
    int most = -1;
    for (size_t i = 0; i < groups_.size(); ++i) {
        Drawn& group = groups_[i];
        if (group.blend == Blend::none) continue;
        const GroupPlan& groupPlan = plan.groups[group.index];
        const Material& material = scene.groups[groupPlan.index].molecule.material;
        const DrawSort sort = group.blend == Blend::alpha ? material.sort : DrawSort::none;
        if (sort == DrawSort::none && !inSlabs) continue;
        group.order = std::make_unique<DrawOrder>(context, shaderRoot_, groupPlan, group.index, sort,
                                                  material.spreadFrames);
        std::vector<std::string>& defines = group.litOptions.defines;
        defines.push_back("ORDERED");
        if (inSlabs) defines.push_back(group.order->exact() ? "SLAB_DRAWS" : "SLABS");
        if (inSlabs && group.order->exact()) {
            const bool indexed = group.indexCount > 0;
            group.slabDraws =
                std::make_unique<SlabDraws>(context, shaderRoot_, slabs, *group.order,
                                            indexed ? group.indexCount : group.vertexCount, indexed);
        }
        for (const std::string& define : group.order->defines())
            defines.push_back(define);
        // The slabs are cut by the largest group that is sorted, else by the largest.
        const int weight = group.order->sorted() ? group.count : 0;
        if (weight > most) {
            most = weight;
            slabsOf_ = i;
        }
    }
    if (inSlabs) slabs_ = std::make_unique<DepthSlabs>(context, shaderRoot_, slabs, *groups_[slabsOf_].order);
}

void MoleculeDrawer::order(const StateView& state, const Eye& eye) {
    for (const Drawn& group : groups_)
        if (group.order) group.order->update(state, eye);
    if (!slabs_) return;
    slabs_->update(*groups_[slabsOf_].order);
    for (const Drawn& group : groups_)
        if (group.slabDraws) group.slabDraws->update(*group.order, *slabs_);
}

// The alpha of the picture stays 1 throughout.
static void setBlend(Blend blend) {
    switch (blend) {
    case Blend::none:
        glDisable(GL_BLEND);
        return;
    case Blend::alpha:
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        break;
    case Blend::additive:
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE, GL_ZERO, GL_ONE);
        break;
    case Blend::multiplicative:
        glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
        break;
    }
    glEnable(GL_BLEND);
}

void MoleculeDrawer::drawBlended(const StateView& state, const Eye& eye, const Lighting& lighting) {
    const int count = slabs_ ? slabs_->count() : 1;
    for (int slab = 0; slab < count; ++slab) {
        for (size_t i = 0; i < groups_.size(); ++i) {
            // The slabs begin at molecules of one group, which are the farthest there: it goes first.
            Drawn& group = groups_[i == 0 ? slabsOf_ : i <= slabsOf_ ? i - 1 : i];
            if (group.blend == Blend::none) continue;
            setBlend(group.blend);
            const gpu::Program& program = useLit(group, state, eye, lighting);
            program.set("opacity", group.opacity);
            if (group.order) group.order->bind(program);
            if (slabs_)
                drawSlab(program, group, state, slab);
            else
                submit(program, group, state);
        }
    }
    setBlend(Blend::none);
}

void MoleculeDrawer::drawSlab(const gpu::Program& program, const Drawn& group, const StateView& state,
                              int slab) const {
    program.set("slab", slab);
    if (!group.slabDraws) {
        slabs_->bind(program);
        return submit(program, group, state);
    }
    group.slabDraws->bind(program);
    bindState(program, state, group.index, group.rows,
              state.buffers ? &(*state.buffers)[group.index].parts()[0] : nullptr);
    group.corners.bind();
    if (group.indexCount == 0) glEnable(GL_PROGRAM_POINT_SIZE);
    group.slabDraws->draw(slab);
    glDisable(GL_PROGRAM_POINT_SIZE);
}

const DrawOrder* MoleculeDrawer::orderOf(size_t group) const {
    for (const Drawn& drawn : groups_)
        if (drawn.index == group) return drawn.order.get();
    return nullptr;
}

}  // namespace shoal
