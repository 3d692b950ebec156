#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/shader_source.h"
#include "render/group_drawer.h"

namespace shoal {

namespace {

constexpr int batch = 64;  // particles an instance

bool turns(const ParticleType& type) {
    const bool any = type.turn != glm::dvec2(0) || type.spin != glm::dvec2(0);
    // A dot looks the same however it is turned about the line of sight.
    return any && (type.facing == ParticleFacing::free || type.image);
}

// Returns the type with all that has no effect on its shape left at the default. Sprites that the context
// cannot draw twice as large as they are where the camera looks become quads, which look the same.
ParticleType effective(ParticleType type, double pixelsPerMeter, float maxPointSize) {
    const ParticleType usual;
    const double largest = type.size.y * std::max(type.growth.x, type.growth.y) * std::numbers::sqrt2;
    if (type.shape == ParticleShape::sprites && 2 * largest * pixelsPerMeter > double(maxPointSize))
        type.shape = ParticleShape::quads;
    if (type.shape == ParticleShape::points) {
        type.image.reset();
        type.growth = usual.growth;
        type.turn = usual.turn;
        type.spin = usual.spin;
    }
    if (type.shape != ParticleShape::quads) type.facing = usual.facing;
    if (type.facing == ParticleFacing::velocity) {
        type.turn = usual.turn;
        type.spin = usual.spin;
    }
    return type;
}

bool sameTiles(const std::optional<ParticleImage>& a, const std::optional<ParticleImage>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return a->file == b->file && a->columns == b->columns && a->rows == b->rows &&
           a->firstTile == b->firstTile && a->lastTile == b->lastTile;
}

}  // namespace

ParticleDrawer::ParticleDrawer(gpu::Context& context, gpu::Programs& programs, const ParticleType& type,
                               const GroupPlan& plan, size_t index, const Lighting& lighting,
                               double pixelsPerMeter)
    : GroupDrawer(context, programs, plan, index),
      type_(effective(type, pixelsPerMeter, context.info().maxPointSize)),
      pixelsPerMeter_(pixelsPerMeter),
      ages_(plan.needs.life) {
    if (type_.image) image_ = loadImage(context, *type_.image);
    makeStream();
    chooseShaders(lighting);
}

bool ParticleDrawer::change(const ParticleType& type, const Lighting& lighting) {
    ParticleType wanted = effective(type, pixelsPerMeter_, context_->info().maxPointSize);
    const bool depth = wanted.softness > 0 && wanted.blend != Blend::none;
    if (wanted.shape != type_.shape || wanted.blend != type_.blend || wanted.sort != type_.sort ||
        wanted.spreadFrames != type_.spreadFrames || depth != readsDepth() ||
        !sameTiles(wanted.image, type_.image))
        return false;
    const std::vector<std::string> before = litOptions_.defines;
    type_ = std::move(wanted);
    chooseShaders(lighting);
    if (litOptions_.defines == before) return true;
    lit_ = Variants();  // made anew when they are drawn next
    depth_ = Variants();
    return true;
}

void ParticleDrawer::makeStream() {
    if (type_.shape != ParticleShape::quads) {
        streams_ = {{batch, false, batch}};
        return;
    }
    std::vector<uint32_t> indices;
    for (uint32_t quad = 0; quad < uint32_t(batch); ++quad)
        for (const uint32_t corner : {0U, 1U, 2U, 2U, 1U, 3U})
            indices.push_back(4 * quad + corner);
    indices_ = gpu::Buffer(*context_, gpu::Buffer::Use::index, std::span<const uint32_t>(indices),
                           "corners of particles");
    corners_.indices(indices_);
    streams_ = {{int(indices.size()), true, batch}};
}

std::vector<std::string> ParticleDrawer::defines() const {
    const bool quads = type_.shape == ParticleShape::quads;
    const bool several = type_.image && type_.image->firstTile != type_.image->lastTile;
    const bool flips = several && type_.image->flipBook, again = flips && type_.image->frameRate > 0;
    return {concat("BATCH ", batch),
            concat("CORNERS ", quads ? 4 : 1),
            concat("SHAPE ", name(type_.shape), "Shape"),
            concat("FACING ", name(type_.facing), "Facing"),
            concat("TILES ", !several ? "oneTile"
                             : !flips ? "tileOfSeed"
                             : again  ? "tilesAgain"
                                      : "tilesOnce"),
            gpu::constant("AGES", ages_),
            gpu::constant("SIZES", type_.size.x != type_.size.y),
            gpu::constant("GROWS", ages_ && type_.growth != glm::dvec2(1)),
            gpu::constant("TURNS", turns(type_)),
            gpu::constant("IMAGE", type_.image.has_value()),
            gpu::constant("FADES", flips && type_.image->blend)};
}

void ParticleDrawer::chooseShaders(const Lighting& lighting) {
    depthOptions_.vertex = "particles/particle.vert";
    depthOptions_.fragment = "particles/particle_shadow.frag";
    depthOptions_.defines = defines();
    litOptions_ = depthOptions_;
    litOptions_.fragment = "particles/particle.frag";
    depthOptions_.defines.push_back(blendDefine(Blend::none));
    depthOptions_.label = name_ + " (shadow)";

    std::vector<std::string>& lit = litOptions_.defines;
    for (const std::string& define : lighting.defines())
        lit.push_back(define);
    lit.push_back(blendDefine(type_.blend));
    lit.push_back(gpu::constant("LIT", type_.lit && type_.blend != Blend::multiplicative));
    lit.push_back(gpu::constant("SOFT", readsDepth()));
    litOptions_.label = name_ + " (picture)";
}

void ParticleDrawer::setColors(const gpu::Program& program) const {
    const ColorPieces pieces = colorPieces(type_.colors);
    program.set("firstColor", pieces.first);
    if (!ages_) return;
    program.set("colorChanges", std::span<const glm::vec4>(pieces.changes));
    program.set("colorBegins", pieces.begins);
    program.set("colorPerAge", pieces.perAge);
}

void ParticleDrawer::setType(const gpu::Program& program) const {
    setColors(program);
    if (type_.shape == ParticleShape::points)
        program.set("pixels", float(type_.pixels));
    else
        program.set("sizeSpan", glm::vec2(type_.size));
    if (ages_ && type_.growth != glm::dvec2(1)) program.set("growth", glm::vec2(type_.growth));
    if (turns(type_)) {
        program.set("turnSpan", glm::vec2(type_.turn));
        program.set("spinSpan", glm::vec2(type_.spin));
    }
    if (type_.facing == ParticleFacing::velocity) program.set("stretch", float(type_.stretch));
    if (!type_.image) return;
    program.texture("image", image_);
    program.set("tileCount", float(image_.layers()));
    program.set("frameRate", float(type_.image->frameRate));
}

void ParticleDrawer::setView(const gpu::Program& program, const glm::mat3& viewToScene,
                             const glm::vec4& eyeAt, const glm::vec2& pictureSize, float pixelsPerMeter,
                             double time) const {
    program.set("viewToScene", viewToScene);
    program.set("eyeAt", eyeAt);
    program.set("pictureSize", pictureSize);
    program.set("pixelsPerMeter", pixelsPerMeter);
    // The time in parts that a float holds, however long it has been.
    constexpr double block = 64;  // s
    const double blocks = std::floor(time / block);
    program.set("timeBlocks", uint32_t(int64_t(std::fmod(blocks, 4294967296.0))));
    program.set("time", float(time - blocks * block));
    if (type_.image && type_.image->frameRate > 0)
        program.set("flipTime", float(std::fmod(time, image_.layers() / type_.image->frameRate)));
}

const gpu::Program& ParticleDrawer::useDepth(const StateView& state, const ShadowMap& shadow, double time) {
    const gpu::Program& program = beginDepth(state, shadow);
    setView(program, shadow.toScene(), glm::vec4(shadow.toScene()[2], 0), glm::vec2(float(shadow.size())),
            shadow.pixelsPerMeter(), time);
    program.set("leastCover", 0.5f);
    setType(program);
    return program;
}

const gpu::Program& ParticleDrawer::useLit(const StateView& state, const DrawInputs& inputs) {
    const gpu::Program& program = beginLit(state, inputs);
    const Eye& eye = inputs.eye;
    setView(program, eye.viewToScene, glm::vec4(0, 0, 0, 1), eye.size, eye.pixelsPerMeter, eye.time);
    setType(program);
    if (type_.blend == Blend::none) program.set("leastCover", inputs.multisampled ? 0.02f : 0.5f);
    if (!readsDepth()) return program;
    program.texture("sceneDepth", *inputs.sceneDepth);
    program.set("nearest", eye.nearest);
    program.set("perSoftness", float(1 / type_.softness));
    return program;
}

}  // namespace shoal
