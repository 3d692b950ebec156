// Blended molecules: the picture against blending in closed form, the order against depths of our own, and
// nothing of it where nothing is blended.
#include <numeric>
#include <random>
#include <set>

#include "gl/blending.h"
#include "render/draw_order.h"
#include "scene/collider_kinds.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr RenderOptions small = {.width = 160, .height = 120};

// Squares one behind the other on the axis, numbered in no order of their depths.
Scene sceneOfPanes(Blend blend, double opacity, const std::vector<double>& depths = {0, -1, 0.5, -2}) {
    std::vector<glm::dvec3> places;
    for (const double z : depths)
        places.emplace_back(0.01 * z, 0, z);
    Scene scene = sceneOfSquares(places, 0.6);
    Material& material = scene.groups[0].molecule.material;
    material.color = {0.7, 0.2, 0.1};
    material.secondColor = glm::dvec3(0.1, 0.3, 0.8);
    material.blend = blend;
    material.opacity = opacity;
    scene.light.shadows = false;
    return scene;
}

glm::ivec3 middle(const Scene& scene) {
    return pixel(show(scene, 1, small).image, 80, 60);
}

// Only the square `kept` of all groups together, in place; -1: none.
Scene alone(Scene scene, int kept) {
    int number = 0;
    for (Group& group : scene.groups) {
        group.molecule.material.opacity = 1;
        for (Placement::Item& item : group.place.items)
            if (number++ != kept) item.position.z += 1000;
    }
    return scene;
}

// The light of each square, the sky's behind them at the end.
std::vector<glm::dvec3> lights(const Scene& scene) {
    size_t count = 0;
    for (const Group& group : scene.groups)
        count += group.place.items.size();
    std::vector<glm::dvec3> out;
    for (int i = 0; i < int(count); ++i)
        out.push_back(radianceOf(middle(alone(scene, i))));
    out.push_back(radianceOf(middle(alone(scene, -1))));
    return out;
}

// From back to front.
glm::dvec3 blendedOver(const std::vector<glm::dvec3>& light, const std::vector<int>& order, double opacity) {
    glm::dvec3 out = light.back();
    for (const int i : order)
        out = opacity * light[size_t(i)] + (1 - opacity) * out;
    return out;
}

// Many squares in a box, seen from a circle around it.
Scene sceneInBox(int count, DrawSort sort, int spreadFrames) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1, 1);
    std::vector<glm::dvec3> places;
    for (int i = 0; i < count; ++i)
        places.emplace_back(place(random), place(random), place(random));
    Scene scene = sceneOfSquares(places, 0.1);
    Material& material = scene.groups[0].molecule.material;
    material.blend = Blend::alpha;
    material.opacity = 0.5;
    material.sort = sort;
    material.spreadFrames = spreadFrames;
    return scene;
}

View viewAt(double angle) {
    View view;
    view.eye = {4 * std::sin(angle), 0.5, 4 * std::cos(angle)};
    view.target = {0, 0, 0};
    return view;
}

double depth(const Scene& scene, const View& view, uint32_t molecule) {
    return glm::dot(scene.groups[0].place.items[molecule].position - view.eye,
                    glm::normalize(view.target - view.eye));
}

bool isPermutation(const std::vector<KeyIndex>& order) {
    std::vector<bool> seen(order.size());
    for (const KeyIndex& one : order) {
        if (one.index >= order.size() || seen[one.index]) return false;
        seen[one.index] = true;
    }
    return true;
}

// Neighbours of the order that stand the wrong way round by more than floats can tell.
int wrongNeighbours(const Scene& scene, const View& view, const std::vector<KeyIndex>& order) {
    int out = 0;
    for (size_t i = 1; i < order.size(); ++i)
        out += depth(scene, view, order[i].index) > depth(scene, view, order[i - 1].index) + 1e-5;
    return out;
}

}  // namespace

TEST_CASE("alpha is blended from back to front, as the closed form has it", "[render][transparency]") {
    for (const DrawSort sort : {DrawSort::frame, DrawSort::spread}) {
        Scene scene = sceneOfPanes(Blend::alpha, 0.6);
        scene.groups[0].molecule.material.sort = sort;
        const glm::ivec3 found = middle(scene);
        const std::vector<glm::dvec3> light = lights(scene);
        CHECK(farthest(found, shownOf(blendedOver(light, {3, 1, 0, 2}, 0.6))) <= 2.5);
        // the order matters, so that a wrong one would be seen
        for (const std::vector<int>& wrong : {std::vector<int>{0, 1, 2, 3}, {2, 0, 1, 3}})
            CHECK(farthest(found, shownOf(blendedOver(light, wrong, 0.6))) > 8);
    }
}

TEST_CASE("without a sort molecules are blended as they are numbered", "[render][transparency]") {
    Scene scene = sceneOfPanes(Blend::alpha, 0.6);
    scene.groups[0].molecule.material.sort = DrawSort::none;
    CHECK(farthest(middle(scene), shownOf(blendedOver(lights(scene), {0, 1, 2, 3}, 0.6))) <= 2.5);
}

TEST_CASE("light is added, and filters multiply, in any order", "[render][transparency]") {
    const Scene adding = sceneOfPanes(Blend::additive, 0.3);
    std::vector<glm::dvec3> light = lights(adding);  // each with the sky's: that one was added to
    glm::dvec3 sum = light.back();
    for (size_t i = 0; i + 1 < light.size(); ++i)
        sum += 0.3 * (light[i] - light.back());
    CHECK(farthest(middle(adding), shownOf(sum)) <= 4);

    const Scene filtering = sceneOfPanes(Blend::multiplicative, 0.5);
    light = lights(filtering);
    glm::dvec3 product = light.back();
    for (size_t i = 0; i + 1 < light.size(); ++i)
        product *= 1.0 + 0.5 * (light[i] / light.back() - 1.0);
    CHECK(farthest(middle(filtering), shownOf(product)) <= 3);
}

TEST_CASE("several groups are blended by their depths, in slabs", "[render][transparency]") {
    for (const bool first : {false, true}) {  // whichever group comes first in the scene
        Scene scene =
            sceneOfPanes(Blend::alpha, 0.5, first ? std::vector<double>{-2, 0} : std::vector<double>{-1, 1});
        Scene other =
            sceneOfPanes(Blend::alpha, 0.5, first ? std::vector<double>{-1, 1} : std::vector<double>{-2, 0});
        other.groups[0].name = "others";
        other.groups[0].molecule.material.color = {0.1, 0.6, 0.2};
        scene.groups.push_back(other.groups[0]);
        const std::vector<int> order = first ? std::vector<int>{0, 2, 1, 3} : std::vector<int>{2, 0, 3, 1};
        const glm::ivec3 found = middle(scene);
        const std::vector<glm::dvec3> light = lights(scene);
        CHECK(farthest(found, shownOf(blendedOver(light, order, 0.5))) <= 2.5);
        CHECK(farthest(found, shownOf(blendedOver(light, {0, 1, 2, 3}, 0.5))) > 8);
        // A spread order has no draws of its own for the slabs; together with one that has, and alone.
        scene.groups[0].molecule.material.sort = DrawSort::spread;
        CHECK(farthest(middle(scene), shownOf(blendedOver(light, order, 0.5))) <= 2.5);
        scene.groups[1].molecule.material.sort = DrawSort::spread;
        CHECK(farthest(middle(scene), shownOf(blendedOver(light, order, 0.5))) <= 2.5);
        // One that asks for no order is drawn in the slabs of the other; where none asks, there are no slabs.
        scene.groups[0].molecule.material.sort = DrawSort::none;
        CHECK(farthest(middle(scene), shownOf(blendedOver(light, order, 0.5))) <= 2.5);
        scene.groups[1].molecule.material.sort = DrawSort::none;
        CHECK(farthest(middle(scene), shownOf(blendedOver(light, {0, 1, 2, 3}, 0.5))) <= 2.5);
    }
}

TEST_CASE("what is blended is hidden by what is in front, and hides nothing", "[render][transparency]") {
    Scene scene = sceneOfPanes(Blend::alpha, 0.6, {-1, 0});
    Scene opaque = sceneOfSquares({{0, 0, 0.5}}, 0.6);
    opaque.groups[0].name = "opaque";
    scene.groups.push_back(opaque.groups[0]);
    const glm::ivec3 found = middle(scene);
    CHECK(difference(found, middle(alone(scene, 2))) <= 2);
    scene.groups[1].place.items[0].position.z = -2;  // behind both
    const std::vector<glm::dvec3> light = lights(scene);
    const glm::dvec3 expected = 0.6 * light[1] + 0.4 * (0.6 * light[0] + 0.4 * light[2]);
    CHECK(farthest(middle(scene), shownOf(expected)) <= 2.5);
}

TEST_CASE("the order within a group is exact while the camera moves", "[render][transparency]") {
    const Scene scene = sceneInBox(500, DrawSort::frame, 1);
    const Plan plan = compile(scene);
    Renderer renderer(testContext(), scene, plan, small);
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    for (int frame = 0; frame < 8; ++frame) {
        const View view = viewAt(0.7 * frame);
        const gpu::Traffic before = testContext().traffic();
        renderer.draw(simulation.state(), view);
        CHECK((testContext().traffic() - before).total(gpu::Traffic::Kind::state) == 0);
        const std::vector<KeyIndex> order = renderer.orderOf(0)->download();
        REQUIRE(order.size() == 500);
        CHECK(isPermutation(order));
        CHECK(wrongNeighbours(scene, view, order) == 0);
    }
    testContext().checkErrors("drawing in order");
}

TEST_CASE("a spread order follows the camera, and is exact once it rests", "[render][transparency]") {
    const int frames = 12;
    const Scene scene = sceneInBox(300, DrawSort::spread, frames);
    const Plan plan = compile(scene);
    Renderer renderer(testContext(), scene, plan, small);
    const Simulation simulation(testContext(), plan, {.path = testPath()});
    const auto wrongAt = [&](double angle) {
        renderer.draw(simulation.state(), viewAt(angle));
        const std::vector<KeyIndex> order = renderer.orderOf(0)->download();
        CHECK(isPermutation(order));
        return wrongNeighbours(scene, viewAt(angle), order);
    };
    CHECK(wrongAt(0) == 0);  // the first frame sorts
    int wrong = 0;
    for (int frame = 1; frame <= 5; ++frame)
        wrong = wrongAt(0.1 * frame);
    CHECK(wrong > 0);  // late, else this test would say nothing
    for (int frame = 0; frame < 2 * frames; ++frame)
        wrong = wrongAt(0.5);
    CHECK(wrong == 0);
}

TEST_CASE("no pass is drawn that changes no pixel", "[render][transparency]") {
    const auto passesOf = [](const Scene& scene) {
        const Plan plan = compile(scene);
        Renderer renderer(testContext(), scene, plan,
                          {.width = 64, .height = 64, .timing = gpu::PassTimers::Mode::finish});
        const Simulation simulation(testContext(), plan, {.path = testPath()});
        renderer.draw(simulation.state(), View::fromCamera(scene.camera));
        std::set<std::string> names;
        for (const gpu::PassTime& pass : renderer.timers().report())
            names.insert(pass.name);
        return names;
    };
    using Names = std::set<std::string>;
    // the least: panes that are not blended, without sun and occlusion
    Scene scene = sceneOfPanes(Blend::none, 0.5);
    scene.sky.occlusion = 0;
    CHECK(passesOf(scene) == Names{"molecules", "sky", "resolve", "picture"});
    scene.sky.occlusion = 1;
    CHECK(passesOf(scene) == Names{"molecules", "sky", "depth", "resolve", "occlusion", "picture"});
    scene.sky.occlusion = 0;
    scene.light.shadows = true;
    CHECK(passesOf(scene).contains("shadows"));
    // what is blended casts no shadow, and neither does a plane
    scene.colliders.push_back({.name = "ground", .shape = PlaneCollider{{0, -1, 0}}});
    scene.groups[0].molecule.material.blend = Blend::alpha;
    CHECK(passesOf(scene) == Names{"order", "surfaces", "sky", "blended", "resolve", "picture"});
    scene.colliders.push_back({.name = "ball", .shape = BoxCollider{{0, 0, 0}, {0.3, 0.3, 0.3}}});
    CHECK(passesOf(scene).contains("shadows"));
}

TEST_CASE("points are blended in order, too", "[render][transparency]") {
    Scene scene = sceneOfPanes(Blend::alpha, 0.6);
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.resize(1);
    molecule.vertices[0].position = {0, 0, 0};
    molecule.triangles.clear();
    molecule.material.pointSize = 0.6;
    const glm::ivec3 found = middle(scene);
    CHECK(farthest(found, shownOf(blendedOver(lights(scene), {3, 1, 0, 2}, 0.6))) <= 2.5);
}

TEST_CASE("a single blended molecule needs no sort, and every sort takes it", "[render][transparency]") {
    for (const DrawSort sort : {DrawSort::none, DrawSort::frame, DrawSort::spread}) {
        Scene scene = sceneOfPanes(Blend::alpha, 0.6, {0});
        scene.groups[0].molecule.material.sort = sort;
        CHECK(farthest(middle(scene), shownOf(blendedOver(lights(scene), {0}, 0.6))) <= 2.5);
    }
}
