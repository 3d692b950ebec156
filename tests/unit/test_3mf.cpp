// 3MF packages: units, build items, components, colours, materials and images, and what is refused.
#include <cstring>

#include <zlib.h>

#include "core/image.h"
#include "geometry/mesh.h"
#include "support/catch.h"
#include "support/model_text.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

// A zip of entries as they are.
class Zip {
  public:
    void add(const std::string& name, const std::string& bytes) {
        const auto crc =
            uint32_t(::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), uInt(bytes.size())));
        std::string common;
        number(common, 20, 2), number(common, 0, 8);  // version; flags, method, time and date
        number(common, crc, 4), number(common, bytes.size(), 4), number(common, bytes.size(), 4);
        number(common, name.size(), 2), number(common, 0, 2);
        central_ += "PK\1\2" + std::string("\x14\0", 2) + common;
        number(central_, 0, 10);
        number(central_, entries_.size(), 4);
        central_ += name;
        entries_ += "PK\3\4" + common + name + bytes;
        ++count_;
    }
    std::string whole() const {
        std::string out = entries_ + central_ + "PK\5\6";
        number(out, 0, 4), number(out, count_, 2), number(out, count_, 2);
        number(out, central_.size(), 4), number(out, entries_.size(), 4), number(out, 0, 2);
        return out;
    }

  private:
    static void number(std::string& out, uint64_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            out += i < 8 ? char(value >> (8 * i) & 255) : '\0';
    }
    std::string entries_, central_;
    size_t count_ = 0;
};

constexpr const char* tetrahedron =
    R"(<vertices><vertex x="0" y="0" z="0"/><vertex x="10" y="0" z="0"/><vertex x="0" y="20" z="0"/>)"
    R"(<vertex x="0" y="0" z="30"/></vertices>)";
constexpr const char* faces =
    R"(<triangles><triangle v1="0" v2="2" v3="1"/><triangle v1="0" v2="1" v3="3"/>)"
    R"(<triangle v1="0" v2="3" v3="2"/><triangle v1="1" v2="2" v3="3"/></triangles>)";

std::string part(const std::string& resources, const std::string& build, const char* unit = "millimeter") {
    return concat("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"", unit,
                  "\" xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\""
                  " xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\""
                  " xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\""
                  " xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"><resources>",
                  resources, "</resources><build>", build, "</build></model>");
}

std::string package(const std::string& model, const std::string& name = {}, const std::string& bytes = {},
                    const char* kind = "") {
    const std::string relationships =
        "<?xml version=\"1.0\"?><Relationships "
        "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r\" "
        "Target=\"";
    Zip zip;
    zip.add(
        "[Content_Types].xml",
        "<?xml version=\"1.0\"?><Types "
        "xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\"><Default Extension=\"rels\" "
        "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/><Default "
        "Extension=\"model\" ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>"
        "<Default Extension=\"png\" ContentType=\"image/png\"/></Types>");
    zip.add("_rels/.rels",
            relationships +
                "/3D/3dmodel.model\" "
                "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>");
    zip.add("3D/3dmodel.model", model);
    if (!name.empty()) {
        zip.add("3D/_rels/3dmodel.model.rels",
                relationships + "/" + name +
                    "\" Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/" + kind +
                    "\"/></Relationships>");
        zip.add(name, bytes);
    }
    return zip.whole();
}

std::string object(const std::string& attributes, const std::string& triangles = faces) {
    return concat("<object ", attributes, " type=\"model\"><mesh>", tetrahedron, triangles,
                  "</mesh></object>");
}

Mesh read(const std::string& bytes) {
    return modelOf("m.3mf", bytes);
}

void close(const glm::dvec3& a, const glm::dvec3& b) {
    INFO(concat("(", a.x, ", ", a.y, ", ", a.z, ")"));
    CHECK(glm::distance(a, b) <= 1e-6 * (1 + glm::length(b)));
}

}  // namespace

TEST_CASE("3MF: lengths are metres, whatever the unit", "[3mf][model]") {
    for (const auto& [unit, metres] :
         {std::pair("micron", 1e-6), std::pair("millimeter", 1e-3), std::pair("centimeter", 1e-2),
          std::pair("inch", 0.0254), std::pair("foot", 0.3048), std::pair("meter", 1.0)}) {
        INFO(unit);
        const Mesh mesh =
            read(package(part(object("id=\"1\" name=\"tip\""), "<item objectid=\"1\"/>", unit)));
        CHECK(mesh.triangles.size() == 4);
        CHECK(glm::distance(mesh.high, glm::dvec3(10, 20, 30) * metres) < 1e-6 * metres);
        REQUIRE(mesh.objects.size() == 1);
        CHECK(mesh.objects[0].name == "tip");
        CHECK(examineSurface(mesh).closed());
        CHECK(examineSurface(mesh).volume > 0);
        CHECK(mesh.notes.empty());
    }
}

TEST_CASE("3MF: items of the build and components lie where their transforms say", "[3mf][model]") {
    const std::string resources =
        object("id=\"1\" name=\"tip\"") + object("id=\"2\" name=\"unused\"") +
        "<object id=\"3\" name=\"pair\" type=\"model\"><components><component objectid=\"1\"/>"
        "<component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 100 0 0\"/></components></object>"
        "<object id=\"4\" type=\"model\"><components><component objectid=\"3\"/></components></object>";
    const Mesh mesh = read(
        package(part(resources,
                     "<item objectid=\"1\" transform=\"-2 0 0 0 2 0 0 0 2 0 0 1000\"/><item objectid=\"4\" "
                     "transform=\"1 0 0 0 1 0 0 0 1 0 500 0\"/>")));
    REQUIRE(mesh.objects.size() == 3);
    for (const Mesh::Object& placed : mesh.objects) {
        CHECK(placed.name == "tip");
        CHECK(placed.triangleCount == 4);
    }
    // the second corner of each, (10, 0, 0) mm
    close(mesh.positions[1], {-0.02, 0, 1});
    close(mesh.positions[5], {0.01, 0.5, 0});
    close(mesh.positions[9], {0.1, 0.51, 0});
    CHECK(examineSurface(mesh).volume == Approx(1e-6 * (8 + 1 + 1)));  // the mirrored one faces out as well
}

TEST_CASE("3MF: an object of another part of the package, as slicers write it", "[3mf][model]") {
    const Mesh mesh = read(package(
        part("<object id=\"2\" type=\"model\"><components><component p:path=\"/3D/Objects/one.model\" "
             "objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 0 0\"/></components></object>",
             "<item objectid=\"2\"/>"),
        "3D/Objects/one.model", part(object("id=\"1\""), ""), "3dmodel"));
    REQUIRE(mesh.triangles.size() == 4);
    close(mesh.low, {0.005, 0, 0});
}

TEST_CASE("3MF: materials, colours of corners and images", "[3mf][model][material]") {
    const std::string materials =
        "<basematerials id=\"7\"><base name=\"clay\" displaycolor=\"#FF0000\"/>"
        "<base name=\"glass\" displaycolor=\"#00BC0080\"/></basematerials>";
    const Mesh based = read(package(part(
        materials + object("id=\"1\" pid=\"7\" pindex=\"0\"",
                           "<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" "
                           "v3=\"3\" pid=\"7\" p1=\"1\"/></triangles>"),
        "<item objectid=\"1\"/>")));
    REQUIRE(based.parts.size() == 2);
    CHECK(based.parts[0].material == "clay");
    CHECK(based.materials[size_t(based.parts[0].look)].color == glm::dvec4(1, 0, 0, 1));
    const SurfaceMaterial& glass = based.materials[size_t(based.parts[1].look)];
    CHECK(glass.alpha == SurfaceMaterial::Alpha::blend);
    CHECK(glass.color.y == Approx(0.5028865));
    CHECK(glass.color.a == Approx(128 / 255.0));

    const Mesh colored = read(package(part(
        "<m:colorgroup id=\"8\"><m:color color=\"#0000FF\"/><m:color color=\"#00FF00\"/></m:colorgroup>" +
            object("id=\"1\" pid=\"8\" pindex=\"0\"",
                   "<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/><triangle v1=\"0\" v2=\"1\" v3=\"3\" "
                   "pid=\"8\" p1=\"0\" p2=\"1\" p3=\"1\"/></triangles>"),
        "<item objectid=\"1\"/>")));
    REQUIRE(colored.triangles.size() == 2);
    const auto color = [&](size_t t, int i) { return colored.colors.at(size_t(colored.triangles[t][i])); };
    CHECK(color(0, 2) == glm::dvec3(0, 0, 1));
    CHECK(color(1, 0) == glm::dvec3(0, 0, 1));
    CHECK(color(1, 1) == glm::dvec3(0, 1, 0));

    const std::vector<std::byte> png = encodePng({1, 1, 4, {255, 0, 0, 255}});
    const std::string image(reinterpret_cast<const char*>(png.data()), png.size());
    const Mesh textured = read(package(
        part("<m:texture2d id=\"5\" path=\"/3D/Textures/red.png\" contenttype=\"image/png\"/>"
             "<m:texture2dgroup id=\"6\" texid=\"5\"><m:tex2coord u=\"0\" v=\"0.5\"/><m:tex2coord u=\"1\" "
             "v=\"0.25\"/></m:texture2dgroup>" +
                 object("id=\"1\"",
                        "<triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\" pid=\"6\" p1=\"0\" p2=\"1\" "
                        "p3=\"0\"/></triangles>"),
             "<item objectid=\"1\"/>"),
        "3D/Textures/red.png", image, "3dtexture"));
    CHECK(textured.notes.empty());
    REQUIRE(textured.parts.size() == 1);
    REQUIRE(textured.images.size() == 1);
    CHECK(textured.materials[size_t(textured.parts[0].look)].colorImage == 0);
    CHECK(textured.uvs[size_t(textured.triangles[0].y)] == glm::dvec2(1, 0.25));
}

TEST_CASE("3MF: what is not read is told or refused", "[3mf][model]") {
    const auto refusal = [](const std::string& bytes) { return refusalOf("m.3mf", bytes); };
    const std::string good = package(part(object("id=\"1\""), "<item objectid=\"1\"/>"));
    CHECK_THAT(refusal("PK no zip"), Contains("cannot be read as 3MF: "));
    for (size_t length = 0; length < good.size(); length += 97)
        CHECK_THAT(refusal(good.substr(0, length)), Contains("cannot be read"));
    CHECK_THAT(refusal(package(part(object("id=\"1\""), "<item objectid=\"9\"/>"))), Contains("Build item"));
    CHECK_THAT(refusal(package(
                   part(object("id=\"1\"", "<triangles><triangle v1=\"0\" v2=\"1\" v3=\"4\"/></triangles>"),
                        "<item objectid=\"1\"/>"))),
               Contains("cannot be read as 3MF: "));
    CHECK_THAT(refusal(package(part(object("id=\"1\""), ""))), Contains("its build places nothing"));

    const std::string beams = package(part(
        "<object id=\"1\" type=\"model\"><mesh>" + std::string(tetrahedron) + faces +
            "<b:beamlattice radius=\"1\" minlength=\"0.1\"><b:beams><b:beam v1=\"0\" v2=\"1\"/></b:beams>"
            "</b:beamlattice></mesh></object>",
        "<item objectid=\"1\"/>"));
    CHECK_THAT(refusal(beams), Contains("the beams of a lattice are not read, 1 of them"));
    CHECK(modelOf("m.3mf", beams, true).triangles.size() == 4);
}
