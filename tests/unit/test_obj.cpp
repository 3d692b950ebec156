// OBJ and MTL: what is read as the file has it, and what is told or refused.
#include <algorithm>

#include "author/from_mesh.h"
#include "core/image.h"
#include "geometry/mesh.h"
#include "geometry/polygon.h"
#include "support/catch.h"
#include "support/model_text.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

Mesh read(const std::string& text) {
    return modelOf("m.obj", text);
}

std::string refused(const std::string& text) {
    return refusalOf("m.obj", text);
}

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const glm::ivec3& t : mesh.triangles) {
        const glm::dvec3& a = mesh.positions[size_t(t.x)];
        area += glm::length(glm::cross(mesh.positions[size_t(t.y)] - a, mesh.positions[size_t(t.z)] - a)) / 2;
    }
    return area;
}

}  // namespace

TEST_CASE("numbers of an OBJ are read as it writes them", "[model][obj]") {
    // A vertex that no face has shows whether the numbers of vertices shift.
    const Mesh dots = read(
        "v 0 0 0\nv .5 -.0 +.0e1\nv 0 1. 0\nv 0 0 1E0\nv 9 9 9\n"
        "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    CHECK(dots.low == glm::dvec3(0));
    CHECK(dots.high == glm::dvec3(0.5, 1, 1));
    CHECK(examineSurface(dots).volume == Approx(0.5 / 6));

    const Mesh far = read(
        "v 500000.125 6500000.0625 3\nv 500000.25 6500000.0625 3\nv 500000.125 6500000.125 3\n"
        "f 1 2 3\n");
    CHECK(far.weldedPositions.size() == 3);
    CHECK(glm::distance(far.high - far.low, glm::dvec3(0.125, 0.0625, 0)) < 1e-8);
}

TEST_CASE("continued lines, comments, returns and marks are read", "[model][obj]") {
    const Mesh mesh =
        read("\xef\xbb\xbf# head\r\nv 0 0 \\\r\n0 # the first\r\nv 1 0 0\r\n\r\n\tv 0 1 0\r\nf 1 \\\n2 3");
    CHECK(mesh.triangles.size() == 1);
    CHECK(mesh.high == glm::dvec3(1, 1, 0));
    CHECK(mesh.notes.empty());
}

TEST_CASE("a line of an OBJ that cannot be read is refused where it stands", "[model][obj]") {
    const std::pair<const char*, const char*> cases[] = {
        {"v 0 0 0\nv 1 0\nf 1 1 1\n", "m.obj: line 2: expected three numbers behind \"v\""},
        {"v 0 0 0\nv 1,5 0 0\n", "m.obj: line 2: expected three numbers behind \"v\""},
        {"v 0 0 0\nv 1e400 0 0\n", "m.obj: line 2: a vertex is not finite"},
        {"v 0 0 0\n\nv 1e31 0 0\n", "m.obj: line 3: a vertex lies beyond 1e+30"},
        {"v 0 0 0\nvt x\n", "m.obj: line 2: expected a number behind \"vt\""},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "m.obj: line 4: a face has vertex 4, of 3 before it"},
        {"v 0 0 0\nf -1 -1 -2\n", "m.obj: line 2: a face has vertex -2, of 1 before it"},
        {"v 0 0 0\nf 1/1 1/1 1/1\n", "m.obj: line 2: a face has texture coordinates 1, of 0 before it"},
        {"v 0 0 0\nf 1//1 1//1 1//1\n", "m.obj: line 2: a face has normal 1, of 0 before it"},
        {"v 0 0 0\nf 1 0 1\n", "m.obj: line 2: a face has the corner \"0\""},
        {"v 0 0 0\nf 1 one 1\n", "m.obj: line 2: a face has the corner \"one\""},
        {"v 0 0 0\nf 1/2/3/4 1 1\n", "m.obj: line 2: a face has the corner \"1/2/3/4\""},
        {"surf 0 1 0 1\n", "m.obj: has no triangles"},
        {"", "m.obj: has no triangles"},
    };
    for (const auto& [text, said] : cases) {
        INFO(text);
        CHECK_THAT(refused(text), Catch::Contains(said));
    }
}

TEST_CASE("what is left out of an OBJ is told, and a loss where it is a shape", "[model][obj]") {
    CHECK(read(tetrahedron + "s off\nlod 1\nbevel on\n").notes.empty());
    const Mesh mesh = read(tetrahedron + "l 1 2\nl 2 3\np 1\nf 1 2\nspin 3\n");
    CHECK(mesh.triangles.size() == 4);
    CHECK(mesh.notes ==
          std::vector<std::string>{
              "1 face of fewer than three corners is left out",
              "2 lines begin with \"l\", which is not read: only triangles and polygons are read",
              "1 line begins with \"p\", which is not read: only triangles and polygons are read",
              "1 line begins with \"spin\", which is not read: only triangles and polygons are read"});
    const Scratch scratch;
    const std::string curved = scratch.write("m.obj", tetrahedron + "surf 0 1 0 1 1 2 3 4\n");
    CHECK_THAT(messageOf([&] { loadMesh(curved); }),
               Catch::Contains("m.obj: 1 line begins with \"surf\", which is not read"));
    CHECK(loadMesh(curved, true).notes.size() == 1);
}

TEST_CASE("objects and parts of an OBJ are its names with their blanks", "[model][obj]") {
    const Scratch scratch;
    scratch.write("two parts.mtl", "newmtl red paint\nKd 1 0 0\n\nnewmtl blue\nKd 0 0 1\n");
    const Mesh mesh = loadMesh(scratch.write("m.obj", R"(mtllib two parts.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
o the left wing
usemtl red paint
f 1 2 3
usemtl blue
f 1 2 4
g tail fin
f 1 3 4
o the left wing
usemtl red paint
f -1 -2 -3
)"));
    REQUIRE(mesh.objects.size() == 2);
    CHECK(mesh.objects[0].name == "the left wing");
    CHECK(mesh.objects[0].triangleCount == 3);
    CHECK(mesh.objects[1].name == "tail fin");
    CHECK(mesh.objects[1].firstTriangle == 3);
    REQUIRE(mesh.parts.size() == 3);
    CHECK(mesh.parts[0].material == "red paint");
    CHECK(mesh.parts[0].triangleCount == 2);
    CHECK(mesh.parts[1].material == "blue");
    CHECK(mesh.parts[2].mesh == "tail fin");
    CHECK(mesh.materials[size_t(mesh.parts[0].look)].color == glm::dvec4(1, 0, 0, 1));
    CHECK(mesh.materials[size_t(mesh.parts[2].look)].color == glm::dvec4(0, 0, 1, 1));
    CHECK(mesh.notes.empty());
}

TEST_CASE("faces without normals are flat, smooth within their group", "[model][obj]") {
    const std::string roof = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 1\nv 1 2 0\nv 0 2 0\n";
    const std::string faces = "f 1 2 3 4\nf 4 3 5 6\n";
    const auto ridge = [](const Mesh& mesh) {  // the normals where y is 1
        std::vector<double> up;
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            if (mesh.positions[i].y == 1) up.push_back(mesh.normals[i].z);
        return up;
    };
    for (const double z : ridge(read(roof + faces)))
        CHECK(z == Approx(std::sqrt(0.5)));
    for (const double z : ridge(read(roof + "s 1\n" + faces)))
        CHECK(z == Approx(1));
    for (const double z : ridge(read(roof + "s 1\nf 1 2 3 4\ns 2\nf 4 3 5 6\n")))
        CHECK(z == Approx(std::sqrt(0.5)));
    CHECK(ridge(read(roof + "s 1\n" + faces)).size() == 2);
    CHECK(ridge(read(roof + faces)).size() == 4);
}

TEST_CASE("polygons are cut within their outline", "[model][obj]") {
    struct Case {
        const char* name;
        std::vector<glm::dvec3> corners;
        double area;
    };
    std::vector<glm::dvec3> star, disc;
    for (int i = 0; i < 10; ++i) {
        const double a = 0.2 * i * std::acos(-1.0), r = i % 2 ? 0.4 : 1;
        star.emplace_back(r * std::cos(a), 5, -r * std::sin(a));
    }
    for (int i = 0; i < 300; ++i) {
        const double a = i * std::acos(-1.0) / 150;
        disc.emplace_back(6.5e6 + std::cos(a), std::sin(a), 0);
    }
    const double point = 0.4 * std::sin(0.2 * std::acos(-1.0));  // half the width of a ray
    const Case cases[] = {
        {"a dart", {{0, 0, 0}, {1, 0.2, 0}, {2, 0, 0}, {1, 2, 0}}, 1.8},
        {"a dart that begins at its notch", {{1, 0.2, 0}, {2, 0, 0}, {1, 2, 0}, {0, 0, 0}}, 1.8},
        {"an L", {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, 3},
        {"corners on a line", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, 2},
        {"a star that looks up", star, 10 * 0.5 * point},
        {"a disc of more corners than a byte counts, far away", disc, 150 * std::sin(std::acos(-1.0) / 150)},
    };
    for (const Case& one : cases) {
        INFO(one.name);
        std::string text, face = "f";
        for (size_t i = 0; i < one.corners.size(); ++i) {
            text += formatted("v %.12g %.12g %.12g\n", one.corners[i].x, one.corners[i].y, one.corners[i].z);
            face += concat(" ", i + 1);
        }
        const Mesh mesh = read(text + face + "\n");
        CHECK(mesh.triangles.size() == one.corners.size() - 2);
        CHECK(areaOf(mesh) == Approx(one.area).epsilon(1e-6));  // more where triangles lie on one another
        const glm::dvec3 front = mesh.weldedNormals[0];
        for (const glm::dvec3& normal : mesh.normals)
            CHECK(glm::dot(normal, front) == Approx(1));
    }
    const std::vector<glm::ivec3> fan = cutPolygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    CHECK(fan == std::vector<glm::ivec3>{{0, 1, 2}, {0, 2, 3}});
    CHECK(cutPolygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 2);  // crosses itself
    CHECK(cutPolygon({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}).size() == 2);
}

TEST_CASE("a large polygon is cut in time", "[model][obj]") {
    std::vector<glm::dvec3> disc;
    for (int i = 0; i < 20000; ++i)
        disc.emplace_back(std::cos(i * 3.14159265e-4), std::sin(i * 3.14159265e-4), 0);
    CHECK(cutPolygon(disc).size() == 19998);
}

TEST_CASE("the keys of MTL's rough and metallic surfaces are read", "[model][obj][material]") {
    const Scratch scratch;
    writePng(scratch.path("rough.png"), {1, 1, 4, {10, 20, 30, 255}});
    writePng(scratch.path("metal.png"), {1, 1, 4, {40, 50, 60, 255}});
    const auto material = [&](const std::string& lines, std::vector<std::string>& notes,
                              Mesh* out = nullptr) {
        scratch.write("m.mtl", "newmtl tile\n" + lines);
        const Mesh mesh = loadMesh(scratch.write("m.obj", "mtllib m.mtl\nusemtl tile\n" + tetrahedron));
        notes = mesh.notes;
        if (out) *out = mesh;
        REQUIRE(mesh.materials.size() == 1);
        return mesh.materials[0];
    };
    std::vector<std::string> notes;
    SurfaceMaterial m =
        material("Kd .8 .2 .1\nPr 0.5\nPm 0.1\nPs 0.1\nPc 0.2\naniso 0\nanisor 0\nNs 10\n", notes);
    CHECK(notes.empty());
    CHECK(glm::distance(m.color, glm::dvec4(0.8, 0.2, 0.1, 1)) < 1e-12);
    CHECK(m.roughness == Approx(0.5));
    CHECK(m.metallic == Approx(0.1));
    CHECK(material("Pr 0\n", notes).roughness == 0);  // a mirror, not a key that is left out
    CHECK(material("illum 2\n", notes).roughness == 0.9);
    CHECK(material("Tr 0.75\n", notes).color.a == Approx(0.25));
    CHECK(material("illum 2\n", notes).color == glm::dvec4(1));

    Mesh mesh;
    m = material("map_Pr rough.png\nmap_Pm metal.png\nnorm -bm 2 rough.png\n", notes, &mesh);
    CHECK(notes.empty());
    CHECK(m.roughness == 1);
    CHECK(m.metallic == 1);
    CHECK(m.normalScale == 2);
    REQUIRE(m.roughnessImage >= 0);
    const std::vector<uint8_t>& texel = mesh.images[size_t(m.roughnessImage)].pixels;
    CHECK(int(texel[1]) == 20);
    CHECK(int(texel[2]) == 50);
    REQUIRE(m.normalImage >= 0);
    CHECK(int(mesh.images[size_t(m.normalImage)].pixels[2]) == 30);
    m = material("Pm 0.5\nmap_Pr rough.png\n", notes, &mesh);
    CHECK(int(mesh.images[size_t(m.roughnessImage)].pixels[2]) == 255);  // as metallic as Pm says

    material("Kd red green blue\nmap_Kd -s 2 2 rough.png\nmap_opal x.png\n", notes);
    CHECK(notes ==
          std::vector<std::string>{"material \"tile\": its colour image is left out: its line names no file",
                                   "material \"tile\": its images of \"map_opal\" are not drawn",
                                   "material \"tile\": its \"Kd\" is no number, and left out"});
}

TEST_CASE("texture coordinates are moved as the material's first image asks", "[model][obj][material]") {
    const Scratch scratch;
    writePng(scratch.path("a b.png"), {1, 1, 4, {1, 2, 3, 255}});
    scratch.write("m.mtl", "newmtl tile\nmap_Kd -o 0.5 0.25 0 -s 2 4 1 a b.png\nmap_Ke a b.png\n");
    const Mesh mesh = loadMesh(scratch.write(
        "m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl tile\nf 1/1 2/2 3/3\n"));
    CHECK(mesh.uvs == std::vector<glm::dvec2>{{0.5, 0.25}, {2.5, 0.25}, {0.5, 4.25}});
    CHECK(mesh.notes == std::vector<std::string>{"material \"tile\": its emissive image lies where its first "
                                                 "image does, not by its own -s and -o"});
}

TEST_CASE("materials that are not there are told", "[model][obj][material]") {
    const Scratch scratch;
    const auto notes = [&](const std::string& head) {
        return loadMesh(scratch.write("m.obj", head + tetrahedron)).notes;
    };
    CHECK(notes("usemtl tile\n").empty());  // the file names no materials' file
    CHECK(notes("mtllib other.mtl\n") ==
          std::vector<std::string>{
              "its materials are left out: there is no file \"other.mtl\" beside the model"});
    scratch.write("m.mtl", "newmtl tile\nKd 1 0 0\n");
    CHECK(notes("mtllib other.mtl\nusemtl tile\n").empty());  // renamed with the model
    CHECK(notes("mtllib C:\\art\\m.mtl\nusemtl tile\n").empty());
    CHECK(notes("mtllib m.mtl\nusemtl stone\n") ==
          std::vector<std::string>{"its files of materials hold no \"stone\""});
}

TEST_CASE("an OBJ of points is a cloud, XYZ as well", "[model][obj][cloud]") {
    const Mesh cloud = read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 2 0 0 0 1\nv 0 2 0 0 0 1\np 1 2 3 4\n");
    CHECK(cloud.triangles.empty());
    CHECK(cloud.weldedPositions.size() == 3);
    CHECK(cloud.high == glm::dvec3(1, 2, 0));
    CHECK(cloud.colors[1] == glm::dvec3(0, 1, 0));
    CHECK(cloud.weldedNormals[0] == glm::dvec3(0, 1, 0));
    CHECK(cloud.notes ==
          std::vector<std::string>{"it is a cloud of 4 points without triangles, of which nothing "
                                   "is drawn"});

    const Scratch scratch;
    const auto xyz = [&](const std::string& text) { return loadMesh(scratch.write("c.xyz", text)); };
    const Mesh plain = xyz("# cloud\n500000.125 6500000.0625 .5\n\n500000.25 6500000.0625 .5\r\n");
    CHECK(plain.high - plain.low == glm::dvec3(0.125, 0, 0));
    CHECK(plain.colors.empty());
    CHECK(xyz("0 0 0 1 0 0\n1 0 0 0 0 1\n").weldedNormals[0] == glm::dvec3(1, 0, 0));
    CHECK(xyz("0 0 0 255 0 0\n").colors[0] == glm::dvec3(1, 0, 0));
    CHECK_THAT(messageOf([&] { xyz("0 0 0\n1 0\n"); }),
               Catch::Contains("c.xyz: line 2: expected three numbers"));
    CHECK_THAT(messageOf([&] { xyz("2\nwater\nO 0 0 0\n"); }),
               Catch::Contains("c.xyz: line 1: expected three"));
    CHECK_THAT(messageOf([&] { xyz("0 0 inf\n"); }), Catch::Contains("c.xyz: line 1: a point is not finite"));
    CHECK_THAT(messageOf([&] { xyz(""); }), Catch::Contains("c.xyz: has no triangles"));
}

TEST_CASE("a format of single precision says what it loses far from the origin", "[model][obj]") {
    const Scratch scratch;
    const auto stl = [&](double x, double size) {
        return scratch.write(
            "m.stl", formatted("solid a\nfacet normal 0 0 1\nouter loop\nvertex %.9g 0 0\nvertex %.9g 0 0\n"
                               "vertex %.9g %.9g 0\nendloop\nendfacet\nendsolid a\n",
                               x, x + size, x, size));
    };
    CHECK(loadMesh(stl(0, 1)).notes.empty());
    CHECK(loadMesh(stl(10, 1)).notes.empty());
    const std::vector<std::string> notes = loadMesh(stl(1000, 1)).notes;
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::Contains("rounded by up to 5.96642e-05 m, of a size of 1.41421 m"));
    const std::string far = stl(6.5e6, 0.5);
    CHECK_THAT(messageOf([&] { loadMesh(far); }), Catch::Contains("m.stl: its coordinates reach 6.5e+06 m"));
    CHECK(loadMesh(far, true).notes.size() == 1);
}

TEST_CASE("a sheet at map coordinates is the molecule that it is at the origin", "[model][obj][from-mesh]") {
    const auto sheet = [](const glm::dvec3& at) {
        std::string text;
        for (int i = 0; i < 13; ++i)
            for (int j = 0; j < 13; ++j)
                text += formatted("v %.6f %.6f %.6f\n", at.x + i / 60.0, at.y + j / 60.0,
                                  at.z + 0.03 * std::sin(i / 2.0));
        for (int i = 0; i < 12; ++i)
            for (int j = 0; j < 12; ++j) {
                const int a = 13 * i + j + 1;
                text += formatted("f %d %d %d\nf %d %d %d\n", a, a + 13, a + 14, a, a + 14, a + 1);
            }
        return read(text);
    };
    const Mesh near = sheet({0, 0, 0}), far = sheet({512345.25, 649776.5, 120});
    CHECK(far.weldedPositions.size() == 169);
    CHECK(far.triangles == near.triangles);
    FromMesh options;
    options.name = "sheet";
    options.centre = true;
    const MadeMolecule a = makeMolecule(near, options);
    options.centre = false;
    const MadeMolecule b = makeMolecule(far, options);
    REQUIRE(a.notes.size() + 1 == b.notes.size());
    CHECK_THAT(b.notes[0],
               Catch::Contains("m from the origin, and is 0.2 m long: its middle was put at the origin"));
    CHECK_THAT(a.notes[0], Catch::Contains("48 border edges"));
    CHECK_THAT(b.notes[1], Catch::Contains("48 border edges"));
    REQUIRE(a.molecule.vertices.size() == b.molecule.vertices.size());
    REQUIRE(a.molecule.skin.vertices.size() == b.molecule.skin.vertices.size());
    for (size_t i = 0; i < a.molecule.vertices.size(); ++i)
        CHECK(glm::distance(a.molecule.vertices[i].position, b.molecule.vertices[i].position) < 1e-6);
    for (size_t i = 0; i < a.molecule.skin.vertices.size(); ++i)
        CHECK(glm::distance(a.molecule.skin.vertices[i].position, b.molecule.skin.vertices[i].position) <
              1e-6);
    CHECK(b.lowestFrequency == Approx(a.lowestFrequency).epsilon(1e-3));
}
