#include "simulate/texture_contact.h"

#include <algorithm>

#include "gpu/gl.h"
#include "simulate/texture_layers.h"

namespace shoal {

using gpu::Format;
using gpu::Program;
using gpu::Texture;
using gpu::Traffic;

namespace {

constexpr int listLayers = TextureContact::longestList / 4;
static_assert(TextureContact::longestList % 4 == 0);

}  // namespace

TextureContact::TextureContact(gpu::Context& context, const Plan& plan, const Tables& tables,
                               const ContactState& state)
    : ContactPasses(plan, tables, state.fused()),
      rowBits_(plan.contact.rowBits()),
      sort_(context, NetworkSort::Kind::bitonic, size_t(plan.contact.spheres), 2 << rowBits_,
            NetworkSort::Ties::byIndex),
      targets_(context) {
    if (contact_->settings.search == ContactSearch::staggered)
        staggered_.emplace(context, NetworkSort::Kind::bitonic, size_t(contact_->spheres), 2 << rowBits_,
                           NetworkSort::Ties::byIndex);
    makeTextures(context);
    nameTextures();
    makeTables(context);
    makePrograms(context);
    for (const ContactGroup& group : contact_->groups)
        groups_.push_back(makeGroup(context, group, state));
}

int TextureContact::rowsOf(int numbers) const {
    return (numbers + (1 << rowBits_) - 1) >> rowBits_;
}

void TextureContact::makeTextures(gpu::Context& context) {
    const int width = 1 << rowBits_, rows = rowsOf(contact_->spheres);
    const auto texture = [&](Format format, const char* label, int inLayers = 0) {
        return Texture(context, format, width, rows, label, inLayers);
    };
    for (Texture* records : {&spherePlaces_, &sphereMotions_, &sphereCells_, &places_, &motions_, &cells_})
        *records = texture(Format::rgba32ui, "contact records");
    startsOf_ = Texture(context, Format::r32ui, width, rowsOf(1 << contact_->tableBits), "cells");
    const size_t texels = size_t(width) * size_t(rows);
    const auto fill = [&](Texture& filled, const std::vector<uint32_t>& words) {
        filled.upload(Traffic::Kind::parameters, 0, 0, width, rows, words.data(),
                      words.size() * sizeof(uint32_t));
    };
    const std::vector<uint32_t> none(4 * texels);
    std::vector<glm::vec4> far(texels, glm::vec4(0, 0, 0, 1e30f));
    for (const size_t side : {0, 1}) {
        slots_[side] = texture(Format::r32ui, "slots");
        fill(slots_[side], {none.begin(), none.begin() + ptrdiff_t(texels)});
        counts_[side] = texture(Format::rg32ui, "contacts");
        fill(counts_[side], {none.begin(), none.begin() + ptrdiff_t(2 * texels)});
        lists_[side] = texture(Format::rgba32ui, "contact lists", listLayers);
        known_[side] = texture(Format::rgba32f, "known impulses");
        fill(known_[side], none);
        if (!contact_->remembers()) continue;
        anchors_[side] = texture(Format::rgba32f, "contact anchors", longestList);
        if (!walls_) continue;
        // groups that do not collide leave theirs as they are now
        nearWalls_[side] = texture(Format::rgba32f, "walls", 2 * ContactPlan::mostWalls);
        for (int layer = 0; layer < nearWalls_[side].layers(); ++layer)
            nearWalls_[side].upload(Traffic::Kind::parameters, 0, 0, width, rows, far.data(),
                                    far.size() * sizeof far[0], layer);
    }
    for (Texture& totals : totals_)
        totals = texture(Format::rgba32f, "contact totals", 2);
    gains_ = texture(Format::rgba32f, "contact gains", 2);
    loads_ = texture(Format::rgba32f, "contact loads");
    fill(loads_, none);
    if (!contact_->remembers()) return;
    effectiveCounts_ = texture(Format::r32ui, "effective contact counts");
    for (Texture& pushes : pushes_)
        pushes = texture(Format::rgba32f, "contact pushes", longestList);
    normals_ = texture(Format::rgba32f, "contact normals", longestList);
    amounts_ = texture(Format::rgba32f, "contact amounts", longestList);
    if (walls_)
        for (Texture& pushes : wallPushes_)
            pushes = texture(Format::rgba32f, "wall pushes", ContactPlan::mostWalls);
    if (rigid_) bodies_ = texture(Format::rgba32f, "bodies", 3);
    if (!spreads_) return;
    contactSums_ = texture(Format::rgba32f, "contact sums", 2);
    motionsNow_ = texture(Format::rgba32f, "contact motions now", 2);
}

void TextureContact::nameTextures() {
    const std::pair<const char*, const Texture*> names[] = {{"spherePlaces", &spherePlaces_},
                                                            {"sphereMotions", &sphereMotions_},
                                                            {"sphereCells", &sphereCells_},
                                                            {"places", &places_},
                                                            {"motions", &motions_},
                                                            {"cells", &cells_},
                                                            {"starts", &startsOf_},
                                                            {"materials", &materials_},
                                                            {"apart", &apart_},
                                                            {"groupsOf", &groupsOf_},
                                                            {"slots", &slots_[0]},
                                                            {"oldSlots", &slots_[1]},
                                                            {"counts", &counts_[0]},
                                                            {"oldCounts", &counts_[1]},
                                                            {"lists", &lists_[0]},
                                                            {"oldLists", &lists_[1]},
                                                            {"anchors", &anchors_[0]},
                                                            {"oldAnchors", &anchors_[1]},
                                                            {"known", &known_[0]},
                                                            {"oldKnown", &known_[1]},
                                                            {"walls", &nearWalls_[0]},
                                                            {"oldWalls", &nearWalls_[1]},
                                                            {"normals", &normals_},
                                                            {"amounts", &amounts_},
                                                            {"pushes", &pushes_[0]},
                                                            {"oldPushes", &pushes_[0]},
                                                            {"wallPushes", &wallPushes_[0]},
                                                            {"oldWallPushes", &wallPushes_[0]},
                                                            {"totals", &totals_[0]},
                                                            {"effectiveCounts", &effectiveCounts_},
                                                            {"contactSums", &contactSums_},
                                                            {"motionsNow", &motionsNow_},
                                                            {"bodies", &bodies_},
                                                            {"gains", &gains_},
                                                            {"loads", &loads_}};
    for (const auto& [name, texture] : names)
        arrays_.add(name, *texture);
    // which are read under other names
    for (const size_t i : {1, 2}) {
        arrays_.add(concat("pushes ", i), pushes_[i]);
        arrays_.add(concat("wallPushes ", i), wallPushes_[i]);
        arrays_.add(concat("totals ", i), totals_[i]);
    }
}

// A texture of so many texels, by number.
Texture TextureContact::table(gpu::Context& context, Format format, size_t texels, const void* data,
                              const char* label) const {
    const int width = 1 << rowBits_, rows = std::max(1, rowsOf(int(texels)));
    std::vector<char> filled(size_t(width) * size_t(rows) * texelBytes(format));
    std::copy_n(static_cast<const char*>(data), texels * texelBytes(format), filled.begin());
    Texture out(context, format, width, rows, label);
    out.upload(Traffic::Kind::parameters, 0, 0, width, rows, filled.data(), filled.size());
    return out;
}

void TextureContact::makeTables(gpu::Context& context) {
    std::vector<glm::vec4> materials;
    for (const glm::vec2& pair : contact_->pairs)
        materials.emplace_back(pair, 0, 0);
    materials_ = table(context, Format::rgba32f, materials.size(), materials.data(), "contact materials");
    if (!self_) return;
    const ContactPlan::Exclusions exclusions = contact_->exclusions();
    apart_ =
        table(context, Format::r32ui, exclusions.words.size(), exclusions.words.data(), "contact within");
    groupsOf_ = table(context, Format::rgba32ui, exclusions.groups.size(), exclusions.groups.data(),
                      "contact groups");
}

void TextureContact::makePrograms(gpu::Context& context) {
    gpu::ProgramOptions options;
    options.vertex = "passes/fullscreen.vert";
    options.defines = defines(longestList);
    options.defines.insert(options.defines.end(), {"TEXTURES", concat("ROW_BITS ", rowBits_),
                                                   concat("ENTRIES_A_DRAW ", entriesADraw)});
    if (staggered_) options.defines.emplace_back("STAGGERED");
    options.fragment = "contact/old_starts.frag";
    options.label = "contact starts";
    starts_ = Program(context, options);
    const auto make = [&](const char* file) {
        options.fragment = concat("contact/", file, ".frag");
        options.label = concat("contact ", file);
        return Program(context, options);
    };
    keys_ = make("keys");
    order_ = make("order");
    slot_ = make("slots");
    find_ = make(contact_->settings.search == ContactSearch::exact ? "find" : "neighbors");
    if (!contact_->remembers()) {
        nearest_ = make("nearest");
        return;
    }
    prepare_ = make("prepare");
    prepareSums_ = make("prepare_sums");
    constrain_ = make("constrain");
    relax_ = make("relax");
    relaxSums_ = make("relax_sums");
    settle_ = make("settle");
}

TextureContact::OfGroup TextureContact::makeGroup(gpu::Context& context, const ContactGroup& group,
                                                  const ContactState& state) const {
    const GroupPlan& plan = plan_->groups[group.group];
    std::vector<std::string> common = state.defines(group.group);
    common.insert(common.end(), {"TEXTURES", concat("ROW_BITS ", rowBits_),
                                 concat("VERTICES ", plan.vertexCount), concat("SPHERES ", group.spheresOf)});
    const auto define = [&](bool need, const char* name) {
        if (need) common.emplace_back(name);
    };
    for (const std::string& one : group.defines())
        common.push_back(one);
    define(plan.needs.pins, "PINS");
    define(plan.needs.release, "RELEASE");
    define(group.triangles, "TRIANGLES");
    define(rigid_, "BODIES");
    const bool rigid = rigid_ && plan.rigid;
    define(rigid, "RIGID");
    const auto make = [&](const char* file) {
        gpu::ProgramOptions options;
        options.vertex = "passes/fullscreen.vert";
        options.fragment = concat("contact/", file, ".frag");
        options.defines = common;
        options.label = concat("contact ", file, " of ", plan.name);
        options.generated = {{"generated/colliders.glsl", plan_->colliders.source}};
        return Program(context, options);
    };
    OfGroup out;
    out.spheres = make("spheres");
    if (state.fused())
        out.shapes =
            table(context, Format::rgba32f, group.shapes.size(), group.shapes.data(), "contact shapes");
    const std::vector<std::string> ofGroup = common;
    common.insert(common.end(), {"WALLS", concat("MOST_WALLS ", ContactPlan::mostWalls)});
    if (walls_ && plan.needs.collide) out.walls = make("walls");
    common = ofGroup;
    common.emplace_back("APPLIES");
    define(rigid || group.triangles, "MANY");
    out.gains = make("gains");
    common = ofGroup;
    if (!spreads_) return out;
    out.effectiveSum = make("effective_sum");
    out.spread = make("spread");
    return out;
}

void TextureContact::draw(const Into& into, int firstRow, int rows) {
    const gpu::Framebuffer& target = targets_.into(into);
    target.bind(0, firstRow, target.width(), rows);
    gpu::drawVertices(3);
}

void TextureContact::drawAll(const Into& into) {
    draw(into, 0, rowsOf(contact_->spheres));
}

int TextureContact::spheresIn(const ContactGroup& group) const {
    return plan_->groups[group.group].count * group.spheresOf;
}

void TextureContact::drawGroup(const Into& into, size_t group) {
    const ContactGroup& contact = contact_->groups[group];
    const int first = contact.firstSphere >> rowBits_;
    const int end = rowsOf(contact.firstSphere + spheresIn(contact));
    draw(into, first, end - first);
}

const Program& TextureContact::with(const Program& program) const {
    program.use();
    arrays_.bind(program);
    if (program.uses("sorted")) program.texture("sorted", sort_.pairs());
    return program;
}

const Program& TextureContact::withGroup(const Program& program, size_t group) const {
    const ContactGroup& contact = contact_->groups[group];
    with(program).set("firstSphere", contact.firstSphere);
    program.set("partSpheres", spheresIn(contact));
    if (program.uses("shapes")) program.texture("shapes", groups_[group].shapes);
    return program;
}

void TextureContact::makeWalls(const Frame& frame, ContactState& state) {
    for (size_t g = 0; g < groups_.size(); ++g) {
        if (!groups_[g].walls) continue;
        const ContactGroup& group = contact_->groups[g];
        const GroupPlan& plan = plan_->groups[group.group];
        const Program& program = withGroup(groups_[g].walls, g);
        state.bind(program, group.group);
        const std::vector<glm::vec4> parameters = colliderParameters(*plan_, plan, frame);
        program.set("colliderParameters", std::span<const glm::vec4>(parameters));
        program.set("contactStep", float(frame.parameters.frameTime));
        program.set("givenRadius", float(group.radius));
        tables_->bind(program, *plan_);
        drawGroup({&nearWalls_[0]}, g);
    }
}

void TextureContact::makeSpheres(const Frame& frame, ContactState& state) {
    Into into = {&spherePlaces_, &sphereMotions_, &sphereCells_};
    if (rigid_) into.emplace_back(&bodies_);
    for (size_t g = 0; g < groups_.size(); ++g) {
        const ContactGroup& group = contact_->groups[g];
        const GroupPlan& plan = plan_->groups[group.group];
        const Program& program = withGroup(groups_[g].spheres, g);
        state.bind(program, group.group);
        if (state.fused()) {
            program.set("contactStep", float(frame.parameters.frameTime));
        } else {
            program.texture("topology", tables_->topology);
            program.set("topologyBase", plan.topologyBase);
            program.set("vertexCount", plan.vertexCount);
        }
        program.set("label", int(uint32_t(g) << 26));
        program.set("cell", float(contact_->cell));
        program.set("givenRadius", float(group.radius));
        drawGroup(into, g);
    }
}

void TextureContact::sortKeys(NetworkSort& sort, bool staggered) {
    with(keys_).set("count", contact_->spheres);
    keys_.set("keyMask", keyMask());
    keys_.set("cell", float(contact_->cell));
    keys_.set("staggered", int(staggered));
    sort.drawInto(sort.target());
    gpu::drawVertices(3);
    sort.flip();
    sort.sort();
}

void TextureContact::buildGrid(const Frame& frame, ContactState& state) {
    for (auto* sides : {&slots_, &counts_, &lists_, &anchors_, &known_, &nearWalls_})
        std::swap((*sides)[0], (*sides)[1]);
    makeSpheres(frame, state);
    makeWalls(frame, state);
    sortKeys(sort_, false);
    if (staggered_) sortKeys(*staggered_, true);
    with(starts_).set("count", contact_->spheres);
    draw({&startsOf_}, 0, startsOf_.height());
    with(order_).set("count", contact_->spheres);
    drawAll({&places_, &motions_, &cells_});
    with(slot_).set("count", contact_->spheres);
    slot_.set("keyMask", keyMask());
    drawAll({&slots_[0]});
}

void TextureContact::search(ContactState&, const Times& times) {
    with(find_).set("count", contact_->spheres);
    if (contact_->settings.search == ContactSearch::exact) find_.set("reach", float(contact_->reach));
    if (staggered_) find_.texture("staggered", staggered_->pairs());
    if (contact_->settings.fastest) setTimes(find_, times);
    find_.set("keyMask", keyMask());
    find_.set("cell", float(contact_->cell));
    drawAll({&counts_[0], &lists_[0]});
}

uint32_t TextureContact::dropped() const {
    const auto counts = readLayers<glm::uvec2>(counts_[0], Traffic::Kind::control);
    uint32_t out = 0;
    for (size_t slot = 0; slot < size_t(contact_->spheres); ++slot)
        out += counts[slot].y;
    return out;
}

// Entries of all slots, one after another.
static std::vector<uint32_t> readLists(const Texture& texture) {
    const auto lists = readLayers<glm::uvec4>(texture);  // four entries a texel
    const size_t stride = lists.size() / size_t(listLayers);
    std::vector<uint32_t> out;
    for (size_t e = 0; e < 4 * size_t(listLayers); ++e)
        for (size_t slot = 0; slot < stride; ++slot)
            out.push_back(lists[e / 4 * stride + slot][int(e % 4)]);
    return out;
}

ContactMemory TextureContact::memory() const {
    if (!contact_->remembers()) return {};
    const size_t spheres = size_t(contact_->spheres);
    ContactSlots out;
    out.stride = size_t(counts_[0].width()) * size_t(counts_[0].height());
    out.slots = readLayers<uint32_t>(slots_[0]);
    out.slots.resize(spheres);
    const auto counts = readLayers<glm::uvec2>(counts_[0]);  // by slot
    for (const glm::uvec2& count : counts)
        out.counts.push_back(std::min(count.x & contactsMask, uint32_t(longestList)));
    if (std::all_of(counts.begin(), counts.end(), [](const glm::uvec2& count) { return count.x == 0; }))
        return {};
    out.lists = readLists(lists_[0]);
    out.pushes = readLayers<glm::vec4>(pushes_[0]);
    out.anchors = readLayers<glm::vec4>(anchors_[0]);
    out.known = readLayers<glm::vec4>(known_[0]);
    out.loads = readLayers<glm::vec4>(loads_);
    out.loads.resize(spheres);
    if (!walls_) return bySphere(out);
    out.walls = byElement(readLayers<glm::vec4>(nearWalls_[0]), out.stride, spheres);
    const auto pushes = readLayers<glm::vec4>(wallPushes_[0]);  // by slot
    for (const uint32_t slot : out.slots)
        for (size_t k = 0; k < size_t(ContactPlan::mostWalls); ++k)
            out.wallPushes.push_back(counts[slot].x == 0 ? glm::vec4(0)
                                                         : pushes[k * out.stride + slot] *
                                                               glm::vec4(glm::vec3(out.known[slot].w), 1));
    return bySphere(out);
}

void TextureContact::remember(const ContactMemory& memory) {
    if (!contact_->remembers()) return;
    const size_t spheres = size_t(contact_->spheres);
    if (memory.counts.size() != spheres) {
        writeLayers<glm::uvec2>(counts_[0], {});
        return writeLayers<glm::vec4>(loads_, {});
    }
    const size_t stride = size_t(counts_[0].width()) * size_t(counts_[0].height());
    const ContactSlots in = bySlot(memory, stride, size_t(longestList));
    std::vector<glm::uvec2> counts;
    for (size_t sphere = 0; sphere < spheres; ++sphere)
        counts.emplace_back(in.counts[sphere] | (isHeld(in, sphere) ? heldFlag : 0), 0);
    std::vector<glm::uvec4> lists(stride * size_t(listLayers));
    for (size_t e = 0; e < size_t(longestList); ++e)
        for (size_t slot = 0; slot < stride; ++slot)
            lists[e / 4 * stride + slot][int(e % 4)] = in.lists[e * stride + slot];
    writeLayers(slots_[0], in.slots);
    writeLayers(counts_[0], counts);
    writeLayers(lists_[0], lists);
    writeLayers(pushes_[0], in.pushes);
    writeLayers(anchors_[0], in.anchors);
    std::vector<glm::vec4> known = in.known;
    for (glm::vec4& of : known)
        of.w = 1;
    writeLayers(known_[0], known);
    writeLayers(loads_, in.loads);
    if (!walls_ || in.walls.empty()) return;
    writeLayers(nearWalls_[0], byLayer(in.walls, stride, spheres));
    writeLayers(wallPushes_[0], byLayer(in.wallPushes, stride, spheres));
}

std::vector<std::pair<int, int>> TextureContact::found() const {
    std::vector<uint32_t> counts, spheres;
    for (const glm::uvec2& count : readLayers<glm::uvec2>(counts_[0]))
        counts.push_back(count.x);
    for (const KeyIndex& pair : sort_.download())
        spheres.push_back(pair.index);
    return pairsOf(counts, readLists(lists_[0]), counts.size(), spheres);
}

size_t TextureContact::bytes() const {
    return 2 * sort_.pairs().bytes() * (staggered_ ? 2 : 1) + arrays_.bytes();
}

}  // namespace shoal
