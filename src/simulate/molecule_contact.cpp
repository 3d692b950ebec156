#include "simulate/molecule_contact.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "gpu/buffer.h"
#include "simulate/fused_kernel.h"

namespace shoal {

using gpu::Barrier;
using gpu::BufferTexture;
using gpu::Program;
using gpu::Texel;

namespace {

constexpr size_t contactLanes = 64;  // of a workgroup, as the shaders say
constexpr size_t lineWords = 32;     // of a GPU's cache

// Words of the counts of so many cells and of their tiles (shaders/contact/cell_counts.glsl).
size_t countWords(size_t cells) {
    return cells + (cells + MoleculeContact::cellTile - 1) / MoleculeContact::cellTile * lineWords;
}

// Tells shaders that the keys are sorted by counting.
void addCounting(std::vector<std::string>& defines) {
    defines.insert(defines.end(), {"COUNTED", concat("CELL_TILE ", MoleculeContact::cellTile),
                                   concat("LINE_WORDS ", lineWords)});
}

size_t wordsOf(Texel texel) {
    static constexpr size_t words[] = {4, 4, 2, 1};
    return words[size_t(texel)];
}

void checkLimits(const gpu::ContextInfo& info, const ContactPlan& contact) {
    const size_t most = MoleculeContact::most(info, contact);
    if (size_t(contact.spheres) <= most) return;
    throw Error(contact.settings.location,
                concat("contact between ", contact.spheres,
                       " spheres is more than this context holds: at most ", most));
}

}  // namespace

// Words of an entry of the largest array of lists.
static size_t entryWords(const ContactPlan& contact) {
    return wordsOf(contact.remembers() ? Texel::float4 : Texel::uint1);
}

// Entries of all lists together.
static size_t mostEntries(const gpu::ContextInfo& info, const ContactPlan& contact) {
    return std::min(size_t(info.maxStorageBlockBytes) / (entryWords(contact) * sizeof(uint32_t)),
                    size_t(info.maxBufferTexels));
}

// Spheres for whose table of cells there is room.
static size_t mostOfTable(const gpu::ContextInfo& info) {
    const size_t words =
        std::min(size_t(info.maxStorageBlockBytes) / sizeof(uint32_t), size_t(info.maxBufferTexels));
    size_t cells = std::bit_floor(words);
    while (countWords(cells) > words)
        cells /= 2;
    return cells / 2;
}

size_t MoleculeContact::most(const gpu::ContextInfo& info, const ContactPlan& contact) {
    return std::min({mostEntries(info, contact) / shortestList,
                     size_t(info.maxStorageBlockBytes) / sizeof(glm::vec4),
                     size_t(info.maxWorkGroupsX) * contactLanes, RadixSort::most(info), mostOfTable(info)});
}

MoleculeContact::Array::Array(gpu::Context& context, size_t texels, Texel texel, const char* label,
                              const void* data)
    : buffer(context, gpu::Buffer::Use::storage, data, texels * wordsOf(texel) * sizeof(uint32_t), label),
      texture(context, buffer, texel, label) {}

MoleculeContact::MoleculeContact(gpu::Context& context, const Plan& plan, const Tables& tables,
                                 const SimulationOptions& options)
    : ContactPasses(plan, tables, true),
      context_((checkLimits(context.info(), plan.contact), &context)),
      counted_(options.asOnGpu.value_or(!context.info().software)),
      padded_((size_t(plan.contact.spheres) + contactLanes - 1) / contactLanes * contactLanes),
      listLength_(int(
          std::min(size_t(plan.contact.listLength), mostEntries(context.info(), plan.contact) / padded_))) {
    const auto array = [&](size_t texels, Texel texel, const char* label) {
        return Array(context, texels, texel, label);
    };
    spherePlaces_ = array(padded_, Texel::uint4, "contact places");
    places_ = array(padded_, Texel::uint4, "contact places in order");
    motions_ = array(padded_, Texel::uint4, "contact motions");
    sphereCells_ = array(padded_, Texel::uint4, "contact cells");
    cells_ = array(padded_, Texel::uint4, "contact cells in order");
    const size_t cells = size_t(1) << contact_->tableBits;
    pairs_ = array(padded_, Texel::uint2, "contact keys");
    if (contact_->settings.search == ContactSearch::staggered)
        staggered_ = array(padded_, Texel::uint2, "staggered keys");
    cellStarts_ = array(cells + 1, Texel::uint1, "cells");
    if (counted_) {
        arrivals_ = array(padded_, Texel::uint2, "spheres on their way to cells");
        members_ = array(padded_, Texel::uint1, "spheres of cells");
    }
    const auto zeros = [&](size_t words, const char* label) {
        const std::vector<uint32_t> none(words);
        return gpu::Buffer(context, gpu::Buffer::Use::storage, std::span<const uint32_t>(none), label);
    };
    if (counted_) cellCounts_ = zeros(countWords(cells), "spheres in cells");
    touching_ = zeros(1 + padded_, "in contact");
    touchingGroups_ = zeros(3, "workgroups in contact");
    dropped_ = zeros(1, "contacts left out");
    if (rests()) markGroups_ = zeros(11, "workgroups of contact marks");
    makeMemory();
    makeExclusions();
    makeMaterials();
    makePrograms();
    for (const ContactGroup& group : contact_->groups)
        makeGroup(group);
}

void MoleculeContact::makeMemory() {
    // All spheres begin without contacts; what there is of an entry of a list is written before it is read.
    const auto array = [&](size_t texels, Texel texel, const char* label) {
        const std::vector<uint32_t> none(texels * wordsOf(texel));
        return Array(*context_, texels, texel, label, none.data());
    };
    const auto ofEntries = [&](Texel texel, const char* label) {
        return Array(*context_, padded_ * size_t(listLength_), texel, label);
    };
    slots_ = array(padded_, Texel::uint1, "slots");
    counts_ = array(padded_, Texel::uint1, "contacts");
    lists_ = ofEntries(Texel::uint1, "contact lists");
    known_ = array(padded_, Texel::float4, "known impulses");
    for (Array& totals : totals_)
        totals = array(2 * padded_, Texel::float4, "contact totals");
    if (!contact_->remembers()) return;
    partners_ = ofEntries(Texel::uint1, "contact partners");
    oldPushes_ = ofEntries(Texel::float4, "remembered pushes");
    oldAnchors_ = ofEntries(Texel::float4, "remembered anchors");
    anchors_ = ofEntries(Texel::float4, "contact anchors");
    normals_ = ofEntries(Texel::float4, "contact normals");
    amounts_ = ofEntries(Texel::float4, "contact amounts");
    for (Array& pushes : pushes_)
        pushes = ofEntries(Texel::float4, "contact pushes");
    loads_ = array(padded_, Texel::float4, "contact loads");
    effectiveCounts_ = array(padded_, Texel::uint1, "effective contact counts");
    if (rests()) {
        calm_ = array(padded_, Texel::float4, "calm places");
        marks_ = array(padded_, Texel::uint1, "contact marks");
        awakeSlots_ = array(padded_, Texel::uint1, "awake slots");
        markedSlots_ = array(padded_, Texel::uint1, "marked slots");
    }
    if (walls_) {
        // groups that do not collide leave theirs as they are now
        const size_t texels = 2 * ContactPlan::mostWalls * padded_;
        const std::vector<glm::vec4> far(texels, glm::vec4(0, 0, 0, 1e30f));
        nearWalls_ = Array(*context_, texels, Texel::float4, "walls", far.data());
        wallPushes_ = array(texels, Texel::float4, "wall pushes");
    }
    if (rigid_) bodies_ = array(3 * padded_, Texel::float4, "bodies");
    motionsNow_[0] = array(2 * padded_, Texel::float4, "contact motions now");
    if (!spreads_) motionsNow_[1] = array(2 * padded_, Texel::float4, "next contact motions");
    if (spreads_) contactSums_ = array(2 * padded_, Texel::float4, "contact sums");
}

void MoleculeContact::makePrograms() {
    std::vector<std::string> common = defines(listLength_);
    if (rests()) common.emplace_back("RESTING");
    gpu::ProgramOptions options;
    const auto make = [&](const char* file, const char* define = nullptr) {
        options.compute = concat("contact/", file, ".comp");
        options.label = concat("contact ", file);
        options.defines = common;
        if (define) options.defines.emplace_back(define);
        return Program(*context_, options);
    };
    if (counted_) {
        addCounting(common);
        common.insert(common.end(), {"LANES 256", "AHEAD 4"});
        starts_ = make("starts");
        collect_ = make("members");
    } else {
        sort_.emplace(*context_, padded_);
    }
    order_ = make("order");
    find_ = make(contact_->settings.search == ContactSearch::exact ? "find" : "neighbors");
    if (staggered_.buffer) findStaggered_ = make("neighbors", "STAGGERED");
    if (!contact_->remembers()) {
        nearest_ = make("nearest");
        return;
    }
    if (rests()) {
        findResting_ = make("find", "AMONG_RESTING");
        sift_ = make("sift");
        wake_ = make("wake");
        weigh_ = make("weigh");
    }
    prepare_ = make("prepare");
    relaxFirst_ = make("relax", "FIRST");
    relax_ = make("relax");
    settle_ = make("settle");
}

void MoleculeContact::makeGroup(const ContactGroup& group) {
    const GroupPlan& plan = plan_->groups[group.group];
    std::vector<std::string> common = plan.layout().defines();
    common.insert(common.end(), {concat("VERTICES ", plan.vertexCount), concat("SPHERES ", group.spheresOf),
                                 concat("MOST_WALLS ", ContactPlan::mostWalls)});
    for (const std::string& one : group.defines())
        common.push_back(one);
    if (group.triangles) common.push_back("TRIANGLES");
    if (contact_->remembers()) common.push_back("REMEMBERS");
    if (rests()) common.push_back("RESTING");
    if (plan.needs.release) common.push_back("RELEASE");
    const bool rigid = rigid_ && plan.rigid;
    if (rigid) common.push_back("RIGID");
    if (plan.needs.scale || plan.needs.phase) common.push_back("CONSTANTS");
    if (counted_) addCounting(common);
    const auto make = [&](const char* file, const char* define = nullptr) {
        gpu::ProgramOptions options;
        options.compute = concat("contact/", file, ".comp");
        options.label = concat("contact ", file, " of ", plan.name);
        options.defines = common;
        if (define) options.defines.emplace_back(define);
        options.generated = {{"generated/colliders.glsl", plan_->colliders.source}};
        return Program(*context_, options);
    };
    GroupPrograms& out = groups_.emplace_back();
    out.spheres = make("spheres", walls_ && plan.needs.collide ? "WALLS" : nullptr);
    common.emplace_back("APPLIES");
    out.apply = make("apply", group.triangles || rigid ? "MANY" : nullptr);
    common.pop_back();
    if (contact_->mayRest(plan)) out.rest = make("rest");
    if (spreads_) {
        out.effectiveSum = make("effective_sum");
        out.spread = make("spread");
    }
    const std::vector<glm::vec4>& shapes = group.shapes;
    out.shapes = Array(*context_, shapes.size(), Texel::float4, "contact shapes", shapes.data());
}

void MoleculeContact::makeExclusions() {
    if (!self_ && !rests()) return;
    const auto [words, groups] = contact_->exclusions();
    if (self_) apart_ = Array(*context_, words.size(), Texel::uint1, "contact within", words.data());
    groupsOf_ = Array(*context_, groups.size(), Texel::uint4, "contact groups", groups.data());
}

void MoleculeContact::makeMaterials() {
    std::vector<glm::vec4> pairs;
    for (const glm::vec2& pair : contact_->pairs)
        pairs.emplace_back(pair, 0, 0);
    materials_ = Array(*context_, pairs.size(), Texel::float4, "contact materials", pairs.data());
}

void MoleculeContact::settled() {
    gpu::barrier({Barrier::textureFetch, Barrier::storage, Barrier::command});
}

void MoleculeContact::dispatch(const Program& program, size_t count) const {
    ++dispatches_;
    program.dispatch(int((count + contactLanes - 1) / contactLanes));
}

// Sets which spheres a program handles and returns their number.
size_t MoleculeContact::setSpheres(const Program& program, const SphereRange& range) const {
    program.set("firstSphere", range.first);
    program.set("partSpheres", range.count);
    return size_t(range.count);
}

void MoleculeContact::bindLoads(const Program& program, int unit, size_t group,
                                const GroupBuffers::Part& part) const {
    const ContactGroup* contact = contact_->of(group);
    if (!contact || !contact_->remembers()) return;
    program.set("firstSphere", contact->firstSphere + part.first * contact->spheresOf);
    program.texture("contactLoads", unit, loads_.texture);
    if (contact_->mayRest(plan_->groups[group]))
        program.set("probes", int(groups_[size_t(contact - contact_->groups.data())].probes));
}

void MoleculeContact::useTouching(const Program& program) const {
    program.storage("Touching", 5, touching_);
    program.storage("Groups", 6, touchingGroups_);
}

void MoleculeContact::useMarks(const Program& program) const {
    if (!rests()) return;
    program.storage("Marks", 3, marks_.buffer);
    program.storage("MarkGroups", 7, markGroups_);
}

void MoleculeContact::begin(const Frame& frame) {
    wakes_ = frame.restarts;
    for (size_t g = 0; rests() && g < groups_.size(); ++g) {
        std::vector<glm::vec4> numbers = stepNumbers(*plan_, plan_->groups[contact_->groups[g].group], frame);
        groups_[g].probes = numbers != groups_[g].numbers;
        groups_[g].numbers = std::move(numbers);
    }
}

uint32_t MoleculeContact::dropped() const {
    uint32_t out = 0;
    dropped_.download(gpu::Traffic::Kind::control, 0, &out, sizeof out);
    return out;
}

// Reads back so many texels.
template <typename T>
static std::vector<T> readBack(const gpu::Buffer& buffer, size_t count) {
    std::vector<T> out(count);
    if (count > 0) buffer.download(gpu::Traffic::Kind::state, 0, out.data(), count * sizeof(T));
    return out;
}

template <typename T>
static void write(gpu::Buffer& buffer, const std::vector<T>& values) {
    if (!values.empty())
        buffer.update(gpu::Traffic::Kind::state, 0, values.data(), values.size() * sizeof values[0]);
}

ContactMemory MoleculeContact::memory() const {
    if (!contact_->remembers()) return {};
    const size_t spheres = size_t(contact_->spheres), entries = padded_ * size_t(listLength_);
    ContactSlots in;  // a slot is a sphere
    in.stride = padded_;
    in.slots.resize(spheres);
    std::iota(in.slots.begin(), in.slots.end(), 0u);
    in.known = readBack<glm::vec4>(known_.buffer, spheres);
    for (const glm::vec4& known : in.known)
        in.counts.push_back(uint32_t(known.w));
    if (!rests() &&
        std::all_of(in.counts.begin(), in.counts.end(), [](uint32_t count) { return count == 0; }))
        return {};
    in.lists = readBack<uint32_t>(partners_.buffer, entries);
    in.pushes = readBack<glm::vec4>(oldPushes_.buffer, entries);
    in.anchors = readBack<glm::vec4>(oldAnchors_.buffer, entries);
    in.loads = readBack<glm::vec4>(loads_.buffer, spheres);
    const size_t walls = walls_ ? 2 * ContactPlan::mostWalls * spheres : 0;
    in.walls = readBack<glm::vec4>(nearWalls_.buffer, walls);
    const auto wallPushes = readBack<glm::vec4>(wallPushes_.buffer, walls);
    for (size_t i = 0; i < wallPushes.size(); i += 2)
        in.wallPushes.push_back(wallPushes[i]);
    ContactMemory out = bySphere(in);
    if (rests()) out.calm = readBack<glm::vec4>(calm_.buffer, spheres);
    return out;
}

void MoleculeContact::remember(const ContactMemory& memory) {
    if (!contact_->remembers()) return;
    if (memory.counts.size() != size_t(contact_->spheres)) {
        const std::vector<glm::vec4> none(padded_);
        write(known_.buffer, none);
        if (rests()) write(calm_.buffer, none);
        return write(loads_.buffer, none);
    }
    ContactSlots in = bySlot(memory, padded_, size_t(listLength_));
    for (size_t sphere = 0; sphere < in.known.size(); ++sphere)
        in.known[sphere].w = float(in.counts[sphere]) + (isHeld(in, sphere) ? 0.5f : 0.0f);
    write(partners_.buffer, in.lists);
    write(oldPushes_.buffer, in.pushes);
    write(oldAnchors_.buffer, in.anchors);
    write(known_.buffer, in.known);
    write(loads_.buffer, in.loads);
    if (rests()) write(calm_.buffer, memory.calm);
    if (!walls_ || in.walls.empty()) return;
    std::vector<glm::vec4> pushes;
    for (size_t i = 0; i < in.wallPushes.size(); ++i)
        pushes.insert(pushes.end(), {in.wallPushes[i], in.walls[2 * i]});
    write(wallPushes_.buffer, pushes);
}

std::vector<std::pair<int, int>> MoleculeContact::found() const {
    const auto sorted = readBack<glm::uvec2>(pairs_.buffer, size_t(contact_->spheres));
    std::vector<uint32_t> spheres;
    for (const glm::uvec2& pair : sorted)
        spheres.push_back(pair.y);
    return pairsOf(readBack<uint32_t>(counts_.buffer, padded_),
                   readBack<uint32_t>(lists_.buffer, padded_ * size_t(listLength_)), padded_, spheres);
}

size_t MoleculeContact::bytes() const {
    size_t out = touching_.bytes() + (counted_ ? cellCounts_.bytes() : 0);
    const auto add = [&](const Array& array) { out += array.buffer ? array.buffer.bytes() : 0; };
    for (const Array* array :
         {&arrivals_,   &cellStarts_, &members_,         &pairs_,       &staggered_, &apart_,
          &groupsOf_,   &materials_,  &spherePlaces_,    &sphereCells_, &motions_,   &cells_,
          &places_,     &loads_,      &effectiveCounts_, &contactSums_, &bodies_,    &wallPushes_,
          &slots_,      &counts_,     &lists_,           &anchors_,     &known_,     &nearWalls_,
          &partners_,   &oldPushes_,  &oldAnchors_,      &calm_,        &marks_,     &markedSlots_,
          &awakeSlots_, &normals_,    &amounts_})
        add(*array);
    std::for_each(pushes_.begin(), pushes_.end(), add);
    std::for_each(totals_.begin(), totals_.end(), add);
    std::for_each(motionsNow_.begin(), motionsNow_.end(), add);
    return out;
}

}  // namespace shoal
