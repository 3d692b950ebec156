// The colours of a mesh's parts gathered in one image: each triangle finds its own there again.
#include <cmath>

#include "author/from_mesh.h"
#include "support/catch.h"
#include "support/message_of.h"

using namespace shoal;
using Alpha = SurfaceMaterial::Alpha;

namespace {

// Squares of 1 m side by side along x, of one part each. Coordinates run from `low` to `high`.
struct Square {
    int look = -1;
    glm::dvec2 low{0}, high{1};
};

Mesh squares(const std::vector<Square>& all) {
    Mesh mesh;
    for (size_t i = 0; i < all.size(); ++i) {
        const int first = int(mesh.positions.size());
        for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
            mesh.positions.emplace_back(at.x + 2 * double(i), at.y, 0);
            mesh.uvs.push_back(glm::mix(all[i].low, all[i].high, at));
        }
        mesh.triangles.insert(mesh.triangles.end(),
                              {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
        mesh.parts.push_back({"square", concat("m", all[i].look), int(2 * i), 2, all[i].look});
    }
    completeMesh(mesh);
    return mesh;
}

// Red, green; blue, white: in quarters, from the upper left.
Image quarters(int side) {
    Image out{side, side, 4, {}};
    const uint8_t colors[4][4] = {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto& color = colors[2 * y / side * 2 + 2 * x / side];
            out.pixels.insert(out.pixels.end(), std::begin(color), std::end(color));
        }
    return out;
}

// The texel at a place of a square, from 0 to 1 along its sides.
std::vector<int> seen(const Mesh& mesh, const Image& image, int square, const glm::dvec2& at) {
    const glm::ivec3& t = mesh.triangles[size_t(2 * square + (at.y > at.x ? 1 : 0))];
    // by its corners (0, 0), (1, 0), (1, 1) or (0, 0), (1, 1), (0, 1)
    const glm::dvec3 weights =
        at.y > at.x ? glm::dvec3(1 - at.y, at.x, at.y - at.x) : glm::dvec3(1 - at.x, at.x - at.y, at.y);
    const glm::dvec2 uv = weights.x * mesh.uvs[size_t(t.x)] + weights.y * mesh.uvs[size_t(t.y)] +
                          weights.z * mesh.uvs[size_t(t.z)];
    const int x = int(uv.x * image.width), y = int((1 - uv.y) * image.height);
    const uint8_t* texel = &image.pixels[(size_t(y) * size_t(image.width) + size_t(x)) * 4];
    return {texel[0], texel[1], texel[2], texel[3]};
}

const std::vector<int> red{255, 0, 0, 255}, green{0, 255, 0, 255}, blue{0, 0, 255, 255},
    white{255, 255, 255, 255};

SurfaceMaterial withImage(int image) {
    SurfaceMaterial out;
    out.colorImage = image;
    return out;
}

}  // namespace

TEST_CASE("parts of several materials find their colours in one image", "[from-mesh][material]") {
    Mesh mesh = squares({{0}, {1}, {-1}, {2}});
    SurfaceMaterial flat, halved = withImage(0);
    flat.color = {0, 0, 1, 1};
    halved.color = {0, 1, 1, 1};
    mesh.materials = {withImage(0), flat, halved};
    mesh.images = {quarters(32)};
    const Mesh before = mesh;
    std::vector<std::string> notes;
    const std::optional<Image> image = gatherColors(mesh, notes);
    REQUIRE(image);
    CHECK(notes.empty());
    CHECK(image->width <= 2048);
    CHECK(mesh.triangles.size() == before.triangles.size());
    CHECK(mesh.weldedPositions == before.weldedPositions);
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int corner = 0; corner < 3; ++corner) {
            const auto now = size_t(mesh.triangles[t][corner]), then = size_t(before.triangles[t][corner]);
            CHECK(mesh.positions[now] == before.positions[then]);
            CHECK(mesh.weld[now] == before.weld[then]);
        }
    CHECK(seen(mesh, *image, 0, {0.2, 0.8}) == red);
    CHECK(seen(mesh, *image, 0, {0.8, 0.8}) == green);
    CHECK(seen(mesh, *image, 0, {0.2, 0.2}) == blue);
    CHECK(seen(mesh, *image, 0, {0.8, 0.2}) == white);
    CHECK(seen(mesh, *image, 1, {0.5, 0.4}) == blue);
    CHECK(seen(mesh, *image, 2, {0.9, 0.1}) == white);
    CHECK(seen(mesh, *image, 3, {0.2, 0.8}) == std::vector<int>{0, 0, 0, 255});
    CHECK(seen(mesh, *image, 3, {0.8, 0.2}) == std::vector<int>{0, 255, 255, 255});
}

TEST_CASE("an image that a triangle repeats is repeated, from wherever its coordinates begin",
          "[from-mesh][material]") {
    Mesh mesh = squares({{0, {-3, 5}, {-1, 6}}, {1}});
    mesh.materials = {withImage(0), {}};
    mesh.images = {quarters(32)};
    std::vector<std::string> notes;
    const std::optional<Image> image = gatherColors(mesh, notes);
    REQUIRE(image);
    CHECK(notes.empty());
    for (const double shift : {0.0, 0.5}) {
        CHECK(seen(mesh, *image, 0, {0.1 + shift, 0.9}) == red);
        CHECK(seen(mesh, *image, 0, {0.4 + shift, 0.9}) == green);
        CHECK(seen(mesh, *image, 0, {0.1 + shift, 0.1}) == blue);
    }
    mesh = squares({{0, {0, 0}, {50, 1}}});
    mesh.materials = {withImage(0)};
    mesh.images = {quarters(32)};
    CHECK(gatherColors(mesh, notes));
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("repeats more than 8 times"));
}

TEST_CASE("one image alone stays as it is, holes with it, and images larger than the whole shrink",
          "[from-mesh][material]") {
    Mesh mesh = squares({{0}});
    mesh.materials = {withImage(0)};
    mesh.images = {quarters(64)};
    mesh.images[0].pixels[3] = 0;
    std::vector<std::string> notes;
    Mesh opaque = mesh;
    CHECK(gatherColors(opaque, notes)->pixels == quarters(64).pixels);  // its alpha says nothing
    mesh.materials[0].alpha = Alpha::cut;
    const std::vector<uint8_t> pixels = mesh.images[0].pixels;
    const std::optional<Image> one = gatherColors(mesh, notes);
    REQUIRE(one);
    CHECK(one->pixels == pixels);

    mesh = squares({{0}, {1}, {2}, {3}, {4}, {5}});
    for (int i = 0; i < 6; ++i) {
        mesh.materials.push_back(withImage(i));
        mesh.images.push_back(quarters(2048));
    }
    const std::optional<Image> many = gatherColors(mesh, notes);
    REQUIRE(many);
    CHECK(std::max(many->width, many->height) <= 2048);
    for (int i = 0; i < 6; ++i)
        CHECK(seen(mesh, *many, i, {0.8, 0.8}) == green);
}

TEST_CASE("a mesh of one colour needs no image; what an image does not show is told",
          "[from-mesh][material]") {
    std::vector<std::string> notes;
    Mesh mesh = squares({{-1}, {-1}});
    const std::vector<glm::dvec2> uvs = mesh.uvs;
    CHECK_FALSE(gatherColors(mesh, notes));
    CHECK(mesh.uvs == uvs);
    CHECK(notes.empty());

    mesh = squares({{0}, {1}});
    mesh.materials.resize(2);
    mesh.materials[0].alpha = Alpha::blend;
    mesh.materials[1].emissive = {1, 0, 0};
    CHECK(gatherColors(mesh, notes));
    REQUIRE(notes.size() == 2);
    CHECK(notes[0] == "material \"m0\": it is blended in the file, and opaque in the skin");
    CHECK_THAT(notes[1], Catch::Contains("emitted light"));
}
