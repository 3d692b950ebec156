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
            cache),
      targets_(context),
      noAttributes_(context, "contact") {
    if (contact_->settings.search == ContactSearch::staggered)
        staggered_.emplace(context, shaderRoot, NetworkSort::Kind::bitonic, size_t(contact_->spheres),
                           2 << rowBits_, cache);
    makeTextures(context);
    makePrograms(context, shaderRoot, cache);
    for (const ContactGroup& group : contact_->groups)
        spheres_.push_back(
            makeGroup(context, plan_->groups[group.group], state.defines(group.group), shaderRoot, cache));
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
    const int materialRows = rowsOf(int(contact_->pairs.size()));
    std::vector<glm::vec4> materials(size_t(width) * size_t(materialRows));
    for (size_t i = 0; i < contact_->pairs.size(); ++i)
        materials[i] = glm::vec4(contact_->pairs[i], 0, 0);
    materials_ = Texture(context, Format::rgba32f, width, materialRows, "contact materials");
    materials_.upload(Traffic::Kind::parameters, 0, 0, width, materialRows, materials.data(),
                      materials.size() * sizeof(glm::vec4));
}

void TextureContact::makePrograms(gpu::Context& context, const std::string& shaderRoot,
                                  gpu::ProgramCache* cache) {
    gpu::ProgramOptions options;
    options.vertex = "passes/fullscreen.vert";
    options.defines = {"TEXTURES", concat("ROW_BITS ", rowBits_), concat("LIST ", longestList),
                       concat("NEIGHBORS ", contact_->settings.neighbors)};
    if (staggered_) options.defines.emplace_back("STAGGERED");
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
    makeStages(options, make);
}

Program TextureContact::makeGroup(gpu::Context& context, const GroupPlan& group,
                                  std::vector<std::string> defines, const std::string& shaderRoot,
                                  gpu::ProgramCache* cache) const {
    gpu::ProgramOptions options;
    options.vertex = "passes/fullscreen.vert";
    options.fragment = "contact/spheres.frag";
    options.defines = std::move(defines);
    options.defines.insert(options.defines.end(), {"TEXTURES", concat("ROW_BITS ", rowBits_)});
    if (group.needs.pins) options.defines.emplace_back("PINS");
    if (group.needs.release) options.defines.emplace_back("RELEASE");
    options.label = concat("contact spheres of ", group.name);
    options.cache = cache;
    return {context, shaderRoot, options};
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

void TextureContact::makeSpheres(ContactState& state) {
    for (size_t g = 0; g < spheres_.size(); ++g) {
        const ContactGroup& group = contact_->groups[g];
        const GroupPlan& plan = plan_->groups[group.group];
        const int spheres = plan.count * group.spheresOf;
        const Program& program = spheres_[g];
        program.use();
        state.bind(program, group.group);
        program.texture("topology", 4, tables_->topology);
        program.set("topologyBase", plan.topologyBase);
        program.set("vertexCount", plan.vertexCount);
        program.set("firstSphere", group.firstSphere);
        program.set("groupSpheres", spheres);
        program.set("label", int(uint32_t(g) << 26));
        program.set("cell", float(contact_->cell));
        program.set("radius", float(group.radius));
        const int first = group.firstSphere >> rowBits_;
        draw({&spherePlaces_, &sphereMotions_, &sphereCells_}, first,
             rowsOf(group.firstSphere + spheres) - first);
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

void TextureContact::buildGrid(const Frame&, ContactState& state) {
    makeSpheres(state);
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
    drawAll({&places_, &motions_, &cells_});
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

void TextureContact::runStage(ContactState&, const Program& program, const Times& times,
                              const Totals& totals) {
    const int unit = bindResponse(program, times);
    // without momentum the earlier ones do not count, and nobody may have written them yet
    const size_t earlier = totals.momentum == 0 ? totals.last : totals.earlier;
    program.texture("effectiveCounts", unit, effectiveCounts_);
    program.texture("impulses", unit + 1, impulses_[totals.last]);
    program.texture("earlier", unit + 2, impulses_[earlier]);
    program.texture("pushed", unit + 3, pushes_[totals.pushes.value_or(totals.last)]);
    program.texture("pushedBefore", unit + 4, pushes_[earlier]);
    program.set("momentum", totals.momentum);
    program.set("frictionShare", 1.0f / ContactPlan::frictionRounds);
    const Texture* impulses = &impulses_[totals.next];
    if (&program == &correction_) {
        program.texture("kept", unit + 5, shifts_);
        drawAll({impulses});
    } else if (&program == &friction_) {
        drawAll({impulses, &shifts_});
    } else {
        drawAll({impulses, &pushes_[totals.next]});
    }
}

void TextureContact::apply(ContactState& state, size_t impulses) {
    for (const ContactGroup& group : contact_->groups)
        state.apply(group.group, [&](const Program& program, int firstUnit) {
            program.set("firstSphere", group.firstSphere);
            program.texture("slots", firstUnit, slotsOf_);
            program.texture("counts", firstUnit + 1, counts_[countsSide_]);
            program.texture("impulses", firstUnit + 2, impulses_[impulses]);
            program.texture("shifts", firstUnit + 3, shifts_);
        });
}

void TextureContact::runNearest(ContactState&, const Times& times, const Totals& totals) {
    bindResponse(nearest_, times);
    drawAll({&impulses_[totals.next], &shifts_});
}

void TextureContact::runEffective(ContactState&, const Times& times) {
    bindResponse(effective_, times);
    drawAll({&effectiveCounts_});
}

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
         {&spherePlaces_, &sphereMotions_, &sphereCells_, &places_,    &motions_,
          &cells_,        &startsOf_,      &slotsOf_,     &lists_,     &effectiveCounts_,
          &shifts_,       &materials_,     &counts_[0],   &counts_[1], &impulses_[0],
          &impulses_[1],  &impulses_[2],   &pushes_[0],   &pushes_[1], &pushes_[2]})
        out += *texture ? texture->bytes() : 0;
    return out;
}

}  // namespace shoal
