// The triangles that the text of a model announces, held against those that its reader gives.
#include "core/error.h"
#include "geometry/announced.h"
#include "support/catch.h"
#include "support/model_text.h"

using namespace shoal;
using namespace shoal::test;

TEST_CASE("what a text says of its triangles is held against what was read", "[model]") {
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
        "endfacet\n";
    CHECK(refusalOf("m.stl", "solid a\n" + facet + facet + "endsolid a\n") == "");
    const std::string surface = "SURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n";
    const auto ac = [&](int count) {
        return concat(
            "AC3Db\nMATERIAL \"\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\n"
            "kids 1\nOBJECT poly\nname \"a\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf ",
            count, "\n", surface, surface, "kids 0\n");
    };
    CHECK(refusalOf("m.ac", ac(2)) == "");
    CHECK_THAT(refusalOf("m.ac", ac(1)),
               Catch::Contains("m.ac: its text has 2 triangles, and its reader gives 1"));
    const auto ase = [&](int count) {
        return concat(
            "*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n*NODE_NAME \"a\"\n*MESH {\n*MESH_NUMVERTEX 4\n"
            "*MESH_NUMFACES ",
            count,
            "\n*MESH_VERTEX_LIST {\n*MESH_VERTEX 0 0 0 0\n*MESH_VERTEX 1 1 0 0\n"
            "*MESH_VERTEX 2 0 1 0\n*MESH_VERTEX 3 1 1 0\n}\n*MESH_FACE_LIST {\n"
            "*MESH_FACE 0: A: 0 B: 1 C: 2\n*MESH_FACE 1: A: 1 B: 3 C: 2\n}\n}\n}\n");
    };
    CHECK(refusalOf("m.ase", ase(2)) == "");
    CHECK_THAT(refusalOf("m.ase", ase(1)),
               Catch::Contains("m.ase: its text has 2 triangles, and its reader gives 1"));
}

TEST_CASE("a COLLADA scene has the triangles of its nodes, and none where it has no mesh", "[model]") {
    const auto dae = [](const std::string& primitives, const std::string& nodes) {
        return concat(
            R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="f" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
<accessor source="#f" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>)",
            primitives, R"(</mesh></geometry></library_geometries><library_visual_scenes>
<visual_scene id="s" name="s">)",
            nodes,
            R"(</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)");
    };
    const std::string input = R"(<input semantic="VERTEX" source="#v" offset="0"/>)";
    const std::string place = R"(<instance_geometry url="#g"/>)";
    const auto node = [](const std::string& in) { return concat("<node>", in, "</node>"); };
    const std::string quad =
        concat(R"(<polylist count="1">)", input, "<vcount>4</vcount><p>0 1 2 3</p></polylist>");
    CHECK(modelOf("m.dae", dae(quad, node(place))).triangles.size() == 2);
    const std::string moved = node("<translate>2 0 0</translate>" + place);
    CHECK(modelOf("m.dae", dae(quad, node(place + moved) + node(moved))).triangles.size() == 6);
    const std::string strips =
        concat("<tristrips count=\"2\">", input, "<p>0 1 3 2</p><p>0 1 2</p></tristrips><lines count=\"1\">",
               input, "<p>0 2</p></lines>");
    CHECK(trianglesOfCollada(dae(strips, node(place))) == 3);
    CHECK(modelOf("m.dae", dae(strips, node(place))).triangles.size() == 3);
    CHECK_FALSE(trianglesOfCollada(dae(quad, node(R"(<instance_geometry url="other.dae#g"/>)"))));
    CHECK_THAT(refusalOf("m.dae", dae(quad, node(""))), Catch::Contains("m.dae: has no triangles"));
}
