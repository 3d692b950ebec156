// Molecules that are drawn with their skin, from the state of either path.
#include "gl/render_scene.h"
#include "molecule/bind_skin.h"
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

TEST_CASE("a skin's smooth normals are lit", "[render][skin]") {
    // a dome over the square: brighter where it faces the sun, which stands behind the camera and above it
    Scene scene = oneSquare();
    Molecule& molecule = scene.groups[0].molecule;
    molecule.vertices.push_back({.position = {0, 0, 0.3}, .uv = {}, .mass = 1e-3});
    molecule.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    SkinMesh dome = fineSquare(0.8, 16);
    for (glm::dvec3& p : dome.positions)
        p.z = 0.3 * std::cos(3.9 * p.x) * std::cos(3.9 * p.y);
    molecule.skin = bindSkin(molecule, dome);
    scene.light.direction = {0, -1, -0.4};
    const Image image = show(scene).image;
    const auto red = [&](int x, int y) { return int(image.pixels[size_t(4 * (y * image.width + x))]); };
    // upper and lower flank
    const int x = image.width / 2 + 4, y = image.height / 2 - 9;
    CHECK(red(x, y - 10) > red(x, y + 10) + 40);
    // smooth: no step from one pixel to the next as large as between facets of the pyramid below
    int step = 0;
    for (int row = y - 12; row < y + 12; ++row)
        step = std::max(step, std::abs(red(x, row + 1) - red(x, row)));
    CHECK(step < 30);
}
