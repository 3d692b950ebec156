// PLY files: every property by name, as text and as bytes of either order, and what is refused.
#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

#include "core/image.h"
#include "geometry/mesh.h"
#include "geometry/polygon.h"
#include "support/catch.h"
#include "support/model_text.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

// The bytes of numbers in one order.
class Bytes {
  public:
    explicit Bytes(bool big = false) : swapped_(big == (std::endian::native == std::endian::little)) {}
    template <typename T>
    Bytes& add(std::initializer_list<T> numbers) {
        for (const T number : numbers) {
            char bytes[sizeof number];
            std::memcpy(bytes, &number, sizeof number);
            if (swapped_) std::reverse(bytes, bytes + sizeof number);
            text.append(bytes, sizeof number);
        }
        return *this;
    }
    std::string text;

  private:
    bool swapped_;
};

constexpr const char* xyz = "property float x\nproperty float y\nproperty float z\n";
constexpr const char* list = "property list uchar int vertex_indices\n";

std::string header(const char* format, int vertices, const std::string& ofVertices, int faces,
                   const std::string& ofFaces, const char* comments = "") {
    return concat("ply\nformat ", format, " 1.0\n", comments, "element vertex ", vertices, "\n", ofVertices,
                  "element face ", faces, "\n", ofFaces, "end_header\n");
}

// A text of one triangle with more properties of its vertices.
std::string triangle(const std::string& properties, const std::string& a, const std::string& b,
                     const std::string& c) {
    return header("ascii", 3, xyz + properties, 1, list) + "0 0 0 " + a + "\n1 0 0 " + b + "\n0 1 0 " + c +
           "\n3 0 1 2\n";
}

Mesh read(const std::string& bytes) {
    return modelOf("m.ply", bytes);
}

std::string refusal(const std::string& bytes) {
    return refusalOf("m.ply", bytes);
}

double areaOf(const Mesh& mesh) {
    double out = 0;
    for (const glm::ivec3& t : mesh.triangles)
        out += glm::length(glm::cross(mesh.positions[size_t(t.y)] - mesh.positions[size_t(t.x)],
                                      mesh.positions[size_t(t.z)] - mesh.positions[size_t(t.x)])) /
               2;
    return out;
}

}  // namespace

TEST_CASE("PLY: properties of vertices by their names, in any order and type", "[ply][model]") {
    const Mesh mesh =
        read(triangle("property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float "
                      "ny\nproperty float nx\n"
                      "property float nz\nproperty double t\nproperty double s\n",
                      "255 0 188 0 0 2 0.25 0.125", "0 255 0 0 0 1 0.5 0.75", "0 0 255 1 0 0 0 1"));
    REQUIRE(mesh.positions.size() == 3);
    CHECK(mesh.positions[1] == glm::dvec3(1, 0, 0));
    CHECK(mesh.normals[0] == glm::dvec3(0, 0, 1));
    CHECK(mesh.normals[2] == glm::dvec3(0, 1, 0));
    REQUIRE(mesh.colors.size() == 3);
    CHECK(mesh.colors[0].x == 1);
    CHECK(mesh.colors[0].z == Approx(0.5028865));  // of sRGB
    CHECK(mesh.uvs[0] == glm::dvec2(0.125, 0.25));
    CHECK(mesh.uvs[2] == glm::dvec2(1, 0));
    CHECK(mesh.notes.empty());
    CHECK(mesh.parts.size() == 1);

    const Mesh named = read(triangle(
        "property float texture_u\nproperty float texture_v\nproperty float red\nproperty float green\n"
        "property float blue\n",
        "0.5 0.25 1 0.5 0", "0 0 0 0 0", "0 0 0 0 0"));
    CHECK(named.uvs[0] == glm::dvec2(0.5, 0.25));
    CHECK(named.colors[0].y == Approx(0.2140411));
}

TEST_CASE("PLY: the same as text and as bytes of both orders, doubles kept", "[ply][model]") {
    const double far = 500000.123456789;
    for (const char* format : {"binary_little_endian", "binary_big_endian"}) {
        INFO(format);
        const bool big = std::string(format) == "binary_big_endian";
        Bytes body(big);
        body.add<double>({far, 0, 0}).add<int16_t>({-3});
        body.add<double>({far + 1, 0, 0}).add<int16_t>({7});
        body.add<double>({far, 1, 0}).add<int16_t>({300});
        body.add<uint16_t>({3}).add<uint32_t>({0, 1, 2}).add<uint8_t>({9});
        const Mesh mesh = read(header(format, 3,
                                      "property double x\nproperty double y\nproperty double z\n"
                                      "property short quality\n",
                                      1, "property list ushort uint vertex_index\nproperty uchar flags\n") +
                               body.text);
        REQUIRE(mesh.triangles.size() == 1);
        CHECK(mesh.triangles[0] == glm::ivec3(0, 1, 2));
        CHECK(mesh.positions[0].x == far);
        REQUIRE(mesh.notes.size() == 2);
        CHECK(mesh.notes[0] == "of element \"vertex\" \"quality\" is not read");
        CHECK(mesh.notes[1] == "of element \"face\" \"flags\" is not read");
    }
}

TEST_CASE("PLY: data that begin with the byte of a newline", "[ply][model]") {
    Bytes body;
    body.text = std::string("\x0a\0\0\x3d", 4);
    body.add<float>({0, 0, 1, 0, 0, 0, 1, 0}).add<uint8_t>({3}).add<int32_t>({0, 1, 2});
    for (const char* newline : {"\n", "\r\n", "\r"}) {
        std::string head = header("binary_little_endian", 3, xyz, 1, list), text;
        for (const char c : head)
            text += c == '\n' ? std::string(newline) : std::string(1, c);
        const Mesh mesh = read(text + body.text);
        REQUIRE(mesh.positions.size() == 3);
        CHECK(mesh.positions[0].x == Approx(0.03125).epsilon(1e-5));
        CHECK(mesh.positions[2] == glm::dvec3(0, 1, 0));
        CHECK(mesh.notes.empty());
    }
}

TEST_CASE("PLY: each corner has its own texture coordinates, and vertices stay smooth", "[ply][model]") {
    const std::string corners =
        header("ascii", 4, xyz, 2, std::string(list) + "property list uchar float texcoord\n") +
        "0 0 0\n1 0 0\n1 1 0\n0 1 1\n3 0 1 2 6 0 0 0.1 0 0.1 1\n3 0 2 3 6 0.9 0 0.1 1 0.9 1\n";
    const Mesh mesh = read(corners);
    REQUIRE(mesh.triangles.size() == 2);
    CHECK(mesh.positions.size() == 5);  // corner 2 has the same in both
    CHECK(mesh.weldedPositions.size() == 4);
    const glm::dvec2 expected[2][3] = {{{0, 0}, {0.1, 0}, {0.1, 1}}, {{0.9, 0}, {0.1, 1}, {0.9, 1}}};
    for (size_t t = 0; t < 2; ++t)
        for (int i = 0; i < 3; ++i)
            CHECK(mesh.uvs[size_t(mesh.triangles[t][i])] == expected[t][i]);
    const int a = mesh.triangles[0].x, b = mesh.triangles[1].x;
    CHECK(a != b);
    CHECK(mesh.normals[size_t(a)] == mesh.normals[size_t(b)]);
    CHECK(mesh.normals[size_t(a)].y < 0);

    const Mesh wrong =
        read(header("ascii", 3, xyz, 1, std::string(list) + "property list uchar float texcoord\n") +
             "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 5 0 0 1 0 1\n");
    REQUIRE(wrong.notes.size() == 1);
    CHECK_THAT(wrong.notes[0], Contains("the texture coordinates of 1 face are not two for each corner"));
}

TEST_CASE("PLY: images by their comments and by number, colours of faces", "[ply][model][material]") {
    const Scratch scratch;
    writePng(scratch.path("a b.png"), {1, 1, 4, {255, 0, 0, 255}});
    writePng(scratch.path("c.png"), {1, 1, 4, {0, 255, 0, 0}});
    const std::string body = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const Mesh mesh = loadMesh(scratch.write(
        "m.ply",
        header("ascii", 4, xyz, 3, std::string(list) + "property int texnumber\n",
               "comment TextureFile a b.png \ncomment made by hand\ncomment TextureFile\tc.png\r\n") +
            body + "3 0 1 2 1\n3 0 2 3 0\n3 1 2 3 1\n"));
    REQUIRE(mesh.parts.size() == 2);
    CHECK(mesh.notes.empty());
    CHECK(mesh.parts[0].triangleCount == 1);
    CHECK(mesh.parts[1].triangleCount == 2);
    CHECK(mesh.triangles[0] == glm::ivec3(0, 2, 3));
    const auto look = [&](size_t part) { return mesh.materials.at(size_t(mesh.parts[part].look)); };
    CHECK(mesh.images.at(size_t(look(0).colorImage)).pixels[0] == 255);
    CHECK(mesh.images.at(size_t(look(1).colorImage)).pixels[1] == 255);
    CHECK(look(1).alpha == SurfaceMaterial::Alpha::cut);

    const Mesh missing = loadMesh(scratch.write(
        "n.ply", header("ascii", 4, xyz, 1, list, "comment TextureFile none.png\n") + body + "4 0 1 2 3\n"));
    REQUIRE(missing.notes.size() == 1);
    CHECK_THAT(missing.notes[0], Contains("its colour image \"none.png\" is left out: there is no"));

    const Mesh faces = loadMesh(scratch.write(
        "f.ply", header("ascii", 4, xyz, 2,
                        std::string(list) + "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                            "property uchar alpha\n") +
                     body + "3 0 1 2 255 0 0 255\n3 0 2 3 0 0 255 128\n"));
    REQUIRE(faces.triangles.size() == 2);
    for (int i = 0; i < 3; ++i) {
        CHECK(faces.colors[size_t(faces.triangles[0][i])] == glm::dvec3(1, 0, 0));
        CHECK(faces.colors[size_t(faces.triangles[1][i])] == glm::dvec3(0, 0, 1));
    }
    REQUIRE(faces.notes.size() == 1);
    CHECK_THAT(faces.notes[0], Contains("opacity"));
}

TEST_CASE("PLY: strips, other elements, faces of two corners, and bytes behind the end", "[ply][model]") {
    const Mesh strips = read(concat("ply\nformat ascii 1.0\nobj_info num_cols 5\nelement vertex 5\n", xyz,
                                    "element nothing 4000000000\nelement tristrips 1\n"
                                    "property list int int vertex_indices\nend_header\n"
                                    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 3\n"));
    REQUIRE(strips.triangles.size() == 4);
    for (const glm::ivec3& t : strips.triangles)
        CHECK(glm::cross(strips.positions[size_t(t.y)] - strips.positions[size_t(t.x)],
                         strips.positions[size_t(t.z)] - strips.positions[size_t(t.x)])
                  .z > 0);

    const Mesh more =
        read(concat("ply\nformat ascii 1.0\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n"
                    "element face 2\n",
                    list, "element vertex 3\n", xyz,
                    "end_header\n\n0 1\n3 0 1 2\n2 0 1\n0 0 0 \n1 +0 0\n\n0\n1e-400 0\n\n7 8\n"));
    CHECK(more.triangles.size() == 1);
    REQUIRE(more.notes.size() == 3);
    CHECK(more.notes[0] == "its element \"edge\" is not read");
    CHECK_THAT(more.notes[1], Contains("it goes on for 4 bytes behind what its header announces"));
    CHECK_THAT(more.notes[2], Contains("1 face has fewer than three corners and is left out"));
}

TEST_CASE("polygons are cut into triangles that cover them once", "[ply][model]") {
    // an arrow whose first corner sees not all others, a comb, and one that stands upright
    const std::vector<std::vector<glm::dvec3>> polygons = {
        {{0, 1, 0}, {-2, 0, 0}, {0, 4, 0}, {2, 0, 0}},
        {{0, 0, 0},
         {5, 0, 0},
         {5, 3, 0},
         {4, 3, 0},
         {4, 1, 0},
         {3, 1, 0},
         {3, 3, 0},
         {2, 3, 0},
         {2, 1, 0},
         {1, 1, 0},
         {1, 3, 0},
         {0, 3, 0}},
        {{0, 0, 0}, {0, 0, 2}, {0, 1, 1}, {0, 2, 2}, {0, 2, 0}},
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}};
    const double areas[] = {6, 11, 3, 2};
    for (size_t p = 0; p < polygons.size(); ++p) {
        INFO(p);
        glm::dvec3 whole(0);
        double sum = 0;
        const std::vector<glm::ivec3> triangles = cutPolygon(polygons[p]);
        CHECK(triangles.size() == polygons[p].size() - 2);
        std::set<int> used;
        for (const glm::ivec3& t : triangles) {
            used.insert({t.x, t.y, t.z});
            const glm::dvec3 normal = glm::cross(polygons[p][size_t(t.y)] - polygons[p][size_t(t.x)],
                                                 polygons[p][size_t(t.z)] - polygons[p][size_t(t.x)]);
            whole += normal / 2.0;
            sum += glm::length(normal) / 2;
        }
        CHECK(sum == Approx(areas[p]));
        CHECK(glm::length(whole) == Approx(areas[p]));  // all turn the same way
        CHECK(used.size() == polygons[p].size());
    }
    CHECK(cutPolygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) ==
          std::vector<glm::ivec3>{{0, 1, 2}, {0, 2, 3}});
    CHECK(cutPolygon(std::vector<glm::dvec3>(7, glm::dvec3(1))).size() == 5);     // of no area
    CHECK(cutPolygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 2);  // crosses itself

    const Mesh arrow = read(header("ascii", 4, xyz, 1, list) + "0 1 0\n-2 0 0\n0 4 0\n2 0 0\n4 0 1 2 3\n");
    CHECK(areaOf(arrow) == Approx(6));
}

TEST_CASE("PLY: points without faces are a cloud", "[ply][model]") {
    const Mesh mesh = read(concat("ply\nformat ascii 1.0\nelement vertex 2\n", xyz,
                                  "property float nx\nproperty float ny\nproperty float nz\nproperty float "
                                  "intensity\nend_header\n1 2 3 0 0 1 9\n4 5 6 1 0 0 9\n"));
    CHECK(mesh.triangles.empty());
    CHECK(mesh.positions == std::vector<glm::dvec3>{{1, 2, 3}, {4, 5, 6}});
    CHECK(mesh.weldedPositions.size() == 2);
    CHECK(mesh.normals[1] == glm::dvec3(1, 0, 0));
    REQUIRE(mesh.notes.size() == 2);
    CHECK_THAT(mesh.notes[0], Contains("\"intensity\" is not read"));
    CHECK_THAT(mesh.notes[1], Contains("a cloud of 2 points"));
    CHECK_THAT(refusal(concat("ply\nformat ascii 1.0\nelement vertex 0\n", xyz, "end_header\n")),
               Contains("has no triangles"));
}

TEST_CASE("PLY: what is no PLY is refused where it is wrong", "[ply][model]") {
    const std::string good = header("ascii", 3, xyz, 1, list), body = "0 0 0\n1 0 0\n0 1 0\n";
    const auto with = [&](const char* from, const char* to) {
        std::string out = good;
        return out.replace(out.find(from), std::strlen(from), to) + body + "3 0 1 2\n";
    };
    CHECK_THAT(refusal(""), Contains("m.ply:1: cannot be read: the file ends within its header"));
    CHECK_THAT(refusal("ply\nformat ascii 1.0"), Contains("m.ply:2: ") && Contains("within its header"));
    CHECK_THAT(refusal("plop\n"), Contains("m.ply:1: cannot be read: expected \"ply\""));
    CHECK_THAT(refusal(with("ascii", "binary_middle")),
               Contains("m.ply:2: ") && Contains("found \"binary_middle\""));
    CHECK_THAT(refusal(with("format ascii 1.0\n", "")), Contains("does not say the format"));
    CHECK_THAT(refusal(with("element vertex 3", "element vertex -3")),
               Contains("m.ply:3: ") && Contains("a whole number"));
    CHECK_THAT(refusal(with("float y", "half y")),
               Contains("m.ply:5: cannot be read: there is no type \"half\""));
    CHECK_THAT(refusal(with("float y", "float x")), Contains("two properties \"x\""));
    CHECK_THAT(refusal(with("float y", "float why")), Contains("element \"vertex\" has no property \"y\""));
    CHECK_THAT(refusal(with("element face 1", "element vertex 1")), Contains("two elements \"vertex\""));
    CHECK_THAT(refusal(with("element face 1", "elephant face 1")), Contains("found \"elephant face 1\""));
    CHECK_THAT(refusal(with("vertex 3", "vertex 300")), Contains("announces 300 of element \"vertex\""));

    CHECK_THAT(refusal(good + body + "3 0 1 3\n"),
               Contains("m.ply:13: cannot be read: face 0 of 1: it has a corner at vertex 3 of 3"));
    CHECK_THAT(refusal(good + body + "3 0 1 -1\n"), Contains("a corner at vertex -1 of 3"));
    CHECK_THAT(refusal(good + body + "3 0 1 0.5\n"), Contains("a corner at vertex 0.5 of 3"));
    CHECK_THAT(refusal(good + body + "-3 0 1 2\n"), Contains("a length of -3, expected a whole number"));
    CHECK_THAT(refusal(good + body + "4 0 1 2\n"), Contains("the file ends here"));
    CHECK_THAT(refusal(good + body + "1e9 0 1 2\n"),
               Contains("a length of 1000000000, more than what is left"));
    CHECK_THAT(refusal(good + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"),
               Contains("m.ply:11: cannot be read: vertex 1 of 3: the line has more numbers"));
    CHECK_THAT(refusal(good + "0 0 0 1\n1 0 0\n0 1 0\n3 0 1 2\n"),
               Contains("m.ply:10: ") && Contains("more numbers"));
    CHECK_THAT(refusal(good + "0 0 zero\n1 0 0\n0 1 0\n3 0 1 2\n"),
               Contains("m.ply:10: cannot be read: vertex 0 of 3: expected a number, found \"zero\""));
    for (const char* wrong : {"nan", "1e400", "inf"})
        CHECK_THAT(refusal(concat(good, "0 0 ", wrong, "\n1 0 0\n0 1 0\n3 0 1 2\n")),
                   Contains("is not finite"));
    CHECK_THAT(refusal(good + "0 0 1e31\n1 0 0\n0 1 0\n3 0 1 2\n"), Contains("lies beyond 1e+30"));
}

TEST_CASE("PLY: short files and counts beyond them are refused before they take memory", "[ply][model]") {
    const std::string head = header("binary_little_endian", 3, xyz, 1, list);
    Bytes body;
    body.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).add<uint8_t>({3}).add<int32_t>({0, 1, 2});
    CHECK(read(head + body.text).triangles.size() == 1);
    for (size_t length = 0; length < body.text.size(); ++length)
        CHECK_THAT(refusal(head + body.text.substr(0, length)), Contains("cannot be read: "));
    CHECK_THAT(refusal(header("binary_little_endian", 200'000'000, xyz, 1, list) + body.text),
               Contains("announces 200000000 of element \"vertex\""));
    const std::string lists =
        header("binary_little_endian", 3, xyz, 1, "property list char int vertex_indices\n");
    Bytes negative;
    negative.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}).add<int8_t>({-1}).add<int32_t>({0, 1, 2});
    CHECK_THAT(refusal(lists + negative.text),
               Contains("m.ply: cannot be read: face 0 of 1: list") && Contains("length of -1"));
}
