#include "simulate/texture_contact.h"

#include <algorithm>

#include "gpu/gl.h"

namespace shoal {

using gpu::Format;
using gpu::Program;
using gpu::Texture;
using gpu::Traffic;

namespace {

constexpr int layers = TextureContact::longestList / 4;
static_assert(TextureContact::longestList % 4 == 0);

}  // namespace

TextureContact::TextureContact(gpu::Context& context, const std::string& shaderRoot, const Plan& plan,
                               const Tables& tables, const ContactState& state, gpu::ProgramCache* cache)
    : ContactPasses(plan, tables),
      rowBits_(plan.contact.rowBits()),
      sort_(context, shaderRoot, NetworkSort::Kind::bitonic, size_t(plan.contact.spheres), 2 << rowBits_,
            cache, NetworkSort::Ties::byIndex),
      targets_(context),
      noAttributes_(context, "contact") {
    for (const ContactGroup& group : contact_->groups) {
        triangles_ |= group.triangles;
        self_ |= group.self;
        walls_ |= state.fused() && plan.groups[group.group].needs.collide;
    }
    if (contact_->settings.search == ContactSearch::staggered)
        staggered_.emplace(context, shaderRoot, NetworkSort::Kind::bitonic, size_t(contact_->spheres),
                           2 << rowBits_, cache, NetworkSort::Ties::byIndex);
    makeTextures(context);
    makeTables(context);
    makePrograms(context, shaderRoot, cache);
    for (const ContactGroup& group : contact_->groups)
        groups_.push_back(makeGroup(context, group, state, shaderRoot, cache));
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
    slotsOf_ = texture(Format::r32ui, "slots");
    lists_ = texture(Format::rgba32ui, "contact lists", layers);
    const std::vector<uint32_t> none(2 * size_t(width) * size_t(rows));
    for (Texture& counts : counts_) {
        counts = texture(Format::rg32ui, "contacts");
        counts.upload(Traffic::Kind::parameters, 0, 0, width, rows, none.data(),
                      none.size() * sizeof(uint32_t));
    }
    shifts_ = texture(Format::rgba32f, "contact shifts");
    for (Texture& impulses : impulses_)
        impulses = texture(Format::rgba32f, "contact impulses");
    if (contact_->settings.response == ContactResponse::simultaneous) {
        effectiveCounts_ = texture(Format::r32ui, "effective contact counts");
        for (Texture& pushes : pushes_)
            pushes = texture(Format::rgba32f, "contact pushes", layers);
    }
    if (walls_) {
        sphereWalls_ = texture(Format::rgba32f, "walls");
        nearWalls_ = texture(Format::rgba32f, "walls in order");
    }
    if (!triangles_) return;
    for (Texture* part : {&diagonals_, &besides_})
        *part = texture(Format::rgba32f, "contact normals");
    velocities_ = texture(Format::rgba32f, "contact velocities");
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

void TextureContact::makePrograms(gpu::Context& context, const std::string& shaderRoot,
                                  gpu::ProgramCache* cache) {
    gpu::ProgramOptions options;
    options.vertex = "passes/fullscreen.vert";
    options.defines = {"TEXTURES", concat("ROW_BITS ", rowBits_), concat("LIST ", longestList),
                       concat("NEIGHBORS ", contact_->settings.neighbors)};
    const auto define = [&](bool need, const char* name) {
        if (need) options.defines.emplace_back(name);
    };
    define(bool(staggered_), "STAGGERED");
    define(self_, "SELF");
    define(triangles_, "TRIANGLES");
    define(walls_, "WALLS");
    options.cache = cache;
    options.fragment = "sort/starts.frag";
    options.label = "contact starts";
    starts_ = Program(context, shaderRoot, options);
    const auto make = [&](const char* file) {
        options.fragment = concat("contact/", file, ".frag");
        options.label = concat("contact ", file);
        return Program(context, shaderRoot, options);
    };
    keys_ = make("keys");
    order_ = make("order");
    slots_ = make("slots");
    find_ = make(contact_->settings.search == ContactSearch::exact ? "find" : "neighbors");
}

TextureContact::OfGroup TextureContact::makeGroup(gpu::Context& context, const ContactGroup& group,
                                                  const ContactState& state, const std::string& shaderRoot,
                                                  gpu::ProgramCache* cache) const {
    const GroupPlan& plan = plan_->groups[group.group];
    std::vector<std::string> common = state.defines(group.group);
    common.insert(common.end(), {"TEXTURES", concat("ROW_BITS ", rowBits_),
                                 concat("VERTICES ", plan.vertexCount), concat("SPHERES ", group.spheresOf)});
    const auto define = [&](bool need, const char* name) {
        if (need) common.emplace_back(name);
    };
    define(plan.needs.pins, "PINS");
    define(plan.needs.release, "RELEASE");
    define(group.triangles, "TRIANGLES");
    define(walls_, "WALL_RECORDS");
    define(walls_ && plan.needs.collide, "WALLS");
    const auto make = [&](const char* file) {
        gpu::ProgramOptions options;
        options.vertex = "passes/fullscreen.vert";
        options.fragment = concat("contact/", file, ".frag");
        options.defines = common;
        options.label = concat("contact ", file, " of ", plan.name);
        options.cache = cache;
        options.generated = {{"generated/colliders.glsl", plan_->collideSource}};
        return Program(context, shaderRoot, options);
    };
    OfGroup out;
    out.spheres = make("spheres");
    if (state.fused())
        out.shapes =
            table(context, Format::rgba32f, group.shapes.size(), group.shapes.data(), "contact shapes");
    if (!triangles_) return out;
    out.effectiveSum = make("effective_sum");
    out.spread = make("spread");
    return out;
}

void TextureContact::draw(const Into& into, int firstRow, int rows) {
    const gpu::Framebuffer& target = targets_.into(into);
    target.bind(0, firstRow, target.width(), rows);
    noAttributes_.bind();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void TextureContact::drawAll(const Into& into) {
    draw(into, 0, rowsOf(contact_->spheres));
}

const Program& TextureContact::useGroup(const Program& program, size_t group) const {
    const ContactGroup& contact = contact_->groups[group];
    program.use();
    program.set("firstSphere", contact.firstSphere);
    program.set("partSpheres", plan_->groups[contact.group].count * contact.spheresOf);
    return program;
}

void TextureContact::setWalls(const Program& program, const ContactGroup& group, const Frame& frame) const {
    const std::vector<glm::vec4> parameters = colliderParameters(*plan_, plan_->groups[group.group], frame);
    program.set("colliderParameters", std::span<const glm::vec4>(parameters));
    program.set("wallTime", float(frame.parameters.frameTime));
    program.set("wallStep", float(frame.parameters.frameTime));
    program.set("wallNudge", float(0.05 * group.radius));
    if (tables_->samples && program.uses("samples")) program.texture("samples", 3, tables_->samples);
}

void TextureContact::makeSpheres(const Frame& frame, ContactState& state) {
    std::vector<const Texture*> into = {&spherePlaces_, &sphereMotions_, &sphereCells_};
    if (walls_) into.push_back(&sphereWalls_);
    for (size_t g = 0; g < groups_.size(); ++g) {
        const ContactGroup& group = contact_->groups[g];
        const GroupPlan& plan = plan_->groups[group.group];
        const int spheres = plan.count * group.spheresOf;
        const Program& program = useGroup(groups_[g].spheres, g);
        state.bind(program, group.group);
        if (state.fused()) {
            program.texture("shapes", 4, groups_[g].shapes);
            if (walls_ && plan.needs.collide) setWalls(program, group, frame);
        } else {
            program.texture("topology", 4, tables_->topology);
            program.set("topologyBase", plan.topologyBase);
            program.set("vertexCount", plan.vertexCount);
        }
        program.set("label", int(uint32_t(g) << 26));
        program.set("cell", float(contact_->cell));
        program.set("givenRadius", float(group.radius));
        const int first = group.firstSphere >> rowBits_;
        draw(into, first, rowsOf(group.firstSphere + spheres) - first);
    }
}

void TextureContact::sortKeys(NetworkSort& sort, bool staggered) {
    keys_.use();
    keys_.texture("sphereCells", 0, sphereCells_);
    keys_.texture("spherePlaces", 1, spherePlaces_);
    keys_.set("count", contact_->spheres);
    keys_.set("keyMask", keyMask());
    keys_.set("cell", float(contact_->cell));
    keys_.set("staggered", int(staggered));
    sort.drawInto(sort.target());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    sort.flip();
    sort.sort();
}

void TextureContact::buildGrid(const Frame& frame, ContactState& state) {
    makeSpheres(frame, state);
    sortKeys(sort_, false);
    if (staggered_) sortKeys(*staggered_, true);
    starts_.use();
    starts_.texture("sorted", 0, sort_.pairs());
    starts_.set("count", contact_->spheres);
    draw({&startsOf_}, 0, startsOf_.height());
    order_.use();
    order_.texture("sorted", 0, sort_.pairs());
    order_.texture("spherePlaces", 1, spherePlaces_);
    order_.texture("sphereMotions", 2, sphereMotions_);
    order_.texture("sphereCells", 3, sphereCells_);
    order_.set("count", contact_->spheres);
    if (walls_) {
        order_.texture("sphereWalls", 4, sphereWalls_);
        drawAll({&places_, &motions_, &cells_, &nearWalls_});
    } else {
        drawAll({&places_, &motions_, &cells_});
    }
    slots_.use();
    slots_.texture("sorted", 0, sort_.pairs());
    slots_.texture("sphereCells", 1, sphereCells_);
    slots_.texture("starts", 2, startsOf_);
    slots_.set("count", contact_->spheres);
    slots_.set("keyMask", keyMask());
    drawAll({&slotsOf_});
}

void TextureContact::search(ContactState&) {
    find_.use();
    find_.texture("places", 0, places_);
    find_.texture("cells", 1, cells_);
    find_.texture("oldCounts", 2, counts_[countsSide_]);
    if (contact_->settings.search == ContactSearch::exact) {
        find_.texture("starts", 3, startsOf_);
        find_.set("reach", float(2 * contact_->largestRadius * (1 + 1e-6)));
    }
    if (staggered_) {
        find_.texture("sorted", 3, sort_.pairs());
        find_.texture("staggered", 4, staggered_->pairs());
        find_.texture("slots", 5, slotsOf_);
    }
    if (self_) {
        find_.texture("sorted", 6, sort_.pairs());
        find_.texture("apart", 7, apart_);
        find_.texture("groupsOf", 8, groupsOf_);
    }
    find_.set("count", contact_->spheres);
    find_.set("keyMask", keyMask());
    find_.set("cell", float(contact_->cell));
    countsSide_ = 1 - countsSide_;
    drawAll({&counts_[countsSide_], &lists_});
}

// Binds what all stages of the response read; returns the next free texture unit.
int TextureContact::bindResponse(const Program& program, const Times& times) const {
    program.use();
    program.texture("places", 0, places_);
    program.texture("motions", 1, motions_);
    program.texture("cells", 2, cells_);
    program.texture("counts", 3, counts_[countsSide_]);
    program.texture("lists", 4, lists_);
    program.texture("materials", 5, materials_);
    setResponse(program, times);
    return 6;
}

void TextureContact::prepare(ContactState&, const Times&) {}
void TextureContact::relax(ContactState&, const Times&, float) {}
void TextureContact::settle(ContactState&, const Times&) {}
void TextureContact::apply(ContactState&, const Times&) {}
void TextureContact::runNearest(ContactState&, const Times&) {}

static std::vector<uint32_t> readBack(const Texture& texture, Traffic::Kind kind, int layer = 0) {
    std::vector<uint32_t> out(size_t(texture.width()) * size_t(texture.height()) *
                              texelBytes(texture.format()) / sizeof(uint32_t));
    texture.download(kind, 0, 0, texture.width(), texture.height(), out.data(), out.size() * sizeof(uint32_t),
                     layer);
    return out;
}

uint32_t TextureContact::dropped() const {
    const std::vector<uint32_t> counts = readBack(counts_[countsSide_], Traffic::Kind::control);
    uint32_t out = 0;
    for (size_t slot = 0; slot < size_t(contact_->spheres); ++slot)
        out += counts[2 * slot + 1];
    return out;
}

std::vector<std::pair<int, int>> TextureContact::found() const {
    const std::vector<uint32_t> counts = readBack(counts_[countsSide_], Traffic::Kind::state);
    const std::vector<KeyIndex> sorted = sort_.download();
    std::vector<std::pair<int, int>> out;
    for (int layer = 0; layer < layers; ++layer) {
        const std::vector<uint32_t> entries = readBack(lists_, Traffic::Kind::state, layer);
        for (size_t slot = 0; slot < sorted.size(); ++slot) {
            const size_t listed = std::min(counts[2 * slot], uint32_t(longestList));
            for (size_t e = 4 * size_t(layer); e < std::min(listed, 4 * size_t(layer) + 4); ++e) {
                const size_t other = entries[4 * slot + e % 4];
                out.emplace_back(std::minmax(int(sorted[slot].index), int(sorted[other].index)));
            }
        }
    }
    return once(std::move(out));
}

size_t TextureContact::bytes() const {
    size_t out = 2 * sort_.pairs().bytes() * (staggered_ ? 2 : 1);
    for (const Texture* texture :
         {&spherePlaces_, &sphereMotions_, &sphereCells_,  &places_,          &motions_,     &cells_,
          &startsOf_,     &slotsOf_,       &lists_,        &effectiveCounts_, &shifts_,      &materials_,
          &sphereWalls_,  &nearWalls_,     &wallFriction_, &diagonals_,       &besides_,     &velocities_,
          &apart_,        &groupsOf_,      &counts_[0],    &counts_[1],       &impulses_[0], &impulses_[1],
          &impulses_[2],  &pushes_[0],     &pushes_[1],    &pushes_[2]})
        out += *texture ? texture->bytes() : 0;
    return out;
}

}  // namespace shoal
