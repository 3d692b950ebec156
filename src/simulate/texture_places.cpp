#include "simulate/texture_places.h"

#include <algorithm>

#include "gpu/gl.h"

namespace shoal {

using gpu::Format;
using gpu::Framebuffer;
using gpu::Program;
using gpu::Texture;
using gpu::Traffic;

namespace {

constexpr int siblings = 32;  // and places of a word
constexpr int controlTexels = control::words / 4;

int partsOf(int whole, int size) {
    return (whole + size - 1) / size;
}

// Rows of the bits of so many places.
int rowsOf(int places) {
    return partsOf(partsOf(places, siblings), siblings);
}

}  // namespace

TexturePlaces::TexturePlaces(gpu::Context& context, const Plan& plan) : context_(&context) {
    int rows = rowsOf(mostPlaces(plan));
    bits_ = Texture(context, Format::rg32ui, siblings, rows, "bits of places");
    newBits_ = Framebuffer(context, {&bits_}, nullptr, "bits of places");
    for (;; rows = partsOf(rows, siblings)) {
        Level& level = levels_.emplace_back();
        level.sums = Texture(context, Format::rgba32ui, siblings, rows, "sums of places");
        level.framebuffer = Framebuffer(context, {&level.sums}, nullptr, "sums of places");
        if (rows == 1) break;
    }
    for (Texture& side : control_)
        side =
            Texture(context, Format::rgba32ui, controlTexels, int(plan.groups.size()), "control of births");
    for (size_t now = 0; now < 2; ++now)
        newControl_[now] = Framebuffer(context, {&control_[1 - now]}, nullptr, "control of births");
    const std::vector<uint32_t> none(control::words);
    for (size_t g = 0; g < plan.groups.size(); ++g)
        writeControl(g, none);
    makePrograms(plan);
}

void TexturePlaces::makePrograms(const Plan& plan) {
    const auto options = [&](const char* file, const char* label) {
        gpu::ProgramOptions out;
        out.vertex = "passes/fullscreen.vert";
        out.fragment = concat("births/", file, ".frag");
        out.label = label;
        return out;
    };
    const auto make = [&](const char* file, const char* label, const std::vector<std::string>& defines) {
        gpu::ProgramOptions program = options(file, label);
        program.defines = {concat("LEVELS ", levels_.size()), concat("STATE_WIDTH ", stateWidth)};
        program.defines.insert(program.defines.end(), defines.begin(), defines.end());
        return Program(*context_, program);
    };
    sumWords_ = make("sums", "sums of words", {"WORDS"});
    sumLevel_ = make("sums", "sums of places", {});
    deaths_ = make("control", "deaths", {"DEATHS"});
    cuts_ = make("control", "lives cut short", {"CUTS"});
    births_ = make("control", "births", {});
    listDeaths_ = make("list", "list of deaths", {"DEATHS"});
    listPlaces_ = make("list", "list of places", {});
    for (const GroupPlan& group : plan.groups) {
        findBits_.push_back(nullptr);
        if (!group.life) continue;
        gpu::ProgramOptions bits = options("bits", "bits of places");
        bits.defines = group.layout().defines(true);
        if (group.life->feeds) bits.defines.emplace_back("DEATHS");
        findBits_.back() = &made_.get(*context_, bits);
    }
}

void TexturePlaces::sum(size_t group, const GroupLayers& state, int first, int count) {
    group_ = group;
    count_ = count;
    const Program& bits = *findBits_[group];
    bits.use();
    bits.texture("states", state.state());
    bits.texture("statesBefore", state.stateBefore());
    bits.set("firstPlace", first);
    bits.set("items", count);
    bits.set("placeCount", state.count());
    int rows = rowsOf(count);
    newBits_.bind(0, 0, siblings, rows);
    gpu::drawVertices(3);
    const Texture* below = &bits_;
    for (const Level& level : levels_) {
        const Program& sums = below == &bits_ ? sumWords_ : sumLevel_;
        sums.use();
        sums.texture("below", *below);
        sums.set("belowRows", rows);
        if (below != &bits_) rows = partsOf(rows, siblings);
        level.framebuffer.bind(0, 0, siblings, rows);
        gpu::drawVertices(3);
        below = &level.sums;
    }
}

void TexturePlaces::bindTree(const Program& program) const {
    program.texture("control", control());
    program.set("controlBase", int(control::of(group_)));
    program.texture("bits", bits_);
    for (size_t i = 0; i < levels_.size(); ++i)
        program.texture(concat("sums", i + 1).c_str(), levels_[i].sums);
}

void TexturePlaces::put(const Program& program, int scheduled, std::span<const glm::ivec4> deaths,
                        bool allocates) {
    program.use();
    bindTree(program);
    program.set("items", count_);
    program.set("scheduled", scheduled);
    program.set("allocates", int(allocates));
    program.set("deathRunCount", int(deaths.size()));
    program.set("deathRuns", deaths);
    newControl_[now_].bind();
    gpu::drawVertices(3);
    now_ = 1 - now_;
}

void TexturePlaces::draw(const Program& list, const Framebuffer& target, int firstRow, int rows) const {
    list.use();
    bindTree(list);
    list.set("firstRow", firstRow);
    target.bind(0, firstRow, target.width(), rows);
    gpu::drawVertices(3);
}

void TexturePlaces::readControl(size_t group, uint32_t* words) const {
    control_[now_].download(Traffic::Kind::control, 0, int(group), controlTexels, 1, words,
                            control::words * sizeof(uint32_t));
}

void TexturePlaces::writeControl(size_t group, const std::vector<uint32_t>& words) {
    control_[now_].upload(Traffic::Kind::state, 0, int(group), controlTexels, 1, words.data(),
                          words.size() * sizeof(uint32_t));
}

}  // namespace shoal
