#include <set>
#include <tuple>

#include "gl/render_scene.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// Shows the scene with its molecules out of sight.
Image withoutMolecules(Scene scene) {
    for (Group& group : scene.groups)
        for (Placement::Item& item : group.place.items)
            item.position.z += 1000;
    return show(scene).image;
}

// Pixels of a length at a distance, in a picture 120 high.
double pixels(const Scene& scene, double length, double distance) {
    return length / distance * 120 / (2 * std::tan(scene.camera.fieldOfView / 2));
}

}  // namespace

TEST_CASE("a molecule covers the pixels that a pinhole camera would show it on", "[render]") {
    const glm::dvec3 place(0.5, -0.25, 0);
    const Scene scene = sceneOfSquares({place});
    const Shown shown = show(scene);
    const Changed found = changed(shown.image, withoutMolecules(scene), 30);

    const double side = pixels(scene, 0.4, 3);
    CHECK(found.count == Approx(side * side).epsilon(0.08));
    CHECK(found.centroid.x == Approx(80 + pixels(scene, place.x, 3)).margin(0.5));
    CHECK(found.centroid.y == Approx(60 - pixels(scene, place.y, 3)).margin(0.5));
}

TEST_CASE("a picture far from the origin is the picture at it", "[render][far]") {
    Scene near = sceneOfSquares({{0.3, 0.1, 0}, {-0.4, -0.2, -0.3}, {0.33, 0.05, -0.7}});
    near.camera.eye = {0.3, 0.2, 3.03};
    near.colliders.emplace_back().shape = PlaneCollider{.point = {0, -0.5, 0}};
    near.colliders.emplace_back().shape = SphereCollider{{0.6, 0.3, -0.4}, 0.2};
    const Image image = show(near).image;
    // Grid and grain of the plane repeat every kilometre.
    for (const double distance : {1e3, 1e4, 1e5, 1e6}) {
        Scene far = near;
        const glm::dvec3 shift(distance, -distance, distance);
        for (Placement::Item& item : far.groups[0].place.items)
            item.position += shift;
        std::get<PlaneCollider>(*far.colliders[0].shape).point += shift;
        std::get<SphereCollider>(*far.colliders[1].shape).center += shift;
        far.camera.eye += shift;
        far.camera.target += shift;
        // Interior and edges alike. Places themselves are rounded to doubles, 1e-10 m out there: that may
        // move an edge across one sample of one pixel, and nothing else.
        CAPTURE(distance);
        CHECK(changed(image, show(far).image, 2).count <= 1);
    }
}

TEST_CASE("alpha cuts holes into a molecule", "[render]") {
    const Scratch scratch;
    Image image{64, 64, 4, std::vector<uint8_t>(64 * 64 * 4, 255)};
    for (int y = 0; y < 64; ++y)
        for (int x = 32; x < 64; ++x)
            image.pixels[size_t(y * 64 + x) * 4 + 3] = 0;
    writePng(scratch.path("half.png"), image);

    Scene scene = sceneOfSquares({{0, 0, 0}}, 1);
    scene.groups[0].molecule.file = scratch.path("square.json");
    scene.groups[0].molecule.material.texture = "half.png";
    const Changed found = changed(show(scene).image, withoutMolecules(scene), 30);

    const double side = pixels(scene, 1, 3);
    CHECK(found.count == Approx(side * side / 2).epsilon(0.08));
    CHECK(found.centroid.x == Approx(80 - side / 4).margin(0.6));
}

TEST_CASE("both sides are drawn, and light shines through what is translucent", "[render]") {
    Scene scene = sceneOfSquares({{0, 0, 0}}, 1);
    const auto middle = [&] { return brightness(pixel(show(scene).image, 80, 60)); };
    const int front = middle();
    scene.camera.eye = {0, 0, -3};
    const int back = middle();
    scene.groups[0].molecule.material.translucency = 0.8;
    const int through = middle();
    CHECK(back > 30);  // the sky lights it
    CHECK(back < front - 60);
    CHECK(through > back + 30);
}

TEST_CASE("a molecule's shadow darkens the ground below it, and nothing else", "[render]") {
    Scene scene = sceneOfSquares({{0, 1, 0}}, 1);
    scene.groups[0].place.items[0].rotation = glm::angleAxis(-1.5707963267948966, glm::dvec3(1, 0, 0));
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{}, .color = {0.5, 0.5, 0.5}});
    scene.light.direction = {0, -1, 0};
    scene.camera.eye = {0, 0.8, 4};  // below the square's edge, so that it hides none of its shadow
    scene.camera.target = {0, 0, 0};
    const Image shaded = show(scene).image;
    scene.light.shadows = false;
    const Image lit = show(scene).image;
    CHECK(brightness(pixel(shaded, 80, 60)) < brightness(pixel(lit, 80, 60)) * 3 / 4);
    CHECK(difference(pixel(shaded, 10, 60), pixel(lit, 10, 60)) <= 1);
    CHECK(difference(pixel(shaded, 80, 115), pixel(lit, 80, 115)) <= 1);
}

TEST_CASE("shadows go with what moves, and those of what stands still with what is edited", "[render]") {
    Scene scene = sceneOfSquares({{-3, 0.5, -3}});
    scene.light.direction = {0, -1, 0};
    scene.camera.target = {0, 0, 0};
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{}, .color = {0.5, 0.5, 0.5}});
    // boards with room below them, of which a camera to the side sees the shade
    const auto board = [](double x, double z) {
        Collider out;
        out.shape = BoxCollider{{x, 1, z}, {0.5, 0.02, 0.5}};
        return out;
    };
    scene.colliders.push_back(board(-1, 0));
    scene.colliders.push_back(board(1, 0));
    ColliderPath path;
    path.keyframes = {{0, {}}, {1, {{0, 0, 1.5}, {1, 0, 0, 0}}}};
    scene.colliders.back().path = path;
    scene.camera.eye = {0, 4, 4};
    const Plan plan = compile(scene);
    Renderer renderer(testContext(), scene, plan, {.width = 320, .height = 240});
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    // darker than the open ground
    const auto shadeAt = [&](double time, const glm::dvec3& place) {
        View view = View::fromCamera(scene.camera);
        view.time = time;
        renderer.draw(simulation.state(), view);
        const Image image = renderer.capture();
        const Eye eye(view, image.width, image.height);
        const auto brightnessAt = [&](const glm::dvec3& x) {
            const glm::vec4 clip = eye.toClip * glm::vec4(glm::vec3(x - eye.origin.exact), 1);
            const glm::vec2 at = (glm::vec2(clip) / clip.w * glm::vec2(0.5f, -0.5f) + 0.5f) *
                                 glm::vec2(image.width, image.height);
            return brightness(pixel(image, int(at.x), int(at.y)));
        };
        return 4 * brightnessAt(place) < 3 * brightnessAt({0, 0, 0.5});
    };
    const glm::dvec3 still{-1, 0, 0}, moving{1, 0, 0}, moved{1, 0, 1.5}, edited{-1, 0, -1.5};
    for (const double time : {0.0, 1.0, 0.0}) {
        CAPTURE(time);
        CHECK(shadeAt(time, still));
        CHECK(shadeAt(time, moving) == (time == 0));
        CHECK(shadeAt(time, moved) == (time == 1));
    }
    scene.colliders[1] = board(-1, -1.5);
    renderer.changeColliders(scene.colliders);
    CHECK_FALSE(shadeAt(0, still));
    CHECK(shadeAt(0, edited));
    CHECK(shadeAt(0, moving));
}

TEST_CASE("what stands still casts shadows far from what moves, as far as its own map goes", "[render]") {
    Scene scene = sceneOfSquares({{0, 0.5, -3}});
    scene.light.direction = {0, -1, 0};
    scene.camera.eye = {0, 4, 4};
    scene.camera.target = {0, 0, 0};  // its own map ends 57 m on
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{}, .color = {0.5, 0.5, 0.5}});
    Model roof;
    roof.mesh.positions = {{-100, 1, -1}, {100, 1, -1}, {100, 1, 1}, {-100, 1, 1}};
    roof.mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    roof.mesh.parts = {{"roof", "paint", 0, 2, 0}};
    roof.mesh.materials.emplace_back();
    completeMesh(roof.mesh);
    scene.models.push_back(roof);
    const Plan plan = compile(scene);
    Renderer renderer(testContext(), scene, plan, {.width = 160, .height = 120});
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    // in the shade of the roof, whose middle lies above z = 0, or not
    const auto brightnessAt = [&](double x, double z) {
        Camera below = scene.camera;
        below.eye = {x, 0.6, z + 4};
        below.target = {x, 0, z};
        renderer.draw(simulation.state(), View::fromCamera(below));
        return brightness(pixel(renderer.capture(), 80, 60));
    };
    for (const double x : {0.0, 2.0, 20.0, 50.0, -50.0}) {
        CAPTURE(x);
        CHECK(4 * brightnessAt(x, 0) < 3 * brightnessAt(x, 6));
    }
    for (const double x : {75.0, -75.0, 90.0}) {
        CAPTURE(x);
        CHECK(brightnessAt(x, 0) == Approx(brightnessAt(x, 6)).epsilon(0.1));
    }
}

TEST_CASE("places near others see less of the sky", "[render][occlusion]") {
    Scene scene = sceneOfSquares({{0, 0, -1000}});
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{}, .color = {0.5, 0.5, 0.5}});
    const auto shown = [&](double occlusion) {
        scene.sky.occlusion = occlusion;
        return show(scene, 0, {.width = 320, .height = 240}).image;
    };
    scene.light.intensity = 0;
    scene.light.shadows = false;
    scene.camera.eye = {0, 1, 4};
    scene.camera.target = {0, 0.3, 0};
    // The ground alone hides nothing of itself, near or far.
    CHECK(changed(shown(0), shown(1), 2).count < 20);

    scene.colliders.push_back({.name = "box", .shape = BoxCollider{{0, 0.3, 0}, {1.2, 0.6, 0.6}}});
    const Image open = shown(0), half = shown(0.5), hidden = shown(1);
    // Under the front of the box, where wall and ground meet: 0.3 m before the middle.
    const double perMeter = 240 / (2 * std::tan(scene.camera.fieldOfView / 2)) / 3.77;
    const int below = 120 + int(0.3 * 0.98 * perMeter) + 1;
    const auto lost = [&](const Image& image, int y) {
        return brightness(pixel(open, 160, y)) - brightness(pixel(image, 160, y));
    };
    INFO("the box ends in row " << below);
    CHECK(lost(hidden, below + 1) > 15);  // the ground
    CHECK(lost(hidden, below - 2) > 15);  // the wall
    CHECK(lost(half, below + 1) > 6);
    CHECK(lost(half, below + 1) < lost(hidden, below + 1));
    CHECK(lost(hidden, below + 60) <= 3);    // the open ground
    CHECK(std::abs(lost(hidden, 20)) <= 1);  // the sky
    CHECK(difference(pixel(open, 20, 20), pixel(hidden, 20, 20)) <= 1);
    // No rim of it outside the box, before the sky and the far ground.
    const Changed off = changed(open, hidden, 12);
    CHECK(off.count > 100);
    CHECK(off.count < 320 * 240 / 8);
}

TEST_CASE("instances differ in colour, the same ones every time", "[render]") {
    std::vector<glm::dvec3> places;
    for (int i = 0; i < 9; ++i)
        places.emplace_back(i % 3 - 1, i / 3 - 1, 0);
    Scene scene = sceneOfSquares(places, 0.4);
    scene.groups[0].molecule.material.secondColor = glm::dvec3(0.1, 0.5, 0.1);
    const auto colors = [&] {
        const Image image = show(scene).image;
        std::vector<std::tuple<int, int, int>> out;
        for (const glm::dvec3& place : places) {
            const glm::ivec3 c =
                pixel(image, int(80 + pixels(scene, place.x, 3)), int(60 - pixels(scene, place.y, 3)));
            out.emplace_back(c.x, c.y, c.z);
        }
        return out;
    };
    const auto first = colors();
    CHECK(std::set(first.begin(), first.end()).size() >= 7);
    CHECK(first == colors());
}

TEST_CASE("molecules without triangles are round", "[render]") {
    Scene scene = sceneOfSquares({{0.25, 0, 0}});
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.resize(1);
    molecule.vertices[0].position = {0, 0, 0};
    molecule.triangles.clear();
    molecule.material.pointSize = 0.6;
    const Changed found = changed(show(scene).image, withoutMolecules(scene), 20);
    const double diameter = pixels(scene, 0.6, 3);
    CHECK(found.count == Approx(3.14159 / 4 * diameter * diameter).epsilon(0.1));
    CHECK(found.centroid.x == Approx(80 + pixels(scene, 0.25, 3)).margin(0.6));
}

TEST_CASE("drawing writes no state and moves none", "[render]") {
    Scene scene = sceneOfSquares({{0, 0, 0}, {0.3, 0.4, -1}});
    scene.gravity = {0, -9.81, 0};
    const Shown shown = show(scene, 5);
    CHECK(shown.stateUnchanged);
    CHECK(shown.moved.total(gpu::Traffic::Kind::state) == 0);
    CHECK(shown.moved.total(gpu::Traffic::Kind::parameters) == 0);
    CHECK(shown.moved.total(gpu::Traffic::Kind::control) == 0);
}

TEST_CASE("a picture does without samples, shadows and occlusion, and is full again", "[render]") {
    Scene scene = sceneOfSquares({{0, 0.5, 0}});
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{}, .color = {0.5, 0.5, 0.5}});
    scene.colliders.push_back({.name = "box", .shape = BoxCollider{{1, 0.3, 0}, {0.6, 0.6, 0.6}}});
    scene.light.direction = {-1.5, -1, 0.5};
    scene.sky.occlusion = 1;
    scene.camera.eye = {0, 1.5, 4};
    scene.camera.target = {0, 0.3, 0};
    const Plan plan = compile(scene);
    Renderer renderer(testContext(), scene, plan, {.width = 160, .height = 120});
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    const auto drawn = [&](const Quality& quality) {
        renderer.setQuality(quality);
        renderer.draw(simulation.state(), View::fromCamera(scene.camera));
        return renderer.capture();
    };
    const Image full = drawn({});
    // edges alone; what lay in the shade is brighter, and so is what is near others
    const Image jagged = drawn({.samples = 1});
    CHECK(changed(full, jagged, 8).count > 50);
    CHECK(changed(full, jagged, 8).count < 1000);
    const Image lit = drawn({.shadows = false}), open = drawn({.occlusion = false});
    CHECK(changed(full, lit, 20).count > 300);
    CHECK(changed(full, open, 4).count > 100);
    int darker = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x)
            for (const Image* less : {&lit, &open})
                darker += brightness(pixel(*less, x, y)) < brightness(pixel(full, x, y)) - 3;
    CHECK(darker == 0);
    CHECK(drawn({}).pixels == full.pixels);
}

TEST_CASE("a picture takes another size, and every number of samples", "[render]") {
    Scene scene = sceneOfSquares({{0, 0, 0}});
    const Plan plan = compile(scene);
    for (const int samples : {1, 4}) {
        Renderer renderer(testContext(), scene, plan,
                          {.width = 64, .height = 48, .quality = {.samples = samples}});
        const Simulation simulation(testContext(), plan, {.path = testPath()});
        renderer.resize(101, 37);
        renderer.draw(simulation.state(), View::fromCamera(scene.camera));
        const Image image = renderer.capture();
        REQUIRE(image.width == 101);
        REQUIRE(image.height == 37);
        const glm::ivec3 middle = pixel(image, 50, 18);
        CHECK(middle.x > middle.z + 40);  // the red square, also before the first frame
    }
}
