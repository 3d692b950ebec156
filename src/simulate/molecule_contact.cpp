#include "simulate/molecule_contact.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "simulate/fused_kernel.h"

namespace shoal {

using gpu::Barrier;
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
    return contact.remembers() ? 4 : 1;
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

MoleculeContact::MoleculeContact(gpu::Context& context, const Plan& plan, const Tables& tables,
                                 const SimulationOptions& options)
    : ContactPasses(plan, tables, true),
      context_((checkLimits(context.info(), plan.contact), &context)),
      counted_(options.asOnGpu.value_or(!context.info().software)),
      padded_((size_t(plan.contact.spheres) + contactLanes - 1) / contactLanes * contactLanes),
      listLength_(int(
          std::min(size_t(plan.contact.listLength), mostEntries(context.info(), plan.contact) / padded_))) {
    makeArrays();
    makeExclusions();
    makeMaterials();
    makePrograms();
    for (const ContactGroup& group : contact_->groups)
        makeGroup(group);
}

// The arrays of contact: a row each, in which the name is that of the sampler; the storage block begins with
// a capital. Spheres begin without contacts, so that what there is of them is zero; of entries of lists what
// there is was written before it is read.
void MoleculeContact::makeArrays() {
    enum class Start { undefined, zero, far };
    const size_t cells = size_t(1) << contact_->tableBits, entries = padded_ * size_t(listLength_);
    const size_t walls = 2 * size_t(ContactPlan::mostWalls) * padded_;
    const bool remembers = contact_->remembers(), rest = rests();
    const bool staggers = contact_->settings.search == ContactSearch::staggered;
    const auto add = [&](bool needed, Array& array, const char* name, size_t texels, Texel texel,
                         Start start) {
        arrays_.add(name, array);
        if (!needed) return;
        std::vector<glm::vec4> first;
        if (start != Start::undefined)
            first.resize(texels, start == Start::zero ? glm::vec4(0) : glm::vec4(0, 0, 0, 1e30f));
        array = Array(*context_, texels, texel, concat("contact ", name).c_str(),
                      first.empty() ? nullptr : first.data());
    };
    using enum Start;
    add(true, spherePlaces_, "spherePlaces", padded_, Texel::uint4, undefined);
    add(true, sphereCells_, "sphereCells", padded_, Texel::uint4, undefined);
    add(true, motions_, "motions", padded_, Texel::uint4, undefined);
    add(true, pairs_, "sorted", padded_, Texel::uint2, undefined);
    add(staggers, staggered_, "staggered", padded_, Texel::uint2, undefined);
    add(true, cellStarts_, "starts", cells + 1, Texel::uint1, undefined);
    add(counted_, arrivals_, "arrivals", padded_, Texel::uint2, undefined);
    add(counted_, members_, "members", padded_, Texel::uint1, undefined);
    add(true, places_, "places", padded_, Texel::uint4, undefined);
    add(true, cells_, "cells", padded_, Texel::uint4, undefined);
    add(true, slots_, "slots", padded_, Texel::uint1, zero);
    add(true, counts_, "counts", padded_, Texel::uint1, zero);
    add(true, lists_, "lists", entries, Texel::uint1, undefined);
    // what one step leaves to the next
    add(true, known_, "known", padded_, Texel::float4, zero);
    add(remembers, partners_, "partners", entries, Texel::uint1, undefined);
    add(remembers, oldPushes_, "oldPushes", entries, Texel::float4, undefined);
    add(remembers, oldAnchors_, "oldAnchors", entries, Texel::float4, undefined);
    add(remembers, loads_, "loads", padded_, Texel::float4, zero);
    add(rest, calm_, "calm", padded_, Texel::float4, zero);
    // groups that do not collide leave theirs as they are now
    add(walls_, nearWalls_, "walls", walls, Texel::float4, far);
    add(walls_, wallPushes_, "wallPushes", walls, Texel::float4, zero);
    // of the response
    add(true, totals_[0], "totals", 2 * padded_, Texel::float4, zero);
    add(true, totals_[1], "totalsBefore", 2 * padded_, Texel::float4, zero);
    add(true, totals_[2], "totalsNext", 2 * padded_, Texel::float4, zero);
    add(remembers, anchors_, "anchors", entries, Texel::float4, undefined);
    add(remembers, normals_, "normals", entries, Texel::float4, undefined);
    add(remembers, amounts_, "amounts", entries, Texel::float4, undefined);
    add(remembers, pushes_[0], "pushes", entries, Texel::float4, undefined);
    add(remembers, pushes_[1], "earlierPushes", entries, Texel::float4, undefined);
    add(remembers, effectiveCounts_, "effectiveCounts", padded_, Texel::uint1, zero);
    add(remembers, motionsNow_[0], "motionsNow", 2 * padded_, Texel::float4, zero);
    add(remembers && !spreads_, motionsNow_[1], "motionsNext", 2 * padded_, Texel::float4, zero);
    add(spreads_, contactSums_, "contactSums", 2 * padded_, Texel::float4, zero);
    add(rigid_, bodies_, "bodies", 3 * padded_, Texel::float4, zero);
    // of rest
    add(rest, marks_, "marks", padded_, Texel::uint1, zero);
    add(rest, awakeSlots_, "awakeSlots", padded_, Texel::uint1, zero);
    add(rest, markedSlots_, "markedSlots", padded_, Texel::uint1, zero);
    arrays_.add("oldLists", partners_);  // as fragments call them
    arrays_.add("apart", apart_);
    arrays_.add("groupsOf", groupsOf_);
    arrays_.add("materials", materials_);

    const auto words = [&](bool needed, gpu::Buffer& buffer, const char* name, size_t count) {
        arrays_.add(name, buffer);
        const std::vector<uint32_t> none(needed ? count : 0);
        if (needed)
            buffer = gpu::Buffer(*context_, gpu::Buffer::Use::storage, std::span<const uint32_t>(none),
                                 concat("contact ", name).c_str());
    };
    words(counted_, cellCounts_, "cellCounts", countWords(cells));
    words(true, touching_, "touching", 1 + padded_);
    words(true, touchingGroups_, "groups", 3);
    words(true, dropped_, "dropped", 1);
    words(rest, markGroups_, "markGroups", 11);
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

void MoleculeContact::bindLoads(const Program& program, size_t group, const GroupBuffers::Part& part) const {
    const ContactGroup* contact = contact_->of(group);
    if (!contact || !contact_->remembers()) return;
    program.set("firstSphere", contact->firstSphere + part.first * contact->spheresOf);
    program.texture("contactLoads", loads_.texture);
    if (contact_->mayRest(plan_->groups[group]))
        program.set("probes", int(groups_[size_t(contact - contact_->groups.data())].probes));
}

const Program& MoleculeContact::with(const Program& program) const {
    program.use();
    arrays_.bind(program);
    return program;
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
    return arrays_.bytes();
}

}  // namespace shoal
