// Models in OFF, as Geomview and others write it.
#include "support/catch.h"
#include "support/model_text.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

Mesh off(const std::string& text) {
    return modelOf("m.off", text);
}

std::string refusal(const std::string& text) {
    return refusalOf("m.off", text);
}

}  // namespace

TEST_CASE("an OFF file is read with comments, and counts behind its keyword or below", "[model][off]") {
    for (const std::string head : {"OFF\n4 1 0\n", "OFF 4 1 0\n", "# by hand\n\nOFF # of\n 4\t1 \r\n"}) {
        const Mesh mesh = off(head + corners + "# a square\n4 0 1 2 3\n");
        CHECK(mesh.positions.size() == 4);
        CHECK(mesh.triangles == std::vector<glm::ivec3>{{0, 1, 2}, {0, 2, 3}});
        CHECK(mesh.notes.empty());
    }
    CHECK(off("OFF\n1 0 0\n6500000.125 0 0\n").positions[0].x == 6500000.125);
}

TEST_CASE("vertices of OFF have what the letters of its keyword say", "[model][off]") {
    const Mesh all =
        off("STCNOFF\n3 1 0\n0 0 0 0 0 2 255 0 0 255 0.25 1\n1 0 0 0 0 1 0 255 0 255 0 0\n"
            "0 1 0 0 0 1 0 0 255 255 1 1\n3 0 1 2\n");
    CHECK(all.notes.empty());
    CHECK(all.normals[0] == glm::dvec3(0, 0, 1));
    CHECK(all.colors[1] == glm::dvec3(0, 1, 0));
    CHECK(all.uvs[0] == glm::dvec2(0.25, 1));
    const Mesh shares = off("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 0.5 0 0 1\n0 1 0 0 0 1 1\n3 0 1 2\n");
    CHECK(shares.colors[0] == glm::dvec3(1, 0, 0));
    CHECK(shares.colors[1].r == Approx(0.2140).margin(1e-4));  // 0.5 of sRGB
    const Mesh faces = off("OFF\n4 2 0\n" + corners + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n");
    REQUIRE(faces.colors.size() == 6);
    CHECK(faces.colors[size_t(faces.triangles[0].y)] == glm::dvec3(1, 0, 0));
    CHECK(faces.colors[size_t(faces.triangles[1].z)] == glm::dvec3(0, 0, 1));
}

TEST_CASE("what of an OFF file is not read is told, and what is wrong with its line", "[model][off]") {
    const Mesh left =
        off("OFF\n3 3 0\n0 0 0 7\n1 0 0 7\n1 1 0 7\n3 0 1 2 5\n2 0 1\n3 2 1 0 0.5 0.5 0.5 0.5\nmore\n");
    REQUIRE(left.notes.size() >= 5);
    const std::string notes = joined(left.notes, "; ");
    for (const char* told : {"goes on behind the faces", "1 face has fewer than three corners",
                             "of 3 vertices there are more numbers", "a colour by its number in a table",
                             "opacity is not drawn"})
        CHECK_THAT(notes, Catch::Contains(told));
    CHECK(refusal("4OFF\n1 0 0\n0 0 0 1\n") ==
          "m.off: line 1: \"4OFF\" is not read: expected OFF, with ST, C or N before it");
    CHECK(refusal("OFF BINARY\n") == "m.off: line 1: OFF as bytes is not read: save it as text");
    CHECK(refusal("ply\n") == "m.off: line 1: expected \"OFF\", with ST, C or N before it");
    CHECK(refusal("OFF\n4 one 0\n") == "m.off: line 2: expected counts of vertices and faces as numbers");
    CHECK(refusal("OFF\n1e9 1 0\n") == "m.off: line 2: expected counts from 0 to 2^28, found 1000000000");
    CHECK(refusal("OFF\n4 1 0\n0 0 0\n") == "m.off: line 3: the text ends where a vertex is expected");
    CHECK(refusal("OFF\n4 1 0\n0 0\n") == "m.off: line 3: expected the numbers of a vertex: x y z");
    CHECK(refusal("OFF\n1 0 0\n0 0 nan\n") == "m.off: line 3: a vertex is not finite, or too far away");
    for (const char* face : {"3 0 1", "-1 0 1 2", "1.5 0 1 2"})
        CHECK(refusal("OFF\n4 1 0\n" + corners + face + "\n") ==
              "m.off: line 7: expected a face: how many corners, and their vertices");
    for (const char* vertex : {"9", "-1", "0.5"})
        CHECK(refusal("OFF\n4 1 0\n" + corners + "3 0 1 " + vertex + "\n") ==
              concat("m.off: line 7: a face has a corner at vertex ", vertex, " of 4"));
}
