// How the materials of models are drawn.
#include <numbers>

#include "gl/render_scene.h"
#include "support/catch.h"
#include "support/solids.h"

using namespace shoal;
using namespace shoal::test;
using std::numbers::pi;
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

    // Seen from the side of the wall behind, which the sun reaches through the hole alone. The map of shadows
    // that is finest is about the molecules.
    scene.groups[0].place.items[0].position = {0, 0, -0.6};
    scene.light.direction = {0, 0, -1};
    scene.light.shadows = true;
    scene.camera.eye = {1.6, 0, 0};
    scene.camera.target = {0, 0, -0.4};
    const Image lit = show(scene).image;
    scene.models[0].mesh.images[0] = fourColors();
    const Image shaded = show(scene).image;
    CHECK(changed(lit, shaded, 60).count > 20);
}

TEST_CASE("a blended material's shadow is as strong as its opacity", "[render][material]") {
    SurfaceMaterial white, glass;
    glass.alpha = Alpha::blend;
    Scene scene = sceneOf({wall(glass, {}), wall(white, {}, -0.4)});
    scene.groups[0].place.items[0].position = {0, 0, -0.6};
    scene.light.direction = {0, 0, -1};
    scene.light.shadows = true;
    scene.camera.eye = {2, 0, 0.3};
    scene.camera.target = {0, 0, -0.4};
    std::vector<double> light;
    for (const double opacity : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        scene.models[0].mesh.materials[0].color = {0, 0, 0, opacity};
        const Image image = show(scene).image;
        double sum = 0;
        for (int x = -4; x <= 4; ++x)
            for (int y = -4; y <= 4; ++y)
                sum += brightness(pixel(image, 80 + x, 60 + y));
        light.push_back(sum / 81);
    }
    INFO(light[0] << " " << light[1] << " " << light[2] << " " << light[3] << " " << light[4]);
    CHECK(light[4] < 0.7 * light[0]);
    for (size_t i = 1; i < light.size(); ++i)
        CHECK(light[i] < light[i - 1] - 0.03 * (light[0] - light[4]));
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

namespace {

// A plate of 1.6 m x 1.6 m about the origin, which stands at half a right angle to the view.
Model plate(double thickness, const SurfaceMaterial& material) {
    constexpr int squares = 8;
    Model out;
    out.name = "plate";
    Mesh& mesh = out.mesh;
    const glm::dquat turn = glm::angleAxis(0.25 * pi, glm::dvec3(0, 1, 0));
    const auto face = [&](const glm::dvec3& middle, const glm::dvec3& u, const glm::dvec3& v) {
        const int first = int(mesh.positions.size()), across = squares + 1;
        for (int i = 0; i < across * across; ++i) {
            const double s = 2.0 * (i % across) / squares - 1, t = 2.0 * (i / across) / squares - 1;
            mesh.positions.push_back(turn * (middle + s * u + t * v));
        }
        for (int i = 0; i < squares * squares; ++i) {
            const int a = first + i / squares * across + i % squares;
            mesh.triangles.emplace_back(a, a + 1, a + across + 1);
            mesh.triangles.emplace_back(a, a + across + 1, a + across);
        }
    };
    const glm::dvec3 x(0.8, 0, 0), y(0, 0.8, 0), z(0, 0, 0.5 * thickness);
    face(z, x, y), face(-z, y, x), face(x, y, z), face(-x, z, y), face(y, z, x), face(-y, x, z);
    mesh.parts = {{"plate", "glass", 0, int(mesh.triangles.size()), 0}};
    mesh.materials = {material};
    completeMesh(mesh);
    return out;
}

// Where the border of red and green is, in a row above the middle.
int borderOf(const Scene& scene) {
    const Image image = show(scene, 1, {.width = 640, .height = 480}).image;
    int last = 0;
    for (int x = 240; x < 400; ++x)
        if (const glm::ivec3 color = pixel(image, x, 200); color.r > color.g) last = x;
    return last;
}

}  // namespace

TEST_CASE("what refracts moves what is behind it as a plate does", "[render][material]") {
    SurfaceMaterial glass, paint;
    glass.color = {1, 1, 1, 0.01};
    glass.alpha = Alpha::blend;
    paint.colorImage = 0;
    const Model behind = wall(paint, {fourColors()}, -1);
    const int straight = borderOf(sceneOf({plate(0.2, glass), behind}));
    CHECK(std::abs(straight - 320) <= 1);
    for (const double index : {1.25, 1.5, 2.0}) {
        glass.refraction = index;
        const double slope = std::sqrt(0.5);
        const double aside = 0.2 * slope * (1 - slope / std::sqrt(index * index - 0.5));  // Snell's law, m
        const double pixelsPerMeter = 240 / (std::tan(0.4) * 4);
        const int moved = borderOf(sceneOf({plate(0.2, glass), behind}));
        INFO("index " << index << ": " << moved - straight << " pixels");
        CHECK(std::abs(moved - straight - aside * pixelsPerMeter) <= 1);
    }
}

TEST_CASE("smooth normals that lean away from the eye do not turn over", "[render][material]") {
    const auto floorOf = [](double lean) {
        Model out = wall({}, {});
        for (glm::dvec3& p : out.mesh.positions)
            p = {p.x, 0, -2 * p.y};
        completeMesh(out.mesh);
        for (glm::dvec3& n : out.mesh.normals)
            n = {0, std::cos(lean), -std::sin(lean)};
        Scene scene = sceneOf({out});
        scene.light.direction = {0, -1, 0};
        scene.sky.occlusion = 0;
        scene.camera.eye = {0, 0.15, 2};
        return brightness(pixel(show(scene).image, 80, 62));
    };
    const int straight = floorOf(0), leaning = floorOf(0.25);
    CHECK(straight > 300);
    CHECK(std::abs(leaning - straight) < straight / 20);
}

TEST_CASE("clouds cover their share of the sky", "[render]") {
    const auto sky = [](double share) {
        Scene scene = sceneOfSquares({{0, 0, 1000}});
        scene.sky.clouds = share;
        scene.camera.target = {0, 2, 0};
        return show(scene).image;
    };
    const Image clear = sky(0);
    int before = 0;
    for (const double share : {0.25, 0.5, 1.0}) {
        const int covered = changed(clear, sky(share), 20).count;
        INFO(share << ": " << covered);
        CHECK(covered > before);
        before = covered;
    }
    CHECK(before > 160 * 120 / 2);
    CHECK(sky(0.5).pixels == sky(0.5).pixels);
}

TEST_CASE("grain is of earth or of stone", "[render][material]") {
    const auto picture = [](double grain, GrainKind kind) {
        Model model = wall({}, {});
        model.grain = grain;
        model.grainOf = kind;
        Scene scene = sceneOf({model});
        scene.camera.eye = {0, 0, 0.5};
        return show(scene).image;
    };
    const Image plain = picture(0, GrainKind::earth);
    CHECK(picture(0, GrainKind::stone).pixels == plain.pixels);
    const Image earth = picture(1, GrainKind::earth), stone = picture(1, GrainKind::stone);
    CHECK(changed(plain, earth, 3).count > 500);
    CHECK(changed(plain, stone, 3).count > 500);
    CHECK(changed(earth, stone, 3).count > 500);
}

// A CPU rasteriser leaves out the back of what is closed. The triangle that opens it is never in sight.
TEST_CASE("a closed model is seen from outside and from inside", "[render][material]") {
    for (const double eye : {3.0, 0.2}) {
        Image images[2];
        for (const bool open : {false, true}) {
            Model box;
            box.name = "box";
            addBox(box.mesh, {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
            if (open)
                addTriangles(box.mesh, "flap", {{0, 0, 0.45}, {0.1, 0, 0.45}, {0, 0.1, 0.45}}, {{0, 1, 2}});
            completeMesh(box.mesh);
            Scene scene = sceneOf({box});
            scene.camera.eye = {0, 0, eye};
            scene.camera.target = {0, 0, -1};
            images[open] = show(scene).image;
            scene.models.clear();
            scene.colliders.clear();
            CAPTURE(eye, open);
            CHECK(changed(images[open], show(scene).image, 30).count > 1500);
        }
        CHECK(changed(images[0], images[1], 2).count <= 2);
    }
}
