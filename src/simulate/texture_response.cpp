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

// Uses a program of the response, with what all of its stages are given.
const Program& TextureContact::withResponse(const Program& program, const Times& times) const {
    setResponse(with(program), times);
    return program;
}

void TextureContact::runNearest(ContactState&, const Times& times) {
    withResponse(nearest_, times);
    drawAll({&totals_[0]});
}

void TextureContact::prepare(ContactState&, const Times& times) {
    withResponse(prepare_, times);
    constexpr int together = entriesADraw / 2;
    for (int first = 0; first < longestList; first += together) {
        prepare_.set("firstEntry", first);
        Into into;
        addLayers(into, pushes_[2], first, together);
        addLayers(into, anchors_[0], first, together);
        drawAll(into);
    }
    turn(pushes_);
    withResponse(prepareSums_, times);
    Into into = {&totals_[0], &known_[0], spreads_ ? &contactSums_ : &effectiveCounts_};
    if (walls_) into.emplace_back(&wallPushes_[2]);
    drawAll(into);
    if (walls_) turn(wallPushes_);
    if (spreads_) countEffective();
    constrain(times);
}

// Where contacts of several spheres act together.
void TextureContact::countEffective() {
    for (size_t g = 0; g < groups_.size(); ++g) {
        withGroup(groups_[g].effectiveSum, g).set("count", contact_->spheres);
        drawAll({&effectiveCounts_});
    }
}

// Makes what the iterations look for, of each contact.
void TextureContact::constrain(const Times& times) {
    withResponse(constrain_, times);
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
        withResponse(program, times).set("momentum", now);
        if (!spreads_) program.texture("earlier", totals_[earlier]);
    };
    bind(relax_);
    relax_.texture("earlierPushes", pushes_[earlier]);
    for (int first = 0; first < longestList; first += entriesADraw) {
        relax_.set("firstEntry", first);
        Into into;
        addLayers(into, pushes_[2], first, entriesADraw);
        drawAll(into);
    }
    turn(pushes_);
    bind(relaxSums_);
    Into into = {&totals_[2]};
    if (walls_) {
        relaxSums_.texture("earlierWallPushes", wallPushes_[earlier]);
        into.emplace_back(&wallPushes_[2]);
    }
    drawAll(into);
    if (walls_) turn(wallPushes_);
    turn(totals_);
}

void TextureContact::spread(ContactState& state, const Texture& earlier, float momentum) {
    for (size_t g = 0; g < groups_.size(); ++g) {
        const Program& program = withGroup(groups_[g].spread, g);
        state.bind(program, contact_->groups[g].group);
        program.texture("earlier", earlier);
        program.set("momentum", momentum);
        program.set("count", contact_->spheres);
        drawAll({&motionsNow_});
    }
}

void TextureContact::settle(ContactState&, const Times& times) {
    withResponse(settle_, times);
    drawAll({&totals_[2], &known_[0]});
    turn(totals_);
}

void TextureContact::apply(ContactState& state, const Times& times) {
    for (size_t g = 0; g < groups_.size(); ++g) {
        const ContactGroup& group = contact_->groups[g];
        const Program& program = withGroup(groups_[g].gains, g);
        if (spreads_) state.bind(program, group.group);
        program.set("stepTime", float(times.step));
        drawGroup({&gains_, &loads_}, g);
        state.apply(group.group, [&](const Program& applies) {
            applies.set("firstSphere", group.firstSphere);
            applies.texture("gains", gains_);
            if (!applies.uses("restSpeed")) return;  // it has no history
            applies.set("restSpeed", float(times.restSpeed));
            applies.set("substepTime", float(times.substep));
        });
    }
}

void TextureContact::bindLoads(const Program& program, size_t group) const {
    const ContactGroup* contact = contact_->of(group);
    if (!contact || !contact_->remembers()) return;
    program.set("firstSphere", contact->firstSphere);
    program.texture("contactLoads", loads_);
}

}  // namespace shoal
