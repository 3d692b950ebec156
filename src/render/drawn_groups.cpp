#include "render/drawn_groups.h"

#include <algorithm>

#include "gpu/gl.h"
#include "render/molecule_drawer.h"
#include "render/particle_drawer.h"

namespace shoal {

DrawnGroups::DrawnGroups(gpu::Context& context, const std::string& shaderRoot, const Scene& scene,
                         const Plan& plan, const Lighting& lighting, int slabs, double pixelsPerMeter) {
    for (size_t g = 0; g < plan.groups.size(); ++g) {
        const GroupPlan& groupPlan = plan.groups[g];
        if (groupPlan.count == 0) continue;
        const Group& group = scene.groups[groupPlan.index];
        const Material& material = group.molecule.material;
        Drawn drawn;
        if (group.particle)
            drawn.drawer = std::make_unique<ParticleDrawer>(context, shaderRoot, *programs_, *group.particle,
                                                            groupPlan, g, lighting, pixelsPerMeter);
        else
            drawn.drawer = std::make_unique<MoleculeDrawer>(context, shaderRoot, *programs_, group, groupPlan,
                                                            g, lighting);
        if (group.colorBy) drawn.drawer->colorBy(*group.colorBy, groupPlan.vertexCount);
        drawn.blend = material.blend;
        if (drawn.blend == Blend::alpha) drawn.sort = material.sort;
        drawn.spreadFrames = material.spreadFrames;
        groups_.push_back(std::move(drawn));
    }
    makeOrders(context, shaderRoot, plan, slabs);
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
            group.drawer->submit(group.drawer->useDepth(state, shadow, time), state);
}

void DrawnGroups::draw(const StateView& state, const DrawInputs& inputs) {
    if (inputs.multisampled) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
    for (Drawn& group : groups_)
        if (group.blend == Blend::none) group.drawer->submit(group.drawer->useLit(state, inputs), state);
    glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

bool DrawnGroups::changeParticle(size_t group, const ParticleType& type, const Lighting& lighting) {
    for (Drawn& drawn : groups_) {
        if (drawn.drawer->index() != group) continue;
        auto* particles = dynamic_cast<ParticleDrawer*>(drawn.drawer.get());
        return particles && particles->change(type, lighting);
    }
    return true;
}

void DrawnGroups::changeLooks(size_t group, const Group& looks) {
    for (Drawn& drawn : groups_) {
        if (drawn.drawer->index() != group) continue;
        if (auto* molecules = dynamic_cast<MoleculeDrawer*>(drawn.drawer.get())) molecules->change(looks);
    }
}

const DrawOrder* DrawnGroups::orderOf(size_t group) const {
    for (const Drawn& drawn : groups_)
        if (drawn.drawer->index() == group) return drawn.order.get();
    return nullptr;
}

}  // namespace shoal
