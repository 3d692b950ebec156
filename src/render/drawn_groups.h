// Draws every group of a scene. Those with a blend are drawn after everything else, from back to front;
// several of them take turns in slabs of depth (render/draw_order.h).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/draw_order.h"
#include "render/group_drawer.h"

namespace shoal {

class DrawnGroups {
  public:
    // `slabs` of depth at most; `pixelsPerMeter`: about where the camera looks.
    DrawnGroups(gpu::Context& context, const Scene& scene, const Plan& plan, const Lighting& lighting,
                int slabs, double pixelsPerMeter);

    static bool blends(const Scene& scene, const Plan& plan);  // whether a group of the plan does
    bool blends() const { return blends_; }
    bool readsDepth() const;  // whether a blended group asks for DrawInputs::sceneDepth

    void drawShadows(const StateView& state, const ShadowMap& shadow, double time);
    // Draws the groups that are not blended. With several samples a pixel, edges of cut-out shapes are spread
    // over them (alpha to coverage).
    void draw(const StateView& state, const DrawInputs& inputs);
    // Before the framebuffer of the picture is bound: the orders of what is blended or has levels of detail.
    bool orders() const;
    void order(const StateView& state, const Eye& eye);
    void drawBlended(const StateView& state, const DrawInputs& inputs);

    size_t count() const { return groups_.size(); }  // of those that are drawn
    const std::string& nameOf(size_t i) const { return groups_[i].drawer->groupName(); }
    // Adds up in alpha what the i-th covers, after the picture was drawn.
    void drawCover(size_t i, const StateView& state, const DrawInputs& inputs);

    // Calls ParticleDrawer::change for a group of the plan. True where the group is not drawn.
    bool changeParticle(size_t group, const ParticleType& type, const Lighting& lighting);

    // Calls MoleculeDrawer::change for a group of the plan.
    bool changeLooks(size_t group, const Group& looks);

    const DrawOrder* orderOf(size_t group) const;  // of the plan; null: it has none. For tests

  private:
    struct Drawn {
        std::unique_ptr<GroupDrawer> drawer;
        Blend blend = Blend::none;
        DrawSort sort = DrawSort::none;  // of the blend alpha
        int spreadFrames = 0;
        std::unique_ptr<DrawOrder> order;      // none: as they are numbered
        std::unique_ptr<SlabDraws> slabDraws;  // where there are slabs and the order is exact
        std::unique_ptr<LevelDraws> levels;    // of what is not blended; none: all of each is drawn
        float scale = 1;                       // of the largest molecule
    };

    void drawWhole(Drawn& group, const StateView& state, const DrawInputs& inputs);
    void drawSlab(Drawn& group, int slab, const StateView& state, const DrawInputs& inputs);
    void makeLevels(gpu::Context& context, const Plan& plan);
    void makeOrders(gpu::Context& context, const Plan& plan, int slabs);

    std::unique_ptr<gpu::Programs> programs_ = std::make_unique<gpu::Programs>();  // drawers point at it
    std::vector<Drawn> groups_;
    bool blends_ = false;
    std::unique_ptr<DepthSlabs> slabs_;  // where several groups are blended
    size_t slabsOf_ = 0;                 // whose order the slabs are cut by
};

}  // namespace shoal
