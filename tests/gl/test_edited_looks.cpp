// Looks that change while a renderer goes on: the same picture as one made for them.
#include "core/random.h"
#include "gl/births.h"
#include "gl/render_scene.h"
#include "scene/edit_limits.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

class Slider {
  public:
    double in(const Limit& limit) {
        const double dice = random_.uniform();
        if (dice < 0.15) return limit.least;
        if (dice < 0.3) return limit.most;
        return random_.uniform(limit.least, limit.most);
    }
    glm::dvec2 span(const Limit& limit) { return {in(limit), chance() ? in(limit) : in(limit)}; }
    bool chance() { return random_.uniform() < 0.5; }
    int whole(int count) { return int(random_.uniform() * count); }

  private:
    Random random_{19};
};

// Everything but what needs another renderer.
ParticleType moved(const ParticleType& from, Slider& slider) {
    const LooksLimits limits = limitsOf(from);
    ParticleType out = from;
    out.size = slider.span(limits.size);
    out.growth = slider.span(limits.growth);
    out.turn = slider.span(limits.turn);
    out.spin = slider.span(limits.spin);
    out.facing = ParticleFacing(slider.whole(3));
    out.stretch = slider.in(limits.stretch);
    out.pixels = slider.in(limits.pixels);
    out.lit = slider.chance();
    out.colors.resize(1);
    for (int i = slider.whole(4); i > 0; --i)
        addColorKey(out.colors);
    for (size_t k = 0; k < out.colors.size(); ++k) {
        out.colors[k].age = ageBetween(out.colors, k, slider.in({0, 1}));
        out.colors[k].color = {slider.in({0, 2}), slider.in({0, 2}), slider.in({0, 2})};
        out.colors[k].opacity = slider.in({0, 1});
    }
    settle(out);
    return out;
}

Scene cloud(const ParticleType& type) {
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 40; ++i)
        places.emplace_back(0.1 * (i % 8) - 0.4, 0.1 * (i / 8) - 0.2, 0.05 * (i % 3));
    Scene scene = sceneOfSquares(places);
    Group& group = scene.groups[0];
    group.particle = type;
    group.molecule = moleculeOf(type);
    group.velocity = {0.5, 0.2, 0};
    if (!canBear()) return scene;
    group.life.emplace();
    group.life->capacity = group.count;
    group.life->life = {0.5, 1};
    return scene;
}

class Drawn {
  public:
    explicit Drawn(const Scene& scene)
        : simulation_(testContext(), shaderRoot(), compile(scene), {.path = testPath()}),
          renderer(testContext(), shaderRoot(), scene, simulation_.plan(), {.width = 96, .height = 72}),
          view_(View::of(scene.camera)) {
        run(simulation_, 6);
    }

    Image image(Renderer& by) {
        view_.time = simulation_.time();
        by.draw(simulation_.state(), view_);
        return by.capture();
    }
    Renderer rendererOf(const Scene& scene) {
        return Renderer(testContext(), shaderRoot(), scene, simulation_.plan(), {.width = 96, .height = 72});
    }

  private:
    Simulation simulation_;

  public:
    Renderer renderer;

  private:
    View view_;
};

}  // namespace

TEST_CASE("looks that change show as if they had always been so, and back", "[render][editedLooks]") {
    Slider slider;
    for (const ParticleShape shape : {ParticleShape::quads, ParticleShape::sprites, ParticleShape::points}) {
        ParticleType type;
        type.shape = shape;
        type.size = {0.05, 0.1};
        type.softness = shape == ParticleShape::quads ? 0.1 : 0;
        type.blend = shape == ParticleShape::points ? Blend::none : Blend::alpha;
        const Scene scene = cloud(type);
        Drawn drawn(scene);
        const Image before = drawn.image(drawn.renderer);
        int live = 0;
        for (int round = 0; round < 8; ++round) {
            const ParticleType next = moved(type, slider);
            if (!drawn.renderer.changeParticle(0, next)) continue;  // a sprite beyond the context's limit
            ++live;
            Renderer fresh = drawn.rendererOf(cloud(next));
            INFO("shape " << name(shape) << ", round " << round);
            CHECK(drawn.image(drawn.renderer).pixels == drawn.image(fresh).pixels);
        }
        CHECK(live >= 4);
        REQUIRE(drawn.renderer.changeParticle(0, type));
        CHECK(drawn.image(drawn.renderer).pixels == before.pixels);
    }
}

TEST_CASE("looks that need another renderer are refused and change nothing", "[render][editedLooks]") {
    ParticleType type;
    type.size = {0.05, 0.1};
    Drawn drawn(cloud(type));
    const Image before = drawn.image(drawn.renderer);
    const auto refused = [&](const auto& edit) {
        ParticleType other = type;
        other.colors[0].color = {1, 0, 0};
        edit(other);
        CHECK(!drawn.renderer.changeParticle(0, other));
        CHECK(drawn.image(drawn.renderer).pixels == before.pixels);
    };
    refused([](ParticleType& t) { t.shape = ParticleShape::points; });
    refused([](ParticleType& t) { t.blend = Blend::additive; });
    refused([](ParticleType& t) { t.sort = DrawSort::none; });
    refused([](ParticleType& t) { t.softness = 0.1; });
    refused([](ParticleType& t) { t.image.emplace().file = "any.png"; });
    ParticleType red = type;
    red.colors[0].color = {1, 0, 0};
    CHECK(drawn.renderer.changeParticle(0, red));
    CHECK(drawn.image(drawn.renderer).pixels != before.pixels);
}
