// Molecules that appear and vanish: how much of the picture they cover at an age.
#include "gl/births.h"
#include "gl/render_scene.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Pixels that the red square covers after so many frames.
int covered(const Scene& scene, int frames) {
    const Image image = show(scene, frames).image;
    int out = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const glm::ivec3 p = pixel(image, x, y);
            out += p.r > p.g + 30;
        }
    }
    return out;
}

}  // namespace

TEST_CASE("a molecule grows at birth, shrinks before its end, and is gone after it", "[births][picture]") {
    if (!canSpawn()) return;
    Scene scene = sceneOfSquares({}, 1.2);
    Group& group = scene.groups[0];
    group.count = 0;
    Lifecycle& life = group.life.emplace();
    life.capacity = 3;
    life.life = {1, 1};
    life.turn = Placement::Turn::none;
    life.grow = 0.2;
    life.shrink = 0.4;
    life.emitters.push_back(burst(1));
    CHECK(covered(scene, 0) == 0);
    const double whole = covered(scene, 30);
    REQUIRE(whole > 1000);
    // half the side is a quarter of the area; rims are a pixel wide
    CHECK(std::abs(covered(scene, 6) / whole - 0.25) < 0.03);
    CHECK(std::abs(covered(scene, 13) / whole - 1) < 0.01);
    CHECK(std::abs(covered(scene, 48) / whole - 0.25) < 0.03);
    CHECK(covered(scene, 61) == 0);
}

TEST_CASE("those at the start are grown", "[births][picture]") {
    if (!canSpawn()) return;
    Scene scene = sceneOfSquares({{0, 0, 0}}, 1.2);
    const int plain = covered(scene, 1);
    REQUIRE(plain > 1000);
    Lifecycle& life = scene.groups[0].life.emplace();
    life.capacity = 1;
    life.life = {1, 1};
    life.grow = 0.5;
    CHECK(covered(scene, 1) == plain);
    CHECK(covered(scene, 59) == plain);
    CHECK(covered(scene, 61) == 0);
}
