// Particles as they are drawn: each attribute of a type against its closed form, and sprites against quads.
#include <functional>
#include <random>

#include "core/image.h"
#include "gl/births.h"
#include "gl/blending.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr RenderOptions small = {.width = 160, .height = 120};

// Particles at the places given, seen from 3 m along +Z before an even, dark sky.
Scene sceneOfParticles(const ParticleType& type, const std::vector<glm::dvec3>& places = {glm::dvec3(0)}) {
    Scene scene = sceneOfSquares(places);
    Group& group = scene.groups[0];
    group.name = "particles";
    group.particle = type;
    group.molecule = moleculeOf(type);
    scene.light.shadows = false;
    scene.light.intensity = 0;
    scene.sky.occlusion = 0;
    scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::dvec3(0.05);
    return scene;
}

// Opaque, 0.8 m across: the middle of the picture shows its colour and nothing else.
ParticleType disc() {
    ParticleType type;
    type.size = {0.8, 0.8};
    type.blend = Blend::none;
    return type;
}

void setLife(Scene& scene, double seconds) {
    for (Group& group : scene.groups) {
        group.life = Lifecycle();
        group.life->capacity = group.count;
        group.life->life = glm::dvec2(seconds);
    }
}

glm::ivec3 middleOf(const Image& image) {
    return pixel(image, image.width / 2, image.height / 2);
}

Image draw(const Scene& scene, int frames = 0) {
    return show(scene, frames, small).image;
}

// Checks that the picture shows a radiance, to its 8 bits and its dither.
void checkShows(const Image& image, const glm::dvec3& radiance) {
    INFO("found " << middleOf(image).x << " " << middleOf(image).y << " " << middleOf(image).z
                  << ", expected " << shownOf(radiance).x << " " << shownOf(radiance).y << " "
                  << shownOf(radiance).z);
    CHECK(farthest(middleOf(image), shownOf(radiance)) <= 2);
}

// Writes tiles of plain colours, columns x rows, each `side` pixels wide; returns the file.
std::string writeTiles(const Scratch& scratch, int columns, int rows, int side,
                       const std::function<glm::ivec4(int tile, int x, int y)>& colorOf) {
    Image image{columns * side, rows * side, 4, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const glm::ivec4 color = colorOf(y / side * columns + x / side, x % side, y % side);
            for (int c = 0; c < 4; ++c)
                image.pixels.push_back(uint8_t(color[c]));
        }
    const std::string file = scratch.path("tiles.png");
    writePng(file, image);
    return file;
}

const std::vector<glm::ivec4> plainColors = {{255, 0, 0, 255},   {0, 255, 0, 255},   {0, 0, 255, 255},
                                             {255, 255, 0, 255}, {0, 255, 255, 255}, {255, 0, 255, 255}};

glm::dvec3 light(const glm::ivec4& color) {
    return glm::dvec3(glm::greaterThan(glm::ivec3(color), glm::ivec3(0)));
}

// The particles' places are moved out of the picture.
Image emptied(Scene scene, int frames = 0) {
    for (Group& group : scene.groups)
        for (Placement::Item& item : group.place.items)
            item.position.z += 1000;
    return draw(scene, frames);
}

double pixelsPerMeter(const Scene& scene) {
    return small.height / (2 * std::tan(scene.camera.fieldOfView / 2)) / 3;
}

}  // namespace

TEST_CASE("colour and opacity follow the keyframes", "[render][particles]") {
    if (!canSpawn()) return;
    ParticleType type = disc();
    type.colors = {
        {0.1, {1, 0, 0.5}, 1}, {0.3, {0, 1, 0.5}, 1}, {0.5, {0.25, 0, 2}, 1}, {0.9, {0, 0, 0.1}, 1}};
    Scene scene = sceneOfParticles(type);
    setLife(scene, 1);
    const auto expected = [&](double age) {
        const auto& keys = type.colors;
        for (size_t i = 0; i + 1 < keys.size(); ++i)
            if (age >= keys[i].age && age < keys[i + 1].age)
                return glm::mix(keys[i].color, keys[i + 1].color,
                                (age - keys[i].age) / (keys[i + 1].age - keys[i].age));
        return age < keys[0].age ? keys[0].color : keys.back().color;
    };
    for (const int frames : {0, 6, 12, 18, 21, 30, 42, 54, 57})
        checkShows(draw(scene, frames), expected(frames / 60.0));

    // Opacity, over the sky.
    type.blend = Blend::alpha;
    type.colors = {{0, glm::dvec3(1), 0}, {0.5, glm::dvec3(1), 1}};
    scene = sceneOfParticles(type);
    setLife(scene, 1);
    const glm::dvec3 sky = radianceOf(middleOf(emptied(scene)));
    checkShows(draw(scene, 0), sky);
    checkShows(draw(scene, 12), glm::mix(sky, glm::dvec3(1), 0.4));
    checkShows(draw(scene, 45), glm::dvec3(1));
}

TEST_CASE("particles grow with age, and the dead are not drawn", "[render][particles]") {
    if (!canSpawn()) return;
    ParticleType type = disc();
    type.size = {0.4, 0.4};
    type.growth = {0.5, 3};
    Scene scene = sceneOfParticles(type);
    setLife(scene, 1);
    const Image empty = emptied(scene);
    for (const int frames : {0, 30, 48}) {
        const double wide = 0.4 * glm::mix(0.5, 3.0, frames / 60.0) * pixelsPerMeter(scene);
        CHECK(std::abs(extentOf(draw(scene, frames), empty).width - wide) <= 1.5);
    }
    CHECK(changed(draw(scene, 61), empty, 3).count == 0);
}

TEST_CASE("a particle shows the tile that it is to show", "[render][particles]") {
    const Scratch scratch;
    ParticleType type = disc();
    type.image = ParticleImage{.file = {}, .columns = 3, .rows = 2};
    type.image->file =
        writeTiles(scratch, 3, 2, 8, [](int tile, int, int) { return plainColors[size_t(tile)]; });
    for (int tile = 0; tile < 6; ++tile) {
        type.image->firstTile = type.image->lastTile = tile;
        for (const ParticleShape shape : {ParticleShape::quads, ParticleShape::sprites}) {
            type.shape = shape;
            checkShows(draw(sceneOfParticles(type)), light(plainColors[size_t(tile)]));
        }
    }
    // By seed: only those in use, and each of them.
    type.image->firstTile = 1;
    type.image->lastTile = 3;
    type.size = {0.1, 0.1};
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 30; ++i)
        places.emplace_back(0.12 * (i % 6) - 0.3, 0.12 * (i / 6) - 0.24, 0);
    const Scene scene = sceneOfParticles(type, places);
    const Image image = draw(scene);
    std::array<int, 6> found{};
    for (const glm::dvec3& place : places) {
        const glm::dvec2 at = glm::dvec2(place.x, -place.y) * pixelsPerMeter(scene) + glm::dvec2(80, 60);
        for (size_t tile = 0; tile < 6; ++tile)
            found[tile] +=
                farthest(pixel(image, int(at.x), int(at.y)), shownOf(light(plainColors[tile]))) <= 2;
    }
    CHECK(found[0] + found[4] + found[5] == 0);
    CHECK(found[1] + found[2] + found[3] == 30);
    for (const size_t tile : {1U, 2U, 3U})
        CHECK(found[tile] >= 3);  // 30 throws at 1/3: fewer once in 20,000 seeds
}

TEST_CASE("neighbouring tiles do not bleed, near or far", "[render][particles]") {
    const Scratch scratch;
    ParticleType type = disc();
    type.image = ParticleImage{.file = {}, .columns = 3, .rows = 3, .firstTile = 4, .lastTile = 4};
    type.image->file =
        writeTiles(scratch, 3, 3, 15, [](int tile, int, int) { return plainColors[tile == 4 ? 1 : 0]; });
    for (const double size : {0.9, 0.2, 0.03}) {
        type.size = glm::dvec2(size);
        const Image image = draw(sceneOfParticles(type));
        int red = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                red = std::max(red, pixel(image, x, y).x);
        CHECK(red <= middleOf(emptied(sceneOfParticles(type))).x + 3);
    }
}

TEST_CASE("a flip-book's frames fade into one another", "[render][particles]") {
    if (!canSpawn()) return;
    const Scratch scratch;
    ParticleType type = disc();
    type.image = ParticleImage{.file = {}, .columns = 3, .rows = 1, .lastTile = 2, .flipBook = true};
    type.image->file =
        writeTiles(scratch, 3, 1, 8, [](int tile, int, int) { return plainColors[size_t(tile)]; });
    const auto shown = [&](int frames) {
        Scene scene = sceneOfParticles(type);
        setLife(scene, 1);
        return draw(scene, frames);
    };
    const auto mixed = [](size_t a, size_t b, double share) {
        return glm::mix(light(plainColors[a]), light(plainColors[b]), share);
    };
    checkShows(shown(0), mixed(0, 0, 0));
    checkShows(shown(12), mixed(0, 1, 0.4));
    checkShows(shown(54), mixed(1, 2, 0.8));
    type.image->blend = false;
    checkShows(shown(12), mixed(0, 0, 0));
    checkShows(shown(24), mixed(1, 1, 0));
    type.image->blend = true;
    type.image->frameRate = 10;  // over and over: 0.9 s is three times around
    checkShows(shown(3), mixed(0, 1, 0.5));
    checkShows(shown(15), mixed(2, 0, 0.5));
    checkShows(shown(21), mixed(0, 1, 0.5));
}

TEST_CASE("sprites look as quads do, turned or not", "[render][particles]") {
    const Scratch scratch;
    ParticleType type = disc();
    const auto bothShapes = [&](const char* what) {
        const std::vector<glm::dvec3> places = {
            {-0.7, 0.4, 0.3}, {0.6, 0.3, -0.5}, {0.5, -0.5, 0}, {-0.4, -0.3, 0.1}};
        type.shape = ParticleShape::quads;
        const Scene scene = sceneOfParticles(type, places);
        const Image quads = draw(scene);
        type.shape = ParticleShape::sprites;
        const Image sprites = draw(sceneOfParticles(type, places));
        const Changed apart = changed(quads, sprites, 40), both = changed(quads, emptied(scene), 40);
        INFO(what << ": " << apart.count << " pixels apart of " << both.count << ", by at most "
                  << apart.most);
        CHECK(both.count > 400);
        CHECK(apart.count <= both.count / 50);
    };
    type.size = {0.3, 0.5};
    type.blend = Blend::alpha;
    bothShapes("dots");
    // A square with a bright corner: turned wrongly it would differ by a quarter of itself.
    type.image = ParticleImage();
    type.image->file = writeTiles(scratch, 1, 1, 32, [](int, int x, int y) {
        return x > 16 && y < 16 ? glm::ivec4(255, 255, 255, 255) : glm::ivec4(120, 0, 60, 255);
    });
    bothShapes("squares");
    type.turn = {0.4, 0.9};
    bothShapes("turned squares");
    type.lit = true;
    bothShapes("lit squares");
}

TEST_CASE("sprites beyond the context's limit become quads", "[render][particles]") {
    ParticleType type = disc();
    type.size = {2.5, 2.5};
    type.shape = ParticleShape::quads;
    const RenderOptions large = {.width = 480, .height = 800};
    const Image quads = show(sceneOfParticles(type), 0, large).image;
    type.shape = ParticleShape::sprites;
    CHECK(changed(quads, show(sceneOfParticles(type), 0, large).image, 40).count <= 50);
}

TEST_CASE("a quad turns anticlockwise, with its picture upright", "[render][particles]") {
    const Scratch scratch;
    ParticleType type = disc();
    type.image = ParticleImage();  // green at the upper right
    type.image->file = writeTiles(scratch, 1, 1, 32,
                                  [](int, int x, int y) { return plainColors[x > 16 && y < 16 ? 1 : 0]; });
    const auto greenAt = [&](double turn, int x, int y) {
        type.turn = glm::dvec2(turn);
        const glm::ivec3 found = pixel(draw(sceneOfParticles(type)), x, y);
        return found.y > found.x;
    };
    const int off = int(0.2 * pixelsPerMeter(sceneOfParticles(type)));
    CHECK(greenAt(0, 80 + off, 60 - off));
    CHECK(greenAt(1.5707963, 80 - off, 60 - off));
    CHECK(greenAt(3.1415927, 80 - off, 60 + off));
    CHECK_FALSE(greenAt(1.5707963, 80 + off, 60 - off));
}

TEST_CASE("facing velocity, length grows with the speed across the view", "[render][particles]") {
    ParticleType type = disc();
    const Scratch scratch;
    type.size = {0.1, 0.1};
    type.image = ParticleImage();
    type.image->file = writeTiles(scratch, 1, 1, 8, [](int, int, int) { return glm::ivec4(255); });
    type.facing = ParticleFacing::velocity;
    type.stretch = 0.5;
    const auto extent = [&](const glm::dvec3& velocity) {
        Scene scene = sceneOfParticles(type);
        scene.groups[0].velocity = velocity;
        return extentOf(draw(scene, 0), emptied(scene));
    };
    const double meter = pixelsPerMeter(sceneOfParticles(type));
    const auto near = [&](int found, double meters) { return std::abs(found - meters * meter) <= 1.5; };
    CHECK((near(extent({1.6, 0, 0}).width, 0.9) && near(extent({1.6, 0, 0}).height, 0.1)));
    CHECK((near(extent({0, -1, 0}).width, 0.1) && near(extent({0, -1, 0}).height, 0.6)));
    // Along the line of sight it is as wide as long; at rest, too.
    CHECK((near(extent({0, 0, 2}).width, 0.1) && near(extent({0, 0, 2}).height, 0.1)));
    CHECK((near(extent({0, 0, 0}).width, 0.1) && near(extent({0, 0, 0}).height, 0.1)));
}

TEST_CASE("points are as many pixels wide as they are to be", "[render][particles]") {
    ParticleType type;
    type.shape = ParticleShape::points;
    type.blend = Blend::additive;
    for (const double pixels : {1.0, 2.0, 7.0}) {
        type.pixels = pixels;
        for (const double z : {0.0, -20.0}) {
            const Scene scene = sceneOfParticles(type, {{0.003, 0.005, z}});
            const Image image = draw(scene), empty = emptied(scene);
            double area = 0;
            for (int y = 40; y < 80; ++y)
                for (int x = 60; x < 100; ++x)
                    area += radianceOf(pixel(image, x, y)).x - radianceOf(pixel(empty, x, y)).x;
            // A disc whose edge falls off over a pixel.
            const double expected = 3.14159 * (pixels * pixels / 4 + 1.0 / 12);
            CHECK(std::abs(area / expected - 1) < 0.15);
        }
    }
}

TEST_CASE("particles fade in front of a surface", "[render][particles]") {
    ParticleType type = disc();
    type.blend = Blend::alpha;
    type.colors[0].color = {2, 0.5, 0};
    Scene scene = sceneOfParticles(type);
    scene.colliders.push_back({.name = "wall", .shape = BoxCollider{{0, 0, -0.6}, {6, 6, 1}, {1, 0, 0, 0}}});
    scene.sky.ground = scene.sky.zenith = scene.sky.horizon = glm::dvec3(0.4);
    const glm::dvec3 wall = radianceOf(middleOf(emptied(scene)));  // its face is at z = -0.1
    checkShows(draw(scene), type.colors[0].color);
    for (const double softness : {0.05, 0.2, 0.4}) {
        scene.groups[0].particle->softness = softness;
        checkShows(draw(scene), glm::mix(wall, type.colors[0].color, std::min(0.1 / softness, 1.0)));
    }
    // Nothing behind but the sky: as if it were not soft.
    scene.colliders.clear();
    checkShows(draw(scene), type.colors[0].color);
}

TEST_CASE("particles and blended molecules are drawn in one order", "[render][particles][transparency]") {
    // A particle between two panes.
    Scene panes = sceneOfSquares({{0, 0, 0.4}, {0, 0, -0.4}}, 0.8);
    panes.groups[0].molecule.material.blend = Blend::alpha;
    panes.groups[0].molecule.material.opacity = 0.5;
    panes.groups[0].molecule.material.color = {0.1, 0.1, 0.9};
    ParticleType type = disc();
    type.blend = Blend::alpha;
    type.colors[0] = {0, {1, 0.2, 0}, 0.6};
    const auto withParticleAt = [&](double z) {
        Scene scene = sceneOfParticles(type, {{0, 0, z}});
        scene.groups.push_back(panes.groups[0]);
        return draw(scene);
    };
    // Light of a pane, front and back, over black and over white gives what it lets through.
    const glm::dvec3 behind = radianceOf(middleOf(withParticleAt(-0.8))),
                     between = radianceOf(middleOf(withParticleAt(0))),
                     before = radianceOf(middleOf(withParticleAt(0.8)));
    // Through half a pane more each time: what the particle adds of red grows.
    CHECK(between.x > 1.3 * behind.x);
    CHECK(before.x > 1.3 * between.x);
    // The particle before both hides 0.6 of them, and shows all of its own.
    const glm::dvec3 without = radianceOf(middleOf(withParticleAt(1000)));
    checkShows(withParticleAt(0.8), glm::mix(without, type.colors[0].color, 0.6));
}

TEST_CASE("light is added and filters multiply, above 1 too", "[render][particles]") {
    ParticleType type = disc();
    type.blend = Blend::additive;
    type.colors[0] = {0, {3, 0.5, 0}, 0.5};
    Scene scene = sceneOfParticles(type, {{0, 0, 0}, {0, 0, 0.01}});
    const glm::dvec3 sky = radianceOf(middleOf(emptied(scene)));
    checkShows(draw(scene), sky + glm::dvec3(3, 0.5, 0));
    type.blend = Blend::multiplicative;
    type.colors[0] = {0, {0.5, 1, 0}, 0.5};
    scene = sceneOfParticles(type, {{0, 0, 0}, {0, 0, 0.01}});
    scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::dvec3(0.5);
    const glm::dvec3 bright = radianceOf(middleOf(emptied(scene)));
    checkShows(draw(scene), bright * glm::dvec3(0.5625, 1, 0.25));
}

TEST_CASE("opaque particles cast shadows, blended ones do not", "[render][particles]") {
    ParticleType type = disc();
    const auto floor = [&](Blend blend) {
        type.blend = blend;
        Scene scene = sceneOfParticles(type, {{0, 1, 0}});
        scene.colliders.push_back({.name = "floor", .shape = PlaneCollider{}});
        scene.camera.eye = {0, 2, 3};
        scene.light.direction = {0, -1, 0};
        scene.light.intensity = 3;
        scene.light.shadows = true;
        return brightness(middleOf(draw(scene)));
    };
    CHECK(floor(Blend::none) < floor(Blend::alpha) * 3 / 4);
}

TEST_CASE("whatever the sliders say, no pixel is lost", "[render][particles]") {
    std::mt19937 random(5);
    const auto pick = [&](const std::vector<double>& values) { return values[random() % values.size()]; };
    const std::vector<double> sizes = {1e-9, 0.02, 3, 1e6}, turns = {0, 1, 1e6, -1e6};
    const ParticleType usual = disc();
    const Image before = draw(sceneOfParticles(usual));
    for (int round = 0; round < 16; ++round) {
        ParticleType type;
        type.shape = ParticleShape(round % 3);
        type.facing = ParticleFacing(random() % 3);
        type.blend = Blend(random() % 4);
        type.size = glm::dvec2(pick(sizes));
        type.growth = {pick({0, 1, 1e6}), pick({0, 1, 1e6})};
        if (type.growth == glm::dvec2(0)) type.growth.y = 1;  // never to be seen is refused
        type.turn = glm::dvec2(pick(turns));
        type.spin = glm::dvec2(pick(turns));
        type.stretch = pick({0, 1, 1e6});
        type.pixels = pick({1, 64});
        type.softness = pick({0, 1e-9, 1e6});
        type.lit = random() % 2 == 0;
        type.colors = {{0, glm::dvec3(pick({0, 0.3})), pick({0, 1})},
                       {1, glm::dvec3(pick({0, 0.3})), pick({0, 1})}};
        std::vector<glm::dvec3> places(50);
        for (glm::dvec3& place : places)
            place = {pick({-1, 0, 1}), pick({-0.5, 0, 0.5}), pick({-1e4, -1, 0, 2.9999, 3})};
        Scene scene = sceneOfParticles(type, places);
        scene.groups[0].velocity = {pick({0, 9000}), 0, pick({0, 1})};
        if (canSpawn()) setLife(scene, pick({1e-9, 1, 1e30}));
        const Image image = draw(scene, round % 2);
        int lost = 0;  // the picture shows what is no number as the brightest; no light here is
        for (size_t i = 0; i + 3 < image.pixels.size(); i += 4)
            lost += type.blend != Blend::additive && image.pixels[i] >= 254 && image.pixels[i + 1] >= 254;
        CHECK(lost == 0);
    }
    CHECK(changed(before, draw(sceneOfParticles(usual)), 0).count == 0);
}
