// Looks that change while a renderer goes on: the same picture as one made for them.
#include "gl/births.h"
#include "gl/render_scene.h"
#include "support/catch.h"
#include "support/moved.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Everything but what needs another renderer.
ParticleType moved(const ParticleType& from, Sliders& sliders) {
    ParticleType out = sliders.moved(from, {"mass", "softness", "spreadFrames"});
    out.facing = ParticleFacing(sliders.whole(3));
    out.colors.resize(1);
    for (int i = sliders.whole(4); i > 0; --i)
        addColorKey(out.colors);
    const Slider light{0, 2};
    for (size_t k = 0; k < out.colors.size(); ++k) {
        out.colors[k].age = ageBetween(out.colors, k, sliders.in({0, 1}));
        out.colors[k].color = {sliders.in(light), sliders.in(light), sliders.in(light)};
        out.colors[k].opacity = sliders.in({0, 1});
    }
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
    if (!canSpawn()) return scene;
    group.life.emplace();
    group.life->capacity = group.count;
    group.life->life = {0.5, 1};
    return scene;
}

class Drawn {
  public:
    explicit Drawn(const Scene& scene)
        : simulation_(testContext(), compile(scene), {.path = testPath()}),
          renderer(testContext(), scene, simulation_.plan(), {.width = 96, .height = 72}),
          view_(View::fromCamera(scene.camera)) {
        run(simulation_, 6);
    }

    Image image(Renderer& by) {
        view_.time = simulation_.time();
        by.draw(simulation_.state(), view_);
        return by.capture();
    }
    Renderer rendererOf(const Scene& scene) {
        return Renderer(testContext(), scene, simulation_.plan(), {.width = 96, .height = 72});
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
    Sliders sliders(19);
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
            const ParticleType next = moved(type, sliders);
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
