#include <cmath>
#include <numbers>
#include <set>

#include "scene/scene.h"
#include "support/catch.h"
#include "support/meshes.h"

using namespace shoal;
using namespace shoal::test;

namespace {

constexpr double pi = std::numbers::pi;

Scene sceneOf(Placement place, int count) {
    Scene scene;
    Group group;
    group.place = std::move(place);
    group.count = count;
    group.location = {"scene.json", 7, 3, "$.groups[0]"};
    scene.groups.push_back(group);
    return scene;
}

Scene onModel(Mesh mesh, Placement::Kind kind, int count) {
    Placement place;
    place.kind = kind;
    place.model = 0;
    place.align = Placement::Align::normal;
    Scene scene = sceneOf(place, count);
    Model model;
    model.name = "host";
    model.mesh = std::move(mesh);
    scene.models.push_back(model);
    return scene;
}

glm::dvec3 axisOf(const Instance& instance) {
    return instance.rotation * glm::dvec3(0, 1, 0);
}

bool same(const std::vector<Instance>& a, const std::vector<Instance>& b, size_t count) {
    for (size_t i = 0; i < count; ++i)
        if (a[i].position != b[i].position || a[i].rotation != b[i].rotation || a[i].scale != b[i].scale ||
            a[i].seed != b[i].seed)
            return false;
    return true;
}

}  // namespace

TEST_CASE("the same seed places the same, another one does not", "[placement]") {
    Scene scene = sceneOf({}, 100);
    scene.groups[0].place.turn = Placement::Turn::any;
    scene.groups[0].place.scale = {0.5, 2};
    const std::vector<Instance> first = place(scene, 0);
    CHECK(same(first, place(scene, 0), 100));

    scene.groups[0].count = 250;  // more molecules leave the first hundred alone
    CHECK(same(first, place(scene, 0), 100));

    scene.seed = 2;
    CHECK_FALSE(same(first, place(scene, 0), 1));

    scene.seed = 1;
    scene.groups.push_back(scene.groups[0]);
    CHECK_FALSE(same(first, place(scene, 1), 1));

    std::set<uint32_t> seeds;
    for (const Instance& instance : place(scene, 0))
        seeds.insert(instance.seed);
    CHECK(seeds.size() == 250);
}

TEST_CASE("a volume is filled evenly", "[placement]") {
    Placement in;
    in.box = {{-1, 2, 5}, {3, 4, 6}};
    in.scale = {1, 3};
    const int count = 40000;
    glm::dvec3 mean(0), square(0);
    double scale = 0;
    for (const Instance& instance : place(sceneOf(in, count), 0)) {
        const glm::dvec3 u = (instance.position - in.box.low) / (in.box.high - in.box.low);
        for (int i = 0; i < 3; ++i)
            REQUIRE((u[i] >= 0 && u[i] <= 1));
        mean += u / double(count);
        square += u * u / double(count);
        scale += instance.scale / count;
    }
    // Standard errors are 0.0015 for the means: five of them.
    for (int i = 0; i < 3; ++i) {
        CHECK(mean[i] == Approx(0.5).margin(0.0075));
        CHECK(square[i] == Approx(1.0 / 3).margin(0.0075));
    }
    CHECK(scale == Approx(2).margin(0.015));
}

TEST_CASE("random turns are uniform", "[placement]") {
    Placement in;
    in.turn = Placement::Turn::any;
    const int count = 20000;
    glm::dvec3 mean(0), square(0);
    for (const Instance& instance : place(sceneOf(in, count), 0)) {
        mean += axisOf(instance) / double(count);
        square += axisOf(instance) * axisOf(instance) / double(count);
    }
    for (int i = 0; i < 3; ++i) {
        CHECK(mean[i] == Approx(0).margin(0.02));
        CHECK(square[i] == Approx(1.0 / 3).margin(0.015));
    }

    in.turn = Placement::Turn::yaw;
    double c = 0, s = 0;
    for (const Instance& instance : place(sceneOf(in, count), 0)) {
        CHECK(axisOf(instance).y == Approx(1));
        const glm::dvec3 x = instance.rotation * glm::dvec3(1, 0, 0);
        c += x.x / count;
        s += x.z / count;
    }
    CHECK(std::hypot(c, s) < 0.02);
}

TEST_CASE("vertices are taken once each before any is taken twice", "[placement]") {
    Mesh mesh;
    addTube(mesh, "tube", {0, 0, 0}, 1, 4, 10, 5);
    completeMesh(mesh);
    const size_t vertices = mesh.weldedPositions.size();
    Scene scene = onModel(mesh, Placement::Kind::vertices, static_cast<int>(2 * vertices));
    const std::vector<Instance> placed = place(scene, 0);
    for (size_t round = 0; round < 2; ++round) {
        std::set<std::pair<double, std::pair<double, double>>> taken;
        for (size_t i = round * vertices; i < (round + 1) * vertices; ++i)
            taken.insert({placed[i].position.x, {placed[i].position.y, placed[i].position.z}});
        CHECK(taken.size() == vertices);
    }
    CHECK(placed[0].rotation != placed[vertices].rotation);
}

TEST_CASE("molecules stand along the normal, off the surface", "[placement]") {
    Mesh mesh;
    addTube(mesh, "tube", {0, 0, 0}, 1, 4, 32, 5);
    completeMesh(mesh);
    Scene scene = onModel(mesh, Placement::Kind::vertices, 100);
    scene.groups[0].place.offset = 0.25;
    for (const Instance& instance : place(scene, 0)) {
        const glm::dvec3 foot = instance.position - 0.25 * axisOf(instance);
        double nearest = 1e9;
        size_t at = 0;
        for (size_t v = 0; v < mesh.weldedPositions.size(); ++v) {
            const double distance = glm::distance(mesh.weldedPositions[v], foot);
            if (distance < nearest) {
                nearest = distance;
                at = v;
            }
        }
        CHECK(nearest < 1e-12);
        CHECK(glm::dot(axisOf(instance), mesh.weldedNormals[at]) == Approx(1));
    }

    scene.groups[0].place.align = Placement::Align::up;
    for (const Instance& instance : place(scene, 0))
        CHECK(axisOf(instance).y == Approx(1));
}

TEST_CASE("droop bends the axis a share of the way down", "[placement]") {
    for (const double droop : {0.0, 0.25, 0.6, 1.0}) {
        Placement in;
        in.droop = droop;
        in.align = Placement::Align::up;
        for (const Instance& instance : place(sceneOf(in, 20), 0))
            CHECK(std::acos(glm::clamp(axisOf(instance).y, -1.0, 1.0)) == Approx(droop * pi).margin(1e-6));
    }
    // From a horizontal normal the axis stays in the vertical plane through it.
    Mesh mesh = square(2);
    for (glm::dvec3& p : mesh.positions)
        p = {p.y, p.x, p.z};
    mesh.normals.clear();
    completeMesh(mesh);
    const glm::dvec3 normal = mesh.weldedNormals[0];
    REQUIRE(std::abs(normal.x) == Approx(1));
    Scene scene = onModel(mesh, Placement::Kind::surface, 20);
    scene.groups[0].place.droop = 0.5;
    for (const Instance& instance : place(scene, 0)) {
        CHECK(axisOf(instance).y == Approx(-std::sqrt(0.5)));
        CHECK(glm::dot(axisOf(instance), normal) == Approx(std::sqrt(0.5)));
    }
}

TEST_CASE("tilt tips by at most its angle, in every direction", "[placement]") {
    Placement in;
    in.tilt = 0.3;
    double largest = 0;
    glm::dvec3 mean(0);
    for (const Instance& instance : place(sceneOf(in, 4000), 0)) {
        largest = std::max(largest, std::acos(glm::clamp(axisOf(instance).y, -1.0, 1.0)));
        mean += axisOf(instance) / 4000.0;
    }
    CHECK(largest <= 0.3 + 1e-9);
    CHECK(largest > 0.29);
    CHECK(std::hypot(mean.x, mean.z) < 0.015);
}

TEST_CASE("a surface is covered by area", "[placement]") {
    // Three quarters of the area lie in the larger square.
    Mesh mesh = square(1);
    Mesh large = square(std::sqrt(3.0));
    for (const glm::dvec3& p : large.positions)
        mesh.positions.push_back(p + glm::dvec3(10, 0, 0));
    for (const glm::ivec3& t : large.triangles)
        mesh.triangles.push_back(t + 4);
    completeMesh(mesh);
    const int count = 20000;
    int onLarge = 0;
    glm::dvec3 mean(0);
    for (const Instance& instance : place(onModel(mesh, Placement::Kind::surface, count), 0)) {
        REQUIRE(std::abs(instance.position.y) < 1e-12);
        CHECK(axisOf(instance).y == Approx(1));
        if (instance.position.x < 5) continue;
        ++onLarge;
        mean += instance.position;
    }
    CHECK(onLarge / double(count) == Approx(0.75).margin(0.015));
    CHECK(mean.x / onLarge == Approx(10).margin(0.02));
    CHECK(mean.z / onLarge == Approx(0).margin(0.02));
}

TEST_CASE("grids and lists place exactly", "[placement]") {
    Placement grid;
    grid.kind = Placement::Kind::grid;
    grid.origin = {1, 2, 3};
    grid.spacing = {0.5, 1, 2};
    grid.cells = {2, 3, 2};
    const std::vector<Instance> placed = place(sceneOf(grid, 12), 0);
    CHECK(placed[0].position == glm::dvec3(1, 2, 3));
    CHECK(placed[1].position == glm::dvec3(1.5, 2, 3));
    CHECK(placed[2].position == glm::dvec3(1, 3, 3));
    CHECK(placed[11].position == glm::dvec3(1.5, 4, 5));

    Placement list;
    list.kind = Placement::Kind::list;
    list.turn = Placement::Turn::none;
    const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, 2, 3)));
    list.items = {{{1, 2, 3}, turn, 2}, {{4, 5, 6}, {1, 0, 0, 0}, 1}};
    const std::vector<Instance> items = place(sceneOf(list, 2), 0);
    CHECK(items[0].position == glm::dvec3(1, 2, 3));
    CHECK(std::abs(glm::dot(items[0].rotation, turn)) == Approx(1));
    CHECK(items[0].scale == 2);
    CHECK(items[1].position == glm::dvec3(4, 5, 6));
    CHECK(items[1].rotation == glm::dquat(1, 0, 0, 0));
}

TEST_CASE("an empty selection says what matched", "[placement]") {
    Scene scene = onModel(square(2), Placement::Kind::vertices, 10);
    scene.groups[0].place.select.minHeight = 1;
    scene.groups[0].place.select.maxHeight = 5;
    CHECK_THROWS_WITH(place(scene, 0),
                      Catch::Contains("scene.json:7:3: nothing of model \"host\" matches the selection") &&
                          Catch::Contains("of 4 vertices, minHeight 1 m matched 0; maxHeight 5 m matched 4"));
    scene.groups[0].place.select = {};
    scene.groups[0].place.select.thinnest = 0.5;
    CHECK_THROWS_WITH(place(scene, 0), Catch::Contains("have no thickness: the surface is open there"));
}

TEST_CASE("the points of a cloud are places, along the normals that its file has", "[placement]") {
    Mesh cloud;
    cloud.positions = {{0, 0, 0}, {5, 0, 0}, {0, 7, 0}, {0, 7, 0}};
    cloud.normals = {{1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
    completeMesh(cloud);
    std::set<double> sums;
    for (const Instance& instance : place(onModel(cloud, Placement::Kind::vertices, 3), 0)) {
        sums.insert(instance.position.x + instance.position.y);
        const glm::dvec3 normal = instance.position.y > 0 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        CHECK(glm::dot(axisOf(instance), normal) == Approx(1));
    }
    CHECK(sums == std::set<double>{0, 5, 7});
    // What a selection asks of triangles, a cloud does not have.
    Scene scene = onModel(cloud, Placement::Kind::vertices, 3);
    scene.groups[0].place.select.minHeight = 1;
    for (const Instance& instance : place(scene, 0))
        CHECK(instance.position.y == 7);
    scene.groups[0].place.select.thinnest = 0.5;
    CHECK_THROWS_AS(place(scene, 0), Error);
}
