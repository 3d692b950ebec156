// The materials of others' models: what is read, how it is found, and that what is not drawn is told.
#include <cstdlib>
#include <filesystem>

#include "core/image.h"
#include "geometry/mesh.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Alpha = SurfaceMaterial::Alpha;

namespace {

constexpr const char* quad =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl paint\nf 1/1 2/2 3/3 4/4\n";

Image plain(int width, int height, std::initializer_list<uint8_t> texel) {
    Image image{width, height, 4, {}};
    for (int i = 0; i < width * height; ++i)
        image.pixels.insert(image.pixels.end(), texel);
    return image;
}

// A quad of a material with these lines.
Mesh withMaterial(const Scratch& scratch, const std::string& lines) {
    scratch.write("m.mtl", "newmtl paint\n" + lines);
    return loadMesh(scratch.write("m.obj", quad));
}

const SurfaceMaterial& materialOf(const Mesh& mesh) {
    REQUIRE(mesh.parts.size() == 1);
    REQUIRE(mesh.parts[0].look >= 0);
    return mesh.materials[size_t(mesh.parts[0].look)];
}

std::string notesOf(const Mesh& mesh) {
    std::string out;
    for (const std::string& note : mesh.notes)
        out += note + "\n";
    return out;
}

// A BMP of 24 bits, one blue texel.
std::string blueBmp() {
    std::string out = "BM";
    const auto number = [&](uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            out += char(value >> (8 * i) & 255);
    };
    for (const uint32_t value : {58u, 0u, 54u, 40u, 1u, 1u})
        number(value, 4);
    number(1, 2), number(24, 2);
    for (const uint32_t value : {0u, 4u, 2835u, 2835u, 0u, 0u})
        number(value, 4);
    return out + std::string("\xff\0\0\0", 4);
}

// A TGA without compression, one green texel.
std::string greenTga() {
    std::string out(18, '\0');
    out[2] = 2, out[12] = 1, out[14] = 1, out[16] = 24;
    return out + std::string("\0\xff\0", 3);
}

}  // namespace

TEST_CASE("a material's numbers become those of a metallic and rough surface", "[model][material]") {
    const Scratch scratch;
    const Mesh mesh = withMaterial(scratch, "Kd 0.2 0.4 0.6\nKe 1 2 3\nNs 30\nd 0.25\n");
    const SurfaceMaterial& m = materialOf(mesh);
    CHECK(glm::distance(m.color, glm::dvec4(0.2, 0.4, 0.6, 0.25)) < 1e-6);
    CHECK(glm::distance(m.emissive, glm::dvec3(1, 2, 3)) < 1e-6);
    CHECK(m.roughness == Approx(0.5));  // 2 / 32 is its fourth power
    CHECK(m.metallic == 0);
    CHECK(m.alpha == Alpha::blend);
    CHECK(m.colorImage == -1);
    CHECK(mesh.notes.empty());
}

TEST_CASE("what is blended refracts by its index, what is opaque does not", "[model][material]") {
    const Scratch scratch;
    const auto index = [&](const std::string& lines) {
        return materialOf(withMaterial(scratch, lines)).refraction;
    };
    CHECK(index("d 0.1\nNi 1.5\n") == Approx(1.5));
    CHECK(index("d 1\nNi 1.5\n") == 1);
    CHECK(index("d 0.1\n") == 1);
    for (const char* wrong : {"0.5", "-2", "40", "nan", "1e39"})
        CHECK(index(concat("d 0.1\nNi ", wrong, "\n")) == 1);
}

TEST_CASE("a model without materials has none, whatever the reader puts in", "[model][material]") {
    const Scratch scratch;
    const Mesh obj = loadMesh(scratch.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"));
    REQUIRE(obj.parts.size() == 1);
    CHECK(obj.parts[0].look == -1);
    CHECK(obj.materials.empty());
    CHECK(obj.notes.empty());
    const Mesh stl = loadMesh(
        scratch.write("m.stl",
                      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n"
                      "endloop\nendfacet\nendsolid a\n"));
    CHECK(materialOf(stl).color == glm::dvec4(1));
    CHECK(materialOf(stl).roughness == 0.9);
    CHECK(stl.notes.empty());
}

TEST_CASE("images are found by the name that another machine gave them", "[model][material]") {
    const Scratch scratch;
    std::filesystem::create_directory(scratch.path("textures"));
    const Image red = plain(4, 4, {255, 0, 0, 255});
    for (const auto& [written, lies] :
         {std::pair("skin.png", "skin.png"), std::pair("C:\\\\work\\\\art\\\\skin.png", "skin.png"),
          std::pair("/home/artist/skin.png", "skin.png"), std::pair("SKIN.PNG", "skin.png"),
          std::pair("maps/skin.png", "textures/skin.png"), std::pair("Skin.png", "textures/skin.png")}) {
        INFO(written << " for " << lies);
        writePng(scratch.path(lies), red);
        const Mesh mesh = withMaterial(scratch, concat("map_Kd ", written, "\n"));
        std::filesystem::remove(scratch.path(lies));
        CHECK(notesOf(mesh) == "");
        REQUIRE(materialOf(mesh).colorImage == 0);
        CHECK(mesh.images[0].pixels == red.pixels);
        CHECK(materialOf(mesh).alpha == Alpha::opaque);
    }
    const Mesh mesh = withMaterial(scratch, "map_Kd skin.png\n");
    CHECK(materialOf(mesh).colorImage == -1);
    CHECK(notesOf(mesh) ==
          "material \"paint\": its colour image is left out: there is no \"skin.png\" beside the "
          "model\n");
}

TEST_CASE("images of other formats than PNG are read, and damaged ones told", "[model][material]") {
    const Scratch scratch;
    scratch.write("blue.bmp", blueBmp());
    scratch.write("green.tga", greenTga());
    const auto texel = [&](const char* name) {
        const Mesh mesh = withMaterial(scratch, concat("map_Kd ", name, "\n"));
        CHECK(notesOf(mesh) == "");
        REQUIRE(mesh.images.size() == 1);
        return std::vector<int>(mesh.images[0].pixels.begin(), mesh.images[0].pixels.end());
    };
    CHECK(texel("blue.bmp") == std::vector<int>{0, 0, 255, 255});
    CHECK(texel("green.tga") == std::vector<int>{0, 255, 0, 255});
    scratch.write("none.jpg", "no picture");
    CHECK_THAT(notesOf(withMaterial(scratch, "map_Kd none.jpg\n")),
               Catch::Contains("none.jpg") && Catch::Contains("is no picture that can be read"));
    writePng(scratch.path("cut.png"), plain(4, 4, {9, 9, 9, 255}));
    scratch.write("cut.png", readFile(scratch.path("cut.png")).substr(0, 40));
    const Mesh cut = withMaterial(scratch, "map_Kd cut.png\n");
    CHECK_THAT(notesOf(cut), Catch::Contains("cut.png"));
    CHECK(materialOf(cut).colorImage == -1);
}

TEST_CASE("an image with holes cuts, one beside the colour becomes its alpha, and large ones shrink",
          "[model][material]") {
    const Scratch scratch;
    writePng(scratch.path("holes.png"), plain(4, 4, {9, 9, 9, 0}));
    CHECK(materialOf(withMaterial(scratch, "map_Kd holes.png\n")).alpha == Alpha::cut);

    Image mask = plain(2, 1, {255, 255, 255, 255});
    mask.pixels = {0, 0, 0, 255, 255, 255, 255, 255};
    writePng(scratch.path("mask.png"), mask);
    writePng(scratch.path("red.png"), plain(1, 1, {255, 0, 0, 255}));
    const Mesh mesh = withMaterial(scratch, "map_Kd red.png\nmap_d mask.png\n");
    CHECK(materialOf(mesh).alpha == Alpha::cut);
    const Image& image = mesh.images[size_t(materialOf(mesh).colorImage)];
    CHECK(image.pixels == std::vector<uint8_t>{255, 0, 0, 0, 255, 0, 0, 255});

    Image large = plain(largestModelImage + 2, 2, {0, 0, 0, 255});
    for (size_t i = 0; i < large.pixels.size(); i += 8)
        large.pixels[i] = 200;  // every other column
    writePng(scratch.path("large.png"), large);
    const Mesh small = withMaterial(scratch, "map_Kd large.png\n");
    REQUIRE(small.images.size() == 1);
    CHECK(small.images[0].width == largestModelImage / 2 + 1);
    CHECK(small.images[0].height == 1);
    CHECK(small.images[0].pixels[0] == 100);
}

TEST_CASE("the largest image that is read fits what its model may take, however well it is packed",
          "[model][material][confined]") {
    const Scratch scratch;
    writePng(scratch.path("large.png"), plain(8192, 8192, {0, 0, 255, 255}));
    const Mesh mesh = withMaterial(scratch, "map_Kd large.png\n");
    CHECK(notesOf(mesh) == "");
    REQUIRE(mesh.images.size() == 1);
    CHECK(mesh.images[0].width == largestModelImage);
    CHECK(mesh.images[0].pixels[2] == 255);
}

TEST_CASE("what is to be blended and hides all that is behind it is opaque", "[model][material]") {
    const Scratch scratch;
    writePng(scratch.path("whole.png"), plain(1, 1, {255, 0, 0, 255}));
    writePng(scratch.path("holes.png"), plain(1, 1, {255, 0, 0, 254}));
    // Three vertices of 12 bytes: (0, 0, 0), (1, 0, 0), (0, 1, 0).
    const auto alphaOf = [&](const std::string& pbr) {
        return materialOf(loadMesh(scratch.write("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
            "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
            "images": [{"uri": "whole.png"}, {"uri": "holes.png"}], "textures": [{"source": 0}, {"source": 1}],
            "materials": [{"name": "paint", "alphaMode": "BLEND", "pbrMetallicRoughness": {)" +
                                                               pbr + R"(}}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri":
                "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})")))
            .alpha;
    };
    CHECK(alphaOf(R"("baseColorFactor": [1, 1, 1, 1])") == Alpha::opaque);
    CHECK(alphaOf(R"("baseColorFactor": [1, 1, 1, 0.5])") == Alpha::blend);
    CHECK(alphaOf(R"("baseColorTexture": {"index": 0})") == Alpha::opaque);
    CHECK(alphaOf(R"("baseColorTexture": {"index": 1})") == Alpha::blend);
}

TEST_CASE("what of a material is not drawn is told", "[model][material]") {
    const Scratch scratch;
    writePng(scratch.path("grey.png"), plain(1, 1, {128, 128, 128, 255}));
    CHECK(notesOf(withMaterial(scratch, "map_Ks grey.png\nmap_bump grey.png\n")) ==
          "material \"paint\": its images of bumps, specular are not drawn\n");
    const Mesh gone = withMaterial(scratch, "d 0\n");
    CHECK(notesOf(gone) == "material \"paint\": it is wholly transparent in the file, and drawn opaque\n");
    CHECK(materialOf(gone).alpha == Alpha::opaque);
    CHECK(materialOf(gone).color.a == 1);
}

TEST_CASE("materials are the same from a child as from this process", "[model][material][confined]") {
    const Scratch scratch;
    writePng(scratch.path("red.png"), plain(3, 2, {255, 0, 0, 99}));
    const auto read = [&] {
        return withMaterial(scratch,
                            "Kd 1 0.5 0.25\nNs 30\nmap_Kd red.png\nmap_Ke red.png\nmap_Ks red.png\n");
    };
    const Mesh confined = read();
    setenv("SHOAL_TRUST_MODELS", "1", 1);
    const Mesh trusted = read();
    unsetenv("SHOAL_TRUST_MODELS");
    CHECK(confined.notes == trusted.notes);
    CHECK(confined.notes.size() == 1);
    REQUIRE(confined.images.size() == 1);
    CHECK(confined.images[0].pixels == trusted.images[0].pixels);
    const SurfaceMaterial &a = materialOf(confined), &b = materialOf(trusted);
    CHECK(a.color == b.color);
    CHECK(a.roughness == b.roughness);
    CHECK(a.colorImage == b.colorImage);
    CHECK(a.emissiveImage == 0);
    CHECK(b.emissiveImage == 0);
    CHECK(a.alpha == b.alpha);
}
