// Molecules that are drawn with their skin, from the state of either path.
#include "gl/render_scene.h"
#include "molecule/skin.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// n x n squares over the square of squareMolecule(), `height` above it.
SkinMesh fineSquare(double side, int n, double height = 0) {
    SkinMesh out;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const glm::dvec2 uv(double(i) / n, double(j) / n);
            out.positions.emplace_back(side * (uv.x - 0.5), side * (uv.y - 0.5), height);
            out.uvs.push_back(uv);
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i;
            out.triangles.push_back({a, a + 1, a + n + 2});
            out.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    return out;
}

Scene oneSquare(double z = 0) {
    Scene scene = sceneOfSquares({{0.1, 0.2, z}}, 0.8);
    scene.gravity = {0, -1, 0};  // it moves a little
    return scene;
}

// How many channels differ by more than `most`.
int different(const Image& a, const Image& b, int most) {
    REQUIRE(a.pixels.size() == b.pixels.size());
    int count = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        count += std::abs(int(a.pixels[i]) - int(b.pixels[i])) > most ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("a skin over a square is drawn as the square is", "[render][skin]") {
    Scene plain = oneSquare(), skinned = plain;
    Molecule& molecule = skinned.groups[0].molecule;
    molecule.skin = bindSkin(molecule, fineSquare(0.8, 6));
    const Shown a = show(plain, 3), b = show(skinned, 3);
    CHECK(b.stateUnchanged);
    CHECK(different(a.image, b.image, 2) < 12);  // along the rim
    // and not by chance: a smaller one is seen to be smaller
    molecule.skin = bindSkin(molecule, fineSquare(0.6, 6));
    CHECK(different(a.image, show(skinned, 3).image, 2) > 300);
}

// So many domes of 2,048 triangles, one behind the other and aside, from 2 m to 40 m before the camera.
static Scene rowOfDomes(int count) {
    std::vector<glm::dvec3> places;
    for (int i = 0; i < count; ++i)
        places.emplace_back(0.35 * (i % 5 - 2) * (1 + i / 5), 0.3 * (1 + i / 5) * (i % 3 - 1), 1.0 - 2 * i);
    Scene scene = sceneOfSquares(places, 0.3);
    SkinMesh dome = fineSquare(0.3, 32);
    for (glm::dvec3& p : dome.positions)
        p.z = 0.1 * std::cos(10 * p.x) * std::cos(10 * p.y);
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.push_back({.position = {0, 0, 0.1}, .uv = {}, .mass = 1e-3});
    molecule.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    molecule.skin = bindSkin(molecule, dome);
    scene.light.direction = {0, -1, -0.4};
    return scene;
}

TEST_CASE("far skins are drawn with fewer triangles, and look the same", "[render][skin]") {
    const int count = 20;
    Scene scene = rowOfDomes(count);
    gpu::Context& context = testContext();
    const Plan plan = compile(scene);
    const auto triangles = [&](const RenderOptions& options) {
        Renderer renderer(context, scene, plan, options);
        Simulation simulation(context, plan, {.path = testPath()});
        renderer.draw(simulation.state(), View::fromCamera(scene.camera));
        return renderer.drawnPrimitives();
    };
    const uint64_t all = 2048 * count, drawn = triangles({.width = 320, .height = 240});
    INFO(drawn << " triangles of " << all);
    if (!context.info().computeShaders) {
        CHECK(drawn == all);
        return;
    }
    CHECK(drawn < all / 4);
    CHECK(drawn > 8 * count);
    // A larger picture shows more of them.
    CHECK(triangles({.width = 1280, .height = 960}) > drawn * 3 / 2);

    // A group of one is too few triangles to be worth an order: it is drawn with all of them.
    Scene apart = scene;
    apart.groups.clear();
    for (const Placement::Item& place : scene.groups[0].place.items) {
        apart.groups.push_back(scene.groups[0]);
        apart.groups.back().count = 1;
        apart.groups.back().place.items = {place};
    }
    const RenderOptions options{.width = 320, .height = 240};
    const Image levels = show(scene, 0, options).image, whole = show(apart, 0, options).image;
    const Changed off = changed(levels, whole, 16);
    INFO(off.count << " pixels differ, by " << off.most << " at the most");
    CHECK(off.count < 100);
    // and not by chance: they are seen
    scene.groups[0].place.items.resize(1);
    scene.groups[0].count = 1;
    CHECK(changed(show(scene, 0, options).image, whole, 16).count > 500);
}

TEST_CASE("a skin's offsets follow the molecule's normal", "[render][skin]") {
    Scene near = oneSquare(0.5), offset = oneSquare(0);
    Molecule& molecule = offset.groups[0].molecule;
    molecule.skin = bindSkin(molecule, fineSquare(0.8, 3, 0.5));
    CHECK(molecule.skin.vertices[0].offset == Approx(0.5));
    CHECK(different(show(near).image, show(offset).image, 2) < 12);
}

TEST_CASE("a skin is lit as a molecule of its own triangles is", "[render][skin]") {
    // a dome over the square, brighter where it faces the sun, which stands behind the camera and above it
    SkinMesh dome = fineSquare(0.8, 11);
    for (glm::dvec3& p : dome.positions)
        p.z = 0.3 * std::cos(3.9 * p.x) * std::cos(3.9 * p.y);
    Scene skinned = oneSquare();
    skinned.light.direction = {0, -1, -0.4};
    Scene whole = skinned;
    Molecule& few = skinned.groups[0].molecule;
    few.vertices.push_back({.position = {0, 0, 0.3}, .uv = {}, .mass = 1e-3});
    few.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    few.skin = bindSkin(few, dome);
    Molecule& all = whole.groups[0].molecule;
    all.vertices.clear();
    all.triangles.clear();
    for (const glm::dvec3& p : dome.positions)
        all.vertices.push_back({.position = p, .uv = {}, .mass = 1e-3});
    for (const SkinTriangle& t : dome.triangles)
        all.triangles.push_back({t.a, t.b, t.c});
    const Image a = show(skinned).image, b = show(whole).image;
    // normals are weighted by angles here and by areas there
    CHECK(different(a, b, 12) < 60);
    // and not by chance
    few.skin = {};
    CHECK(different(show(skinned).image, b, 12) > 1000);
}
