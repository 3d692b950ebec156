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
