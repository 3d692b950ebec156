#include "render/drawn_groups.h"

#include <algorithm>

#include "gpu/gl.h"
#include "gpu/shader_source.h"

namespace shoal {

DrawnGroups::DrawnGroups(gpu::Context& context, const Scene& scene, const Plan& plan,
                         const Lighting& lighting, int slabs, double pixelsPerMeter) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& groupPlan = plan.groups[g];
        if (groupPlan.count == 0) continue;
        const Group& group = scene.groups[groupPlan.index];
        const Material& material = group.molecule.material;
        Drawn drawn;
        if (group.particle)
            drawn.drawer = std::make_unique<ParticleDrawer>(context, *programs_, *group.particle, groupPlan,
                                                            g, lighting, pixelsPerMeter);
        else
            drawn.drawer =
                std::make_unique<MoleculeDrawer>(context, *programs_, group, groupPlan, g, lighting);
        if (group.colorBy) drawn.drawer->colorBy(*group.colorBy);
        drawn.blend = material.blend;
        if (drawn.blend == Blend::alpha) drawn.sort = material.sort;
        drawn.spreadFrames = material.spreadFrames;
        drawn.scale = largestScale(groupPlan);
        groups_.push_back(std::move(drawn));
    }
    makeLevels(context, plan);
    makeOrders(context, plan, slabs);
}

bool DrawnGroups::blends(const Scene& scene, const Plan& plan) {
    return std::any_of(plan.groups.begin(), plan.groups.end(), [&](const GroupPlan& group) {
        return group.count > 0 && scene.groups[group.index].molecule.material.blend != Blend::none;
    });
}

bool DrawnGroups::readsDepth() const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [](const Drawn& group) { return group.drawer->readsDepth(); });
}

void DrawnGroups::drawShadows(const StateView& state, const ShadowMap& shadow, double time) {
    for (Drawn& group : groups_)
        if (group.blend == Blend::none)
            group.drawer->submit(group.drawer->useDepth(state, shadow, time), state,
                                 LevelDraws::levelInShadow(group.drawer->streams(),
                                                           double(group.scale * shadow.pixelsPerMeter())));
}

// Draws the farthest first; the order within a level is that of depth, too.
static void drawLevels(GroupDrawer& drawer, const LevelDraws& levels, const StateView& state,
                       const DrawInputs& inputs) {
    const gpu::Program& program = drawer.useLit(state, inputs);
    levels.order().bind(program);
    for (int slab = levels.draws().slabs() - 1; slab >= 0; --slab) {
        program.set("slab", slab);
        drawer.submitSlab(program, state, levels.draws(), slab);
    }
}

void DrawnGroups::draw(const StateView& state, const DrawInputs& inputs) {
    if (inputs.multisampled) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    for (Drawn& group : groups_)
        if (group.blend == Blend::none) drawWhole(group, state, inputs);
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

void DrawnGroups::drawWhole(Drawn& group, const StateView& state, const DrawInputs& inputs) {
    if (group.levels)
        drawLevels(*group.drawer, *group.levels, state, inputs);
    else
        group.drawer->submit(group.drawer->useLit(state, inputs), state);
}

bool DrawnGroups::changeParticle(size_t group, const ParticleType& type, const Lighting& lighting) {
    for (Drawn& drawn : groups_) {
        if (drawn.drawer->index() != group) continue;
        auto* particles = dynamic_cast<ParticleDrawer*>(drawn.drawer.get());
        return particles && particles->change(type, lighting);
    }
    return true;
}

bool DrawnGroups::changeLooks(size_t group, const Group& looks) {
    for (Drawn& drawn : groups_) {
        if (drawn.drawer->index() != group) continue;
        auto* molecules = dynamic_cast<MoleculeDrawer*>(drawn.drawer.get());
        return molecules && molecules->change(looks);
    }
    return true;
}

const DrawOrder* DrawnGroups::orderOf(size_t group) const {
    for (const Drawn& drawn : groups_)
        if (drawn.drawer->index() == group) return drawn.order.get();
    return nullptr;
}

// ---- Levels of detail

// Where compute shaders can cut the order.
void DrawnGroups::makeLevels(gpu::Context& context, const Plan& plan) {
    for (Drawn& group : groups_) {
        GroupDrawer& drawer = *group.drawer;
        const std::vector<DrawStream>& streams = drawer.streams();
        if (group.blend != Blend::none || streams.size() < 2 || !context.info().computeShaders) continue;
        group.levels = std::make_unique<LevelDraws>(context, plan.groups[drawer.index()], drawer.index(),
                                                    streams, double(group.scale));
        drawer.addOrderDefines({"SLAB_DRAWS"});
        drawer.addOrderDefines(group.levels->order().defines());
    }
}

// ---- What is blended

// The blends of groups that give the same picture in any order.
static bool commute(const std::vector<Blend>& blends) {
    return std::all_of(blends.begin(), blends.end(),
                       [&](Blend blend) { return blend == blends.front() && blend != Blend::alpha; });
}

void DrawnGroups::makeOrders(gpu::Context& context, const Plan& plan, int slabs) {
    std::vector<Blend> blends;
    bool unordered = true;  // all ask for no order: they are drawn one after another, whole
    for (const Drawn& group : groups_) {
        if (group.blend == Blend::none) continue;
        blends.push_back(group.blend);
        unordered = unordered && group.blend == Blend::alpha && group.sort == DrawSort::none;
    }
    blends_ = !blends.empty();
    const bool inSlabs = blends.size() > 1 && !commute(blends) && !unordered && slabs > 1;
    int most = -1;
    for (size_t i = 0; i < groups_.size(); ++i) {
        Drawn& group = groups_[i];
        if (group.blend == Blend::none) continue;
        if (group.sort == DrawSort::none && !inSlabs) continue;
        GroupDrawer& drawer = *group.drawer;
        group.order = std::make_unique<DrawOrder>(context, plan.groups[drawer.index()], drawer.index(),
                                                  group.sort, group.spreadFrames);
        const bool slabDraws = inSlabs && group.order->exact();
        if (slabDraws)
            drawer.addOrderDefines({"SLAB_DRAWS"});
        else
            drawer.addOrderDefines({"ORDERED", gpu::constant("SLABS", inSlabs)});
        drawer.addOrderDefines(group.order->defines());
        if (slabDraws)
            group.slabDraws =
                std::make_unique<SlabDraws>(context, slabs, *group.order, std::vector{drawer.streams()[0]});
        // The slabs are cut by the largest group that is sorted, else by the largest.
        const int weight = group.order->sorted() ? drawer.count() : 0;
        if (weight > most) {
            most = weight;
            slabsOf_ = i;
        }
    }
    if (inSlabs) slabs_ = std::make_unique<DepthSlabs>(context, slabs, *groups_[slabsOf_].order);
}

bool DrawnGroups::orders() const {
    return blends_ || std::any_of(groups_.begin(), groups_.end(),
                                  [](const Drawn& group) { return group.levels != nullptr; });
}

void DrawnGroups::order(const StateView& state, const Eye& eye) {
    for (Drawn& group : groups_) {
        if (!group.levels) continue;
        // A state in several storage blocks cannot be ordered.
        if (state.buffers && (*state.buffers)[group.drawer->index()].parts().size() > 1) {
            group.levels.reset();
            group.drawer->dropOrder();
        } else {
            group.levels->update(state, eye);
        }
    }
    for (const Drawn& group : groups_)
        if (group.order) group.order->update(state, eye);
    if (!slabs_) return;
    slabs_->update(*groups_[slabsOf_].order);
    for (const Drawn& group : groups_)
        if (group.slabDraws) group.slabDraws->update(*group.order, slabs_->bounds());
}

// Alpha adds up to what of a pixel is covered. What multiplies what lies behind covers nothing; what adds to
// it counts as if it covered that: nothing in a picture says otherwise.
static void setBlend(Blend blend) {
    switch (blend) {
    case Blend::none:
        glDisable(GL_BLEND);
        return;
    case Blend::alpha:
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case Blend::additive:
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        break;
    case Blend::multiplicative:
        glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
        break;
    }
    glEnable(GL_BLEND);
}

void DrawnGroups::drawBlended(const StateView& state, const DrawInputs& inputs) {
    const int slabs = slabs_ ? slabs_->count() : 1;
    for (int slab = 0; slab < slabs; ++slab) {
        for (size_t i = 0; i < groups_.size(); ++i) {
            // The slabs begin at molecules of one group, which are the farthest there: it goes first.
            Drawn& group = groups_[i == 0 ? slabsOf_ : i <= slabsOf_ ? i - 1 : i];
            if (group.blend == Blend::none) continue;
            setBlend(group.blend);
            drawSlab(group, slab, state, inputs);
        }
    }
    setBlend(Blend::none);
}

void DrawnGroups::drawSlab(Drawn& group, int slab, const StateView& state, const DrawInputs& inputs) {
    const gpu::Program& program = group.drawer->useLit(state, inputs);
    if (group.order) group.order->bind(program);
    if (slabs_) program.set("slab", slab);
    if (group.slabDraws) {
        group.drawer->submitSlab(program, state, *group.slabDraws, slab);
        return;
    }
    if (slabs_) slabs_->bind(program);
    group.drawer->submit(program, state);
}

void DrawnGroups::drawCover(size_t i, const StateView& state, const DrawInputs& inputs) {
    Drawn& group = groups_[i];
    if (group.blend == Blend::none) {
        if (inputs.multisampled) {
            glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
            glEnable(GL_SAMPLE_ALPHA_TO_ONE);
        }
        drawWhole(group, state, inputs);
        glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
        glDisable(GL_SAMPLE_ALPHA_TO_ONE);
        return;
    }
    setBlend(Blend::alpha);
    for (int slab = 0; slab < (slabs_ ? slabs_->count() : 1); ++slab)
        drawSlab(group, slab, state, inputs);
    setBlend(Blend::none);
}

}  // namespace shoal
