// How the materials of models are drawn.
#include "gl/render_scene.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;
using Alpha = SurfaceMaterial::Alpha;

namespace {

// A wall of 1 m x 1 m that faces the camera at z, of one material, before the sky.
Model wall(const SurfaceMaterial& material, const std::vector<Image>& images, double z = 0) {
    Model out;
    out.name = concat("wall ", z);
    Mesh& mesh = out.mesh;
    for (const glm::dvec2 uv : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
        mesh.positions.emplace_back(uv.x - 0.5, uv.y - 0.5, z);
        mesh.uvs.push_back(uv);
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.parts = {{"wall", "paint", 0, 2, 0}};
    mesh.materials = {material};
    mesh.images = images;
    completeMesh(mesh);
    return out;
}

Scene sceneOf(std::vector<Model> models) {
    Scene scene = sceneOfSquares({{0, 0, 1000}});
    scene.models = std::move(models);
    scene.light.shadows = false;
    return scene;
}

// Red in the upper left quarter, green in the upper right, blue in the lower left, white in the lower right.
Image fourColors(uint8_t redAlpha = 255) {
    Image out{16, 16, 4, {}};
    const uint8_t colors[4][4] = {
        {255, 0, 0, redAlpha}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            out.pixels.insert(out.pixels.end(), std::begin(colors[y / 8 * 2 + x / 8]),
                              std::end(colors[y / 8 * 2 + x / 8]));
    return out;
}

// The wall is 52 pixels a side about the middle of 160 x 120; a texel's middle is 13 from it.
glm::ivec3 at(const Image& image, int right, int up) {
    return pixel(image, 80 + right * 18, 60 - up * 18);
}

bool strongest(const glm::ivec3& color, int channel) {
    return color[channel] > 2 * color[(channel + 1) % 3] && color[channel] > 2 * color[(channel + 2) % 3];
}

}  // namespace

TEST_CASE("a model's colour image lies upright, times its colour", "[render][material]") {
    SurfaceMaterial material;
    material.colorImage = 0;
    Scene scene = sceneOf({wall(material, {fourColors()})});
    const Image image = show(scene).image;
    CHECK(strongest(at(image, -1, 1), 0));
    CHECK(strongest(at(image, 1, 1), 1));
    CHECK(strongest(at(image, -1, -1), 2));
    CHECK(brightness(at(image, 1, -1)) > 500);
    scene.models[0].color = {1, 0, 0};
    const Image red = show(scene).image;
    CHECK(strongest(at(red, 1, -1), 0));
    CHECK(brightness(at(red, -1, -1)) < 100);
}

TEST_CASE("parts of a model have materials of their own", "[render][material]") {
    SurfaceMaterial red, green;
    red.color = {1, 0, 0, 1};
    green.color = {0, 1, 0, 1};
    Model model = wall(red, {});
    model.mesh.materials.push_back(green);
    model.mesh.parts = {{"wall", "green", 0, 1, 1}, {"wall", "red", 1, 1, 0}};
    const Image image = show(sceneOf({model})).image;
    CHECK(strongest(at(image, 1, -1), 1));  // the first triangle
    CHECK(strongest(at(image, -1, 1), 0));
}

TEST_CASE("a cut material has holes, and so has its shadow", "[render][material]") {
    SurfaceMaterial material;
    material.colorImage = 0;
    material.alpha = Alpha::cut;
    SurfaceMaterial white;
    Model behind = wall(white, {}, -0.4);
    Scene scene = sceneOf({wall(material, {fourColors(0)}), behind});
    const Image without = show(scene).image;
    CHECK(brightness(at(without, -1, 1)) > 500);
    CHECK(strongest(at(without, 1, 1), 1));

    // Seen from the side of the wall behind, which the sun reaches through the hole alone.
    scene.light.direction = {0, 0, -1};
    scene.light.shadows = true;
    scene.camera.eye = {1.6, 0, 0};
    scene.camera.target = {0, 0, -0.4};
    const Image lit = show(scene).image;
    scene.models[0].mesh.images[0] = fourColors();
    const Image shaded = show(scene).image;
    CHECK(changed(lit, shaded, 60).count > 20);
}

TEST_CASE("a blended material shows what is behind it, from whichever side", "[render][material]") {
    SurfaceMaterial glass;
    glass.color = {0, 1, 0, 0.5};
    glass.alpha = Alpha::blend;
    SurfaceMaterial red;
    red.color = {1, 0, 0, 1};
    Scene scene = sceneOf({wall(glass, {}), wall(red, {}, -0.2)});
    const glm::ivec3 through = at(show(scene).image, 0, 0);
    CHECK(through.r > 60);
    CHECK(through.g > 60);
    CHECK(through.b < 60);
    scene.camera.eye = {0, 0, -3};
    CHECK(strongest(at(show(scene).image, 0, 0), 0));
    // of two panes the nearer counts more, whatever their order in the scene
    SurfaceMaterial blue = glass;
    blue.color = {0, 0, 1, 0.8};
    glass.color.a = 0.8;
    for (const bool blueFirst : {false, true}) {
        std::vector<Model> models = {wall(glass, {}, 0.1), wall(blue, {}, -0.1)};
        if (blueFirst) std::swap(models[0], models[1]);
        const glm::ivec3 color = at(show(sceneOf(models)).image, 0, 0);
        CHECK(color.g > color.b);
    }
}

TEST_CASE("normals, roughness, metal and emitted light come from their images", "[render][material]") {
    const auto middle = [](const SurfaceMaterial& material, const std::vector<Image>& images) {
        return at(show(sceneOf({wall(material, images)})).image, 0, 0);
    };
    const auto texel = [](std::initializer_list<uint8_t> color) { return Image{1, 1, 4, color}; };
    SurfaceMaterial grey;
    grey.color = {0.5, 0.5, 0.5, 1};
    const glm::ivec3 plain = middle(grey, {});

    SurfaceMaterial bumpy = grey;
    bumpy.normalImage = 0;
    CHECK(difference(middle(bumpy, {texel({128, 128, 255, 255})}), plain) <= 3);
    // The sun stands behind the camera and above: what leans up is lighter, and darker what leans down.
    const int up = brightness(middle(bumpy, {texel({128, 218, 218, 255})}));
    const int down = brightness(middle(bumpy, {texel({128, 38, 218, 255})}));
    CHECK(up > down + 60);
    const glm::ivec3 left = middle(bumpy, {texel({38, 128, 218, 255})}),
                     right = middle(bumpy, {texel({218, 128, 218, 255})});
    CHECK(difference(left, right) <= 6);

    SurfaceMaterial shining = grey;
    shining.emissive = {2, 2, 2};
    shining.emissiveImage = 0;
    CHECK(difference(middle(shining, {texel({0, 0, 0, 255})}), plain) <= 1);
    CHECK(strongest(middle(shining, {texel({255, 0, 0, 255})}) - plain + 1, 0));

    SurfaceMaterial metal = grey;
    metal.metallic = 1;
    metal.roughness = 1;
    const glm::ivec3 mirror = middle(metal, {});
    metal.roughnessImage = 0;
    CHECK(difference(middle(metal, {texel({0, 255, 255, 255})}), mirror) <= 1);
    const glm::ivec3 dielectric = middle(metal, {texel({0, 255, 0, 255})});
    CHECK(difference(dielectric, mirror) > 10);
    grey.roughness = 1;
    CHECK(difference(dielectric, middle(grey, {})) <= 1);
}
