#include "simulate/molecule_contact.h"

#include <algorithm>
#include <numeric>

#include "gpu/barrier.h"

namespace shoal {

using gpu::Barrier;
using gpu::BufferTexture;
using gpu::Program;
using gpu::Texel;

namespace {

constexpr size_t lanes = 64;  // of a workgroup, as the shaders say
constexpr size_t activeHead = 5, droppedWord = 4;

size_t wordsOf(Texel texel) {
    static constexpr size_t words[] = {4, 4, 2, 1};
    return words[size_t(texel)];
}

void store(const Program& program, const char* block, int at, const gpu::Buffer& buffer) {
    program.storage(block, at, buffer, 0, buffer.bytes());
}

void settled() {
    gpu::barrier({Barrier::textureFetch, Barrier::storage, Barrier::command});
}

void checkLimits(const gpu::ContextInfo& info, const ContactPlan& contact, const Location& location) {
    const size_t block = size_t(info.maxStorageBlockBytes);
    const size_t most = std::min({block / (sizeof(float) * size_t(contact.listLength)), block / 16,
                                  size_t(info.maxBufferTexels) / size_t(contact.listLength),
                                  size_t(info.maxWorkGroupsX) * lanes, RadixSort::most(info)});
    if (size_t(contact.spheres) <= most) return;
    throw Error(location, concat("contact between ", contact.spheres,
                                 " spheres is more than this context holds: at most ", most));
}

}  // namespace

MoleculeContact::Array::Array(gpu::Context& context, size_t texels, Texel texel, const char* label,
                              const void* data)
    : buffer(context, gpu::Buffer::Use::storage, data, texels * wordsOf(texel) * sizeof(uint32_t), label),
      texture(context, buffer, texel, label) {}

MoleculeContact::MoleculeContact(gpu::Context& context, const std::string& shaderRoot, const Plan& plan,
                                 const Tables& tables, gpu::ProgramCache* cache)
    : context_(&context),
      plan_(&plan),
      contact_(&plan.contact),
      tables_(&tables),
      padded_((size_t(plan.contact.spheres) + lanes - 1) / lanes * lanes),
      sort_((checkLimits(context.info(), plan.contact, plan.contact.settings.location), context), shaderRoot,
            padded_, cache) {
    for (const ContactGroup& group : contact_->groups) {
        triangles_ |= group.triangles;
        self_ |= group.self;
        walls_ |= plan.groups[group.group].needs.collide;
    }
    const auto array = [&](size_t texels, Texel texel, const char* label) {
        return Array(context, texels, texel, label);
    };
    spherePlaces_ = array(padded_, Texel::uint4, "contact places");
    places_ = array(padded_, Texel::uint4, "contact places in order");
    motions_ = array(padded_, Texel::uint4, "contact motions");
    sphereCells_ = array(padded_, Texel::uint4, "contact cells");
    cells_ = array(padded_, Texel::uint4, "contact cells in order");
    pairs_ = array(padded_, Texel::uint2, "contact keys");
    if (contact_->settings.search == ContactSearch::staggered)
        staggered_ = array(padded_, Texel::uint2, "staggered keys");
    starts_ = array((size_t(1) << contact_->tableBits) + 1, Texel::uint1, "cells");
    slots_ = array(padded_, Texel::uint1, "slots");
    counts_ = array(padded_, Texel::uint1, "contacts");
    lists_ = array(padded_ * size_t(contact_->listLength), Texel::uint1, "contact lists");
    shifts_ = array(padded_, Texel::float4, "contact shifts");
    for (Array& impulses : impulses_)
        impulses = array(padded_, Texel::float4, "contact impulses");
    if (contact_->settings.response == ContactResponse::simultaneous)
        pushed_ = array(padded_ * size_t(contact_->listLength), Texel::uint2, "contact pushes");
    if (contact_->settings.response == ContactResponse::simultaneous)
        crowds_ = array(padded_, Texel::uint1, "contact crowds");
    if (walls_) {
        // groups that do not collide leave theirs as they are now
        const std::vector<glm::vec4> none(padded_, glm::vec4(0, 1, 0, 1e30f));
        nearWalls_ = Array(context, padded_, Texel::float4, "walls", none.data());
        wallPushed_ = array(padded_, Texel::uint2, "wall pushes");
    }
    if (triangles_) {
        normals_ = array(2 * padded_, Texel::float4, "contact normals");
        velocities_ = array(padded_, Texel::float4, "contact velocities");
    }
    const std::vector<uint32_t> none(activeHead + padded_);
    active_ = gpu::Buffer(context, gpu::Buffer::Use::storage, std::span<const uint32_t>(none), "in contact");
    makeExclusions();
    makeMaterials();
    makePrograms(shaderRoot, cache);
    for (const ContactGroup& group : contact_->groups)
        makeGroup(group, shaderRoot, cache);
}

void MoleculeContact::makePrograms(const std::string& shaderRoot, gpu::ProgramCache* cache) {
    std::vector<std::string> common = {concat("LIST ", contact_->listLength),
                                       concat("NEIGHBORS ", contact_->settings.neighbors)};
    if (self_) common.push_back("SELF");
    if (triangles_) common.push_back("TRIANGLES");
    if (walls_) common.push_back("WALLS");
    const auto make = [&](const char* file, std::vector<std::string> defines) {
        defines.insert(defines.end(), common.begin(), common.end());
        gpu::ProgramOptions options;
        options.compute = concat("contact/", file, ".comp");
        options.label = concat("contact ", file);
        options.defines = std::move(defines);
        options.cache = cache;
        return Program(*context_, shaderRoot, options);
    };
    order_ = make("order", {});
    if (contact_->settings.search == ContactSearch::exact) {
        find_ = make("find", {"LAST"});
    } else if (staggered_.buffer) {
        find_ = make("neighbors", {});
        findStaggered_ = make("neighbors", {"STAGGERED", "LAST"});
    } else {
        find_ = make("neighbors", {"LAST"});
    }
    if (contact_->settings.response == ContactResponse::nearest) {
        nearest_ = make("nearest", {});
        return;
    }
    crowd_ = make("respond", {"CROWD"});
    begin_ = make("respond", {"BEGIN"});
    relax_ = make("respond", {"RELAX"});
    settle_ = make("respond", {"SETTLE"});
    keep_ = make("respond", {"KEEP"});
}

void MoleculeContact::makeGroup(const ContactGroup& group, const std::string& shaderRoot,
                                gpu::ProgramCache* cache) {
    const GroupPlan& plan = plan_->groups[group.group];
    const BufferLayout layout = plan.layout();
    std::vector<std::string> common = {
        concat("VERTICES ", plan.vertexCount), concat("SPHERES ", group.spheresOf),
        concat("BLOCK ", BufferLayout::block), concat("POSITION_ELEMENTS ", layout.positionElements()),
        concat("STATE_ELEMENTS ", layout.stateElements())};
    if (group.triangles) common.push_back("TRIANGLES");
    if (plan.needs.scale || plan.needs.phase) common.push_back("CONSTANTS");
    if (layout.life) common.push_back("LIFE");
    if (layout.lifeApart()) common.push_back("LIFE_APART");
    if (layout.history) {
        common.push_back("HISTORY");
        common.push_back("NO_HISTORY 1e30");
    }
    const auto make = [&](const char* file, std::vector<std::string> defines = {}) {
        defines.insert(defines.end(), common.begin(), common.end());
        gpu::ProgramOptions options;
        options.compute = concat("contact/", file, ".comp");
        options.label = concat("contact ", file, " of ", plan.name);
        options.defines = std::move(defines);
        options.cache = cache;
        options.generated = {{"generated/colliders.glsl", plan_->collideSource}};
        return Program(*context_, shaderRoot, options);
    };
    GroupPrograms& out = groups_.emplace_back();
    out.spheres = plan.needs.collide ? make("spheres", {"WALLS", samplesInBuffer}) : make("spheres");
    if (staggered_.buffer) out.staggeredKeys = make("spheres", {"ONLY_KEYS"});
    out.apply = make("apply");
    if (triangles_) {
        out.crowd = make("crowd");
        out.spread = make("spread");
    }
    const std::vector<glm::vec4>& shapes = group.shapes;
    out.shapes = Array(*context_, shapes.size(), Texel::float4, "contact shapes", shapes.data());
}

void MoleculeContact::makeExclusions() {
    if (!self_) return;
    std::vector<uint32_t> words;
    std::vector<glm::uvec4> groups;
    for (const ContactGroup& group : contact_->groups) {
        groups.emplace_back(group.firstSphere, group.spheresOf, words.size(), group.wordsOf);
        words.insert(words.end(), group.apart.begin(), group.apart.end());
    }
    apart_ = Array(*context_, words.size(), Texel::uint1, "contact within", words.data());
    groupsOf_ = Array(*context_, groups.size(), Texel::uint4, "contact groups", groups.data());
}

void MoleculeContact::makeMaterials() {
    std::vector<glm::vec4> pairs;
    for (const glm::vec2& pair : contact_->pairs)
        pairs.emplace_back(pair, 0, 0);
    materials_ = Array(*context_, pairs.size(), Texel::float4, "contact materials", pairs.data());
    if (!walls_) return;
    std::vector<glm::vec4> friction;
    for (const double mu : contact_->wallFriction)
        friction.emplace_back(float(mu), 0, 0, 0);
    wallFriction_ = Array(*context_, friction.size(), Texel::float4, "wall friction", friction.data());
}

void MoleculeContact::dispatch(const Program& program, size_t count) const {
    program.dispatch(int((count + lanes - 1) / lanes));
}

void MoleculeContact::dispatchActive(const Program& program) const {
    store(program, "Active", 3, active_);
    program.dispatchIndirect(active_, 0);
}

// run(group's contact, its programs, its buffers, part, the part's first sphere)
template <typename Run>
void MoleculeContact::forParts(const std::vector<GroupBuffers>& state, const Run& run) {
    for (size_t g = 0; g < groups_.size(); ++g) {
        const ContactGroup& group = contact_->groups[g];
        for (const GroupBuffers::Part& part : state[group.group].parts())
            run(g, state[group.group], part, group.firstSphere + part.first * group.spheresOf);
    }
}

void MoleculeContact::setWalls(const Program& program, const ContactGroup& group, const Frame& frame) const {
    const std::vector<glm::vec4> parameters = colliderParameters(*plan_, plan_->groups[group.group], frame);
    program.set("colliderParameters", std::span<const glm::vec4>(parameters));
    program.set("wallTime", float(frame.parameters.frameTime));
    program.set("wallStep", float(frame.parameters.frameTime));
    program.set("wallNudge", float(0.05 * group.radius));
    store(program, "Walls", 4, nearWalls_.buffer);
}

void MoleculeContact::makeKeys(bool staggered, const Frame& frame, const std::vector<GroupBuffers>& state) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part, int first) {
        const ContactGroup& group = contact_->groups[g];
        const Program& program = staggered ? groups_[g].staggeredKeys : groups_[g].spheres;
        Textures textures(program);
        textures.add("oldState", buffers.oldState(part)).add("oldRecords", part.record);
        textures.add("shapes", groups_[g].shapes.texture);
        if (buffers.hasConstants()) textures.add("constants", part.constant);
        if (!staggered && plan_->groups[group.group].needs.collide) {
            if (tables_->sampleTexels) textures.add("samples", tables_->sampleTexels);
            setWalls(program, group, frame);
        }
        const int spheres = part.count * group.spheresOf;
        program.set("firstSphere", first);
        program.set("partSpheres", spheres);
        program.set("label", int(uint32_t(g) << 26) + part.first);
        program.set("keyMask", (1 << contact_->tableBits) - 1);
        program.set("cell", float(contact_->cell));
        program.set("givenRadius", float(group.radius));
        program.set("cellShift", glm::vec3(staggered ? float(contact_->cell / 2) : 0.0f));
        store(program, "Pairs", 0, staggered ? staggered_.buffer : pairs_.buffer);
        if (!staggered) {
            store(program, "Places", 1, spherePlaces_.buffer);
            store(program, "Motions", 2, motions_.buffer);
            store(program, "Cells", 3, sphereCells_.buffer);
        }
        dispatch(program, size_t(spheres));
    });
    settled();
}

void MoleculeContact::order() {
    Textures textures(order_);
    textures.add("sorted", pairs_.texture)
        .add("spherePlaces", spherePlaces_.texture)
        .add("sphereCells", sphereCells_.texture);
    order_.set("count", contact_->spheres);
    order_.set("keyMask", (1 << contact_->tableBits) - 1);
    store(order_, "Starts", 0, starts_.buffer);
    store(order_, "Places", 1, places_.buffer);
    store(order_, "Slots", 2, slots_.buffer);
    store(order_, "Active", 3, active_);
    store(order_, "Cells", 4, cells_.buffer);
    dispatch(order_, size_t(contact_->spheres));
    settled();
}

void MoleculeContact::buildGrid(const Frame& frame, const std::vector<GroupBuffers>& state) {
    const size_t count = size_t(contact_->spheres);
    makeKeys(false, frame, state);
    sort_.sort(pairs_.buffer, count, contact_->tableBits);
    if (staggered_.buffer) {
        makeKeys(true, frame, state);
        sort_.sort(staggered_.buffer, count, contact_->tableBits);
    }
    settled();
    order();
}

void MoleculeContact::find(const Program& program) {
    Textures textures(program);
    textures.add("places", places_.texture).add("cells", cells_.texture).add("sorted", pairs_.texture);
    if (&program == &findStaggered_)
        textures.add("staggered", staggered_.texture).add("slots", slots_.texture);
    if (contact_->settings.search == ContactSearch::exact) {
        textures.add("starts", starts_.texture);
        program.set("reach", float(2 * contact_->largestRadius * (1 + 1e-6)));
        program.set("keyMask", (1 << contact_->tableBits) - 1);
    }
    if (self_) textures.add("apart", apart_.texture).add("groupsOf", groupsOf_.texture);
    program.set("count", contact_->spheres);
    program.set("cell", float(contact_->cell));
    program.set("listStride", int(padded_));
    store(program, "Lists", 0, lists_.buffer);
    store(program, "Counts", 1, counts_.buffer);
    store(program, "Active", 2, active_);
    dispatch(program, size_t(contact_->spheres));
    settled();
}

void MoleculeContact::search() {
    find(find_);
    if (findStaggered_) find(findStaggered_);
}

// Binds what all stages of the response read.
MoleculeContact::Textures MoleculeContact::bindResponse(const Program& program, double stepTime,
                                                        double restSpeed) const {
    Textures textures(program);
    textures.add("places", places_.texture)
        .add("sorted", pairs_.texture)
        .add("motions", motions_.texture)
        .add("cells", cells_.texture)
        .add("lists", lists_.texture)
        .add("counts", counts_.texture)
        .add("materials", materials_.texture);
    program.set("count", contact_->spheres);
    program.set("cell", float(contact_->cell));
    program.set("groupCount", int(contact_->groups.size()));
    program.set("listStride", int(padded_));
    program.set("stepTime", float(stepTime));
    program.set("restSpeed", float(restSpeed));
    return textures;
}

void MoleculeContact::runNearest(double stepTime, double restSpeed, const Totals& totals) {
    bindResponse(nearest_, stepTime, restSpeed);
    store(nearest_, "NewImpulses", 0, impulses_[totals.next].buffer);
    store(nearest_, "Shifts", 2, shifts_.buffer);
    dispatchActive(nearest_);
    settled();
}

// How much the contacts add up that act on the same vertices.
void MoleculeContact::runCrowd(double stepTime, double restSpeed, const std::vector<GroupBuffers>& state) {
    Textures textures = bindResponse(crowd_, stepTime, restSpeed);
    if (walls_) textures.add("walls", nearWalls_.texture);
    store(crowd_, triangles_ ? "Normals" : "NewCrowds", 0, triangles_ ? normals_.buffer : crowds_.buffer);
    dispatchActive(crowd_);
    settled();
    if (!triangles_) return;
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].crowd;
        Textures(program)
            .add("slots", slots_.texture)
            .add("counts", counts_.texture)
            .add("normals", normals_.texture)
            .add("shapes", groups_[g].shapes.texture);
        program.set("firstSphere", first);
        program.set("partSpheres", part.count * contact_->groups[g].spheresOf);
        store(program, "Crowds", 0, crowds_.buffer);
        dispatch(program, size_t(part.count) * size_t(contact_->groups[g].spheresOf));
    });
    settled();
}

void MoleculeContact::runStage(const Program& program, double stepTime, double restSpeed,
                               const Totals& totals) {
    Textures textures = bindResponse(program, stepTime, restSpeed);
    textures.add("crowds", crowds_.texture)
        .add("impulses", impulses_[totals.last].texture)
        // without momentum the earlier ones do not count, and nobody may have written them yet
        .add("earlier", impulses_[totals.momentum == 0 ? totals.last : totals.earlier].texture);
    program.set("momentum", totals.momentum);
    program.set("rubShare", 1.0f / ContactPlan::frictionRounds);
    if (triangles_) textures.add("velocities", velocities_.texture);
    if (walls_) {
        textures.add("walls", nearWalls_.texture).add("wallFriction", wallFriction_.texture);
        store(program, "WallPushed", 4, wallPushed_.buffer);
    }
    store(program, "NewImpulses", 0, impulses_[totals.next].buffer);
    store(program, "Pushed", 1, pushed_.buffer);
    if (&program == &keep_) textures.add("kept", shifts_.texture);
    if (&program == &settle_) store(program, "Shifts", 2, shifts_.buffer);
    dispatchActive(program);
    settled();
}

void MoleculeContact::spread(const std::vector<GroupBuffers>& state, const Totals& totals) {
    if (!triangles_) return;
    forParts(state, [&](size_t g, const GroupBuffers&, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].spread;
        Textures(program)
            .add("slots", slots_.texture)
            .add("counts", counts_.texture)
            .add("motions", motions_.texture)
            .add("impulses", impulses_[totals.last].texture)
            .add("earlier", impulses_[totals.earlier].texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        program.set("momentum", totals.momentum);
        program.set("firstSphere", first);
        program.set("partSpheres", part.count * contact_->groups[g].spheresOf);
        store(program, "Velocities", 0, velocities_.buffer);
        dispatch(program, size_t(part.count) * size_t(contact_->groups[g].spheresOf));
    });
    settled();
}

void MoleculeContact::apply(const std::vector<GroupBuffers>& state, const Array& impulses) {
    forParts(state, [&](size_t g, const GroupBuffers& buffers, const GroupBuffers::Part& part, int first) {
        const Program& program = groups_[g].apply;
        const bool ofVertices = contact_->groups[g].triangles;
        Textures(program)
            .add(ofVertices ? "slots" : "sorted", ofVertices ? slots_.texture : pairs_.texture)
            .add("counts", counts_.texture)
            .add("impulses", impulses.texture)
            .add("shifts", shifts_.texture)
            .add("oldRecords", part.record)
            .add("shapes", groups_[g].shapes.texture);
        program.set("firstSphere", first);
        program.set("partSpheres", part.count * contact_->groups[g].spheresOf);
        const GroupBuffers::Range range = buffers.currentState(part);
        program.storage("State", 0, *range.buffer, range.offset, range.bytes);
        if (ofVertices)
            dispatch(program,
                     size_t(part.count) * size_t(plan_->groups[contact_->groups[g].group].vertexCount));
        else
            dispatchActive(program);
    });
    settled();
}

void MoleculeContact::respond(const Frame& frame, const std::vector<GroupBuffers>& state) {
    const double stepTime = frame.parameters.frameTime;
    // what gravity adds in two steps is no bounce
    const double restSpeed = 2 * glm::length(frame.parameters.gravity) * stepTime;
    Totals totals;
    if (nearest_) {
        runNearest(stepTime, restSpeed, totals);
        return apply(state, impulses_[totals.next]);
    }
    runCrowd(stepTime, restSpeed, state);
    const auto run = [&](const Program& program) {
        runStage(program, stepTime, restSpeed, totals);
        totals = {totals.next, totals.last, totals.earlier};
    };
    run(begin_);
    for (int i = 0; i < contact_->settings.iterations; ++i) {
        totals.momentum = i == 0 ? 0.0f : float(i) / float(i + 3);  // Nesterov's, from rest
        spread(state, totals);
        run(relax_);
    }
    totals.momentum = 0;
    for (int i = 0; i < ContactPlan::frictionRounds; ++i) {
        spread(state, totals);
        run(settle_);
    }
    run(keep_);
    apply(state, impulses_[totals.last]);
}

void MoleculeContact::step(const Frame& frame, const std::vector<GroupBuffers>& state,
                           gpu::PassTimers& timers) {
    {
        const auto timer = timers.time("contact grid");
        buildGrid(frame, state);
    }
    {
        const auto timer = timers.time("contact search");
        search();
    }
    const auto timer = timers.time("contact response");
    respond(frame, state);
}

uint32_t MoleculeContact::dropped() const {
    uint32_t out = 0;
    active_.download(gpu::Traffic::Kind::control, droppedWord * sizeof out, &out, sizeof out);
    return out;
}

std::vector<std::pair<int, int>> MoleculeContact::found() const {
    const auto read = [](const Array& array) {
        std::vector<uint32_t> out(array.buffer.bytes() / sizeof(uint32_t));
        array.buffer.download(gpu::Traffic::Kind::state, 0, out.data(), array.buffer.bytes());
        return out;
    };
    const std::vector<uint32_t> counts = read(counts_), lists = read(lists_), sorted = read(pairs_);
    std::vector<std::pair<int, int>> out;
    for (size_t slot = 0; slot < size_t(contact_->spheres); ++slot) {
        const size_t listed = std::min(size_t(counts[slot]), size_t(contact_->listLength));
        for (size_t e = 0; e < listed; ++e) {
            const size_t other = lists[e * padded_ + slot];
            out.emplace_back(std::minmax(int(sorted[2 * slot + 1]), int(sorted[2 * other + 1])));
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

size_t MoleculeContact::bytes() const {
    size_t out = 0;
    for (const Array* array :
         {&pairs_,       &staggered_,    &starts_,   &slots_,       &lists_,       &counts_,
          &crowds_,      &pushed_,       &shifts_,   &velocities_,  &normals_,     &nearWalls_,
          &wallPushed_,  &apart_,        &groupsOf_, &materials_,   &impulses_[0], &impulses_[1],
          &impulses_[2], &spherePlaces_, &motions_,  &sphereCells_, &cells_,       &places_})
        out += array->buffer ? array->buffer.bytes() : 0;
    return out;
}

}  // namespace shoal
