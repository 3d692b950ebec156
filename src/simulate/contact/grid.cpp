#include "simulate/contact/grid.h"

namespace shoal {

using gpu::Program;

ContactGrid::ContactGrid(ContactData& data) : data_(&data) {
    if (data.textures) {
        const size_t grids = data.staggers ? 2 : 1;
        for (size_t i = 0; i < grids; ++i)
            networks_.emplace_back(*data.context, NetworkSort::Kind::bitonic, size_t(data.contact->spheres),
                                   2 << rowBits(data.contact->cells()), NetworkSort::Ties::byIndex);
        keys_ = data.stage("contact/grid/keys");
        starts_ = data.stage("sort/starts");
        slots_ = data.stage("contact/grid/keys", {"SLOTS"}, "slots");
    } else if (data.counted) {
        starts_ = data.stage("contact/grid/starts", {"LANES 256"});
        members_ = data.stage("contact/grid/starts", {"MEMBERS"}, "members");
    } else {
        radix_.emplace(*data.context, data.padded);
    }
    order_ = data.stage("contact/grid/order");
    for (const ContactGroup& group : data.contact->groups) {
        Group& made = groups_.emplace_back();
        if (data.collides(group) && data.textures)
            made.colliders = data.groupStage(group, "contact/grid/spheres", {"COLLIDES"}, "colliders");
        made.spheres = data.groupStage(group, "contact/grid/spheres");
    }
}

void ContactGrid::setStep(const Program& program, const ContactGroup& group, const Frame& frame) const {
    program.set("cell", float(data_->contact->cell));
    program.set("givenRadius", float(group.radius));
    if (data_->fused) program.set("contactStep", float(frame.parameters.frameTime));
}

void ContactGrid::makeSpheres(const Frame& frame, bool wakes, bool isStaggered) {
    data_->forParts([&](size_t g, size_t p, const MoleculeRange& part) {
        const ContactGroup& group = data_->contact->groups[g];
        const Program& program = data_->withPart(groups_[g].spheres, group, p);
        program.set("label", int(uint32_t(g) << 26) + part.first);
        setStep(program, group, frame);
        if (!data_->textures) {
            program.set("keys", data_->keyMask() + 1);
            if (data_->collides(group)) data_->setColliders(program, group, frame);
            if (data_->rests) program.set("wakes", int(wakes));
            if (data_->staggers) {
                program.set("cellShift", glm::vec3(isStaggered ? float(data_->contact->cell / 2) : 0.0f));
                program.set("onlyKeys", int(isStaggered));
            }
        }
        const auto [first, count] = data_->spheresOf(group, part);
        data_->arrays.run(program, first, count);
    });
}

void ContactGrid::makeColliders(const Frame& frame) {
    data_->forParts([&](size_t g, size_t p, const MoleculeRange& part) {
        if (!groups_[g].colliders) return;
        const ContactGroup& group = data_->contact->groups[g];
        const Program& program = data_->withPart(groups_[g].colliders, group, p);
        data_->setColliders(program, group, frame);
        setStep(program, group, frame);
        const auto [first, count] = data_->spheresOf(group, part);
        data_->arrays.run(program, first, count);
    });
}

void ContactGrid::sortByRadix(bool isStaggered) {
    data_->arrays.settle();
    radix_->sort(data_->arrays.buffer("sorted"), size_t(data_->contact->spheres), data_->contact->tableBits);
    data_->arrays.settle();
    if (isStaggered) return;
    data_->use(order_).set("keys", data_->keyMask() + 1);
    data_->runAll(order_);
}

void ContactGrid::count(bool isStaggered) {
    const int keys = data_->keyMask() + 1;
    data_->use(starts_).set("keys", keys);
    data_->arrays.runGroups(starts_, int((size_t(keys) + ContactData::cellTile - 1) / ContactData::cellTile));
    data_->use(members_).set("keys", keys);
    data_->runAll(members_);
    data_->use(order_);
    if (data_->staggers) order_.set("onlyKeys", int(isStaggered));
    data_->runAll(order_);
}

void ContactGrid::sortByNetwork(bool isStaggered) {
    NetworkSort& sort = networks_[isStaggered ? 1 : 0];
    data_->use(keys_).set("numbers", data_->contact->spheres);
    keys_.set("keyMask", data_->keyMask());
    keys_.set("cell", float(data_->contact->cell));
    keys_.set("isStaggered", int(isStaggered));
    sort.drawInto(sort.target());
    gpu::drawVertices(3);
    sort.flip();
    sort.sort();
    data_->arrays.lend(isStaggered ? "staggered" : "sorted", sort.pairs());
}

void ContactGrid::build(const Frame& frame, bool wakes) {
    if (data_->textures) {
        makeSpheres(frame, wakes, false);
        makeColliders(frame);
        for (size_t i = 0; i < networks_.size(); ++i)
            sortByNetwork(i == 1);
        data_->use(starts_).set("count", data_->contact->spheres);
        data_->arrays.run(starts_, 0, data_->keyMask() + 1);
        data_->runAll(data_->use(order_));
        data_->use(slots_).set("keyMask", data_->keyMask());
        return data_->runAll(slots_);
    }
    for (const bool isStaggered : {true, false}) {
        if (isStaggered && !data_->staggers) continue;
        makeSpheres(frame, wakes, isStaggered);
        if (data_->counted)
            count(isStaggered);
        else
            sortByRadix(isStaggered);
        if (isStaggered) data_->arrays.swap("sorted", "staggered");  // which the grid itself sorts anew
    }
}

int ContactGrid::sortDispatches() const {
    const int grids = data_->staggers ? 2 : 1;
    return radix_ ? grids * 3 * radix_->passes(size_t(data_->contact->spheres), data_->contact->tableBits)
                  : 0;
}

size_t ContactGrid::bytes() const {
    size_t out = radix_ ? radix_->bytes() : 0;
    for (const NetworkSort& sort : networks_)
        out += 2 * sort.pairs().bytes();
    return out;
}

}  // namespace shoal
