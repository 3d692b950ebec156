// The passes of the response of contact in fragments.
#include <algorithm>

#include "gpu/gl.h"
#include "simulate/texture_contact.h"

namespace shoal {

using gpu::Program;
using gpu::Texture;

namespace {

// Appends layers of a texture.
void addLayers(std::vector<gpu::ColorTarget>& into, const Texture& texture, int first, int count) {
    for (int i = 0; i < count; ++i)
        into.emplace_back(&texture, first + i);
}

// Sides in turn: what has been written becomes what is read.
template <typename Sides>
void turn(Sides& sides) {
    std::rotate(sides.begin(), sides.begin() + 2, sides.end());
}

}  // namespace

// Binds what all stages of the response read; returns the next free texture unit.
int TextureContact::bindResponse(const Program& program, const Times& times) const {
    program.use();
    program.texture("places", 0, places_);
    program.texture("motions", 1, motions_);
    program.texture("cells", 2, cells_);
    program.texture("counts", 3, counts_[now_]);
    program.texture("lists", 4, lists_[now_]);
    setResponse(program, times);
    int unit = 5;
    if (program.uses("materials")) program.texture("materials", unit++, materials_);
    if (program.uses("sorted")) program.texture("sorted", unit++, sort_.pairs());
    if (walls_ && program.uses("walls")) program.texture("walls", unit++, nearWalls_[now_]);
    if (rigid_ && program.uses("bodies")) program.texture("bodies", unit++, bodies_);
    return unit;
}

void TextureContact::runNearest(ContactState&, const Times& times) {
    bindResponse(nearest_, times);
    drawAll({&totals_[0]});
}

void TextureContact::prepare(ContactState&, const Times& times) {
    const size_t before = 1 - now_;
    const auto bindOld = [&](const Program& program) {
        int unit = bindResponse(program, times);
        program.texture("oldSlots", unit++, slots_[before]);
        program.texture("oldCounts", unit++, counts_[before]);
        return unit;
    };
    int unit = bindOld(prepare_);
    prepare_.texture("oldLists", unit++, lists_[before]);
    prepare_.texture("oldPushes", unit++, pushes_[0]);
    prepare_.texture("oldAnchors", unit++, anchors_[before]);
    constexpr int together = entriesADraw / 2;
    for (int first = 0; first < longestList; first += together) {
        prepare_.set("firstEntry", first);
        Into into;
        addLayers(into, pushes_[2], first, together);
        addLayers(into, anchors_[now_], first, together);
        drawAll(into);
    }
    turn(pushes_);
    unit = bindOld(prepareSums_);
    prepareSums_.texture("oldKnown", unit++, known_[before]);
    prepareSums_.texture("pushes", unit++, pushes_[0]);
    prepareSums_.texture("anchors", unit++, anchors_[now_]);
    Into into = {&totals_[0], &known_[now_], spreads_ ? &contactSums_ : &effectiveCounts_};
    if (walls_) {
        prepareSums_.texture("oldWalls", unit++, nearWalls_[before]);
        prepareSums_.texture("oldWallPushes", unit++, wallPushes_[0]);
        into.emplace_back(&wallPushes_[2]);
    }
    drawAll(into);
    if (walls_) turn(wallPushes_);
    if (spreads_) countEffective();
    constrain(times);
}

// Where contacts of several spheres act together.
void TextureContact::countEffective() {
    for (size_t g = 0; g < groups_.size(); ++g) {
        const Program& program = useGroup(groups_[g].effectiveSum, g);
        program.texture("sorted", 0, sort_.pairs());
        program.texture("shapes", 1, groups_[g].shapes);
        program.texture("slots", 2, slots_[now_]);
        program.texture("counts", 3, counts_[now_]);
        program.texture("contactSums", 4, contactSums_);
        if (program.uses("bodies")) program.texture("bodies", 5, bodies_);
        program.set("count", contact_->spheres);
        drawAll({&effectiveCounts_});
    }
}

// What contacts ask of their impulses.
void TextureContact::constrain(const Times& times) {
    int unit = bindResponse(constrain_, times);
    constrain_.texture("effectiveCounts", unit++, effectiveCounts_);
    constrain_.texture("anchors", unit++, anchors_[now_]);
    constexpr int together = entriesADraw / 2;
    for (int first = 0; first < longestList; first += together) {
        constrain_.set("firstEntry", first);
        Into into;
        addLayers(into, normals_, first, together);
        addLayers(into, amounts_, first, together);
        drawAll(into);
    }
}

void TextureContact::relax(ContactState& state, const Times& times, int iteration) {
    const float now = momentum(iteration);
    // without momentum the earlier ones do not count, and nobody may have written them yet
    const size_t earlier = now == 0 ? 0 : 1;
    if (spreads_) spread(state, totals_[earlier], now);
    const auto bind = [&](const Program& program) {
        int unit = bindResponse(program, times);
        program.texture("effectiveCounts", unit++, effectiveCounts_);
        program.texture("normals", unit++, normals_);
        program.texture("pushes", unit++, pushes_[0]);
        if (spreads_) {
            program.texture("motionsNow", unit++, motionsNow_);
        } else {
            program.texture("totals", unit++, totals_[0]);
            program.texture("earlier", unit++, totals_[earlier]);
        }
        program.set("momentum", now);
        return unit;
    };
    int unit = bind(relax_);
    relax_.texture("amounts", unit++, amounts_);
    relax_.texture("earlierPushes", unit, pushes_[earlier]);
    for (int first = 0; first < longestList; first += entriesADraw) {
        relax_.set("firstEntry", first);
        Into into;
        addLayers(into, pushes_[2], first, entriesADraw);
        drawAll(into);
    }
    turn(pushes_);
    unit = bind(relaxSums_);
    relaxSums_.texture("known", unit++, known_[now_]);
    Into into = {&totals_[2]};
    if (walls_) {
        relaxSums_.texture("wallPushes", unit++, wallPushes_[0]);
        relaxSums_.texture("earlierWallPushes", unit++, wallPushes_[earlier]);
        into.emplace_back(&wallPushes_[2]);
    }
    drawAll(into);
    if (walls_) turn(wallPushes_);
    turn(totals_);
}

void TextureContact::spread(ContactState& state, const Texture& earlier, float momentum) {
    for (size_t g = 0; g < groups_.size(); ++g) {
        const Program& program = useGroup(groups_[g].spread, g);
        bindGroup(program, state, g);
        program.texture("sorted", 8, sort_.pairs());
        program.texture("motions", 9, motions_);
        program.texture("earlier", 10, earlier);
        program.set("momentum", momentum);
        program.set("count", contact_->spheres);
        drawAll({&motionsNow_});
    }
}

// Binds what tells of the totals of the spheres of a group, up to unit 7.
void TextureContact::bindGroup(const Program& program, ContactState& state, size_t group) const {
    if (spreads_) state.bind(program, contact_->groups[group].group);
    program.texture("slots", 3, slots_[now_]);
    program.texture("counts", 4, counts_[now_]);
    program.texture("totals", 5, totals_[0]);
    if (program.uses("shapes")) program.texture("shapes", 6, groups_[group].shapes);
    if (program.uses("bodies")) program.texture("bodies", 7, bodies_);
}

void TextureContact::settle(ContactState&, const Times& times) {
    int unit = bindResponse(settle_, times);
    settle_.texture("effectiveCounts", unit++, effectiveCounts_);
    settle_.texture("pushes", unit++, pushes_[0]);
    settle_.texture("anchors", unit++, anchors_[now_]);
    settle_.texture("totals", unit++, totals_[0]);
    if (walls_) settle_.texture("wallPushes", unit++, wallPushes_[0]);
    drawAll({&totals_[2], &known_[now_]});
    turn(totals_);
}

void TextureContact::apply(ContactState& state, const Times& times) {
    for (size_t g = 0; g < groups_.size(); ++g) {
        const ContactGroup& group = contact_->groups[g];
        const Program& program = useGroup(groups_[g].gains, g);
        bindGroup(program, state, g);
        if (program.uses("motions")) program.texture("motions", 9, motions_);
        if (program.uses("effectiveCounts")) program.texture("effectiveCounts", 11, effectiveCounts_);
        if (program.uses("cells")) program.texture("cells", 12, cells_);
        program.texture("known", 10, known_[now_]);
        program.set("stepTime", float(times.step));
        drawGroup({&gains_, &loads_}, g);
        state.apply(group.group, [&](const Program& applies, int firstUnit) {
            applies.set("firstSphere", group.firstSphere);
            applies.texture("gains", firstUnit, gains_);
            if (!applies.uses("restSpeed")) return;  // it has no history
            applies.set("restSpeed", float(times.restSpeed));
            applies.set("substepTime", float(times.substep));
        });
    }
}

void TextureContact::bindLoads(const Program& program, int unit, size_t group) const {
    const ContactGroup* contact = contact_->of(group);
    if (!contact || !contact_->remembers()) return;
    program.set("firstSphere", contact->firstSphere);
    program.texture("contactLoads", unit, loads_);
}

}  // namespace shoal
