// Pictures under water, and of metallic molecules: invariants, no goldens.
#include "gl/render_scene.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Light grey, without caustics or beams unless a test asks for them.
Scene squaresUnderWater(double surface, const std::vector<glm::dvec3>& places = {{0, 0, 0}}) {
    Scene scene = sceneOfSquares(places, 1);
    scene.groups[0].molecule.material.color = {0.7, 0.7, 0.7};
    scene.light.direction = {0, -1, -1};
    scene.light.shadows = false;
    scene.water = Water{.surface = surface, .caustics = 0, .rays = 0};
    return scene;
}

glm::ivec3 middleOf(const Scene& scene) {
    return pixel(show(scene).image, 80, 60);
}

// Sand seen from above, or what a camera sees that looks from 4 m below the surface along a direction.
Scene sand(double depth) {
    Scene scene = squaresUnderWater(0, {{0, 50, 0}});
    scene.colliders.push_back(
        {.name = "sand", .shape = PlaneCollider{.point = {0, -depth, 0}}, .color = {0.4, 0.4, 0.4}});
    scene.camera.eye = {0, 6, 1};
    scene.camera.target = {0, -depth, 0};
    scene.light.direction = {0.2, -1, 0};
    return scene;
}

Scene upwards(const glm::dvec3& direction) {
    Scene scene = squaresUnderWater(0, {{0, 50, 0}});
    scene.water->extinction = glm::dvec3(0.01);
    scene.camera.eye = {0, -4, 0};
    scene.camera.target = scene.camera.eye + direction;
    scene.camera.fieldOfView = 0.2;
    return scene;
}

struct Tones {
    double mean = 0, spread = 0;  // of brightness
};

Tones tonesOf(const Image& image) {
    Tones out;
    double squares = 0;
    const int count = image.width * image.height;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double b = brightness(pixel(image, x, y));
            out.mean += b / count;
            squares += b * b / count;
        }
    out.spread = std::sqrt(std::max(squares - out.mean * out.mean, 0.0));
    return out;
}

}  // namespace

TEST_CASE("what lies deeper is darker and bluer", "[render][water]") {
    glm::ivec3 before = middleOf(squaresUnderWater(1));
    for (const double surface : {2.0, 3.0, 5.0, 8.0}) {
        const glm::ivec3 now = middleOf(squaresUnderWater(surface));
        CHECK(brightness(now) < brightness(before) - 5);
        CHECK(now.x * before.z < before.x * now.z);  // less red beside the blue
        before = now;
    }
}

TEST_CASE("what is further away fades into the water's colour", "[render][water]") {
    const auto at = [](double distance) {
        Scene scene = squaresUnderWater(2, {{0, 0, 3 - distance}});
        scene.groups[0].place.items[0].scale = distance;
        return middleOf(scene);
    };
    Scene empty = squaresUnderWater(2, {{0, 50, 0}});
    const glm::ivec3 water = middleOf(empty);
    int before = difference(at(1), water);
    for (const double distance : {4.0, 12.0, 36.0}) {
        const int now = difference(at(distance), water);
        CHECK(now < before);
        before = now;
    }
    CHECK(difference(at(300), water) <= 2);
}

TEST_CASE("above the surface all is as in the air", "[render][water]") {
    Scene scene = sand(0);  // the plane at the height of the surface, seen from above it
    scene.water->surface = -1000;
    scene.water->caustics = 1;
    Scene dry = scene;
    dry.water.reset();
    scene.sky.fog = dry.sky.fog = 0.05;
    CHECK(changed(show(scene).image, show(dry).image, 1).count == 0);
}

TEST_CASE("caustics are a net of light that moves and keeps its mean", "[render][water]") {
    Scene scene = sand(4);
    const Tones calm = tonesOf(show(scene).image);
    scene.water->caustics = 1;
    const RenderOptions small{.width = 160, .height = 120};
    const Image first = show(scene, 1, small, 0).image, later = show(scene, 1, small, 0.5).image;
    const Tones net = tonesOf(first);
    CHECK(net.spread > calm.spread + 15);
    CHECK(net.mean == Approx(calm.mean).epsilon(0.12));
    CHECK(changed(first, later, 12).count > 160 * 120 / 10);
    CHECK(changed(first, show(scene, 1, small, 0).image, 0).count == 0);

    scene.water->causticsSpeed = 0;
    CHECK(changed(first, show(scene, 1, small, 0).image, 0).count == 0);
    CHECK(changed(show(scene, 1, small, 0.5).image, first, 0).count == 0);
}

TEST_CASE("from below the sky is seen through a round window, and beside it the water mirrored",
          "[render][water]") {
    const auto at = [](double degrees) {
        const double angle = degrees / 57.29577951308232;
        return tonesOf(show(upwards({std::sin(angle), std::cos(angle), 0})).image).mean;
    };
    const double above = at(15), beside = at(65);  // Snell's angle is 48.6 degrees
    CHECK(above > beside * 1.5);
    CHECK(at(30) > beside * 1.5);
}

TEST_CASE("beams lighten and darken the water", "[render][water]") {
    Scene scene = upwards({1, 0.15, 0});
    scene.camera.fieldOfView = 1;
    scene.water->extinction = {0.3, 0.08, 0.06};
    const Image calm = show(scene).image;
    scene.water->rays = 1;
    const Image beams = show(scene).image;
    CHECK(changed(calm, beams, 4).count > 160 * 120 / 10);
    CHECK(tonesOf(beams).mean == Approx(tonesOf(calm).mean).epsilon(0.2));
    scene.water->rays = 0;
    CHECK(changed(calm, show(scene).image, 0).count == 0);
}

TEST_CASE("a metallic molecule flashes where it turns the sun into the eye", "[render][metallic]") {
    const auto turned = [](double metallic, double angle) {
        Scene scene = sceneOfSquares({{0, 0, 0}}, 1);
        scene.groups[0].molecule.material.color = {0.7, 0.7, 0.7};
        scene.groups[0].molecule.material.roughness = 0.25;
        scene.groups[0].molecule.material.metallic = metallic;
        scene.light.intensity = 0.6;
        scene.light.direction = {0, -0.5, -0.8660254};  // 30 degrees above the eye: a mirror at 15 shows it
        scene.light.shadows = false;
        scene.groups[0].place.items[0].rotation = glm::angleAxis(-angle, glm::dvec3(1, 0, 0));
        return brightness(pixel(show(scene).image, 80, 60));
    };
    const double facing = 0.2617993877991494;
    CHECK(turned(1, facing) > turned(1, facing + 0.5) + 150);
    CHECK(turned(1, facing) > turned(1, facing - 0.5) + 150);
    CHECK(turned(1, facing) - turned(1, facing + 0.5) > turned(0, facing) - turned(0, facing + 0.5) + 100);
    CHECK(turned(1, facing) > turned(0, facing) + 50);
}
