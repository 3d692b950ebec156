// Formats that say their unit: lengths are metres after reading.
#include "core/error.h"
#include "geometry/mesh.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

std::string collada(const std::string& unit) {
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset>" +
           unit +
           R"(<up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g" name="g"><mesh>
<source id="p"><float_array id="a" count="9">0 0 0 10 0 0 0 20 0</float_array><technique_common>
<accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

std::string fbx(const std::string& settings) {
    return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: "
           "7400\n}\n" +
           settings + R"(Objects:  {
	Geometry: 1, "Geometry::tri", "Mesh" {
		Vertices: *9 {
			a: 0,0,0,10,0,0,0,20,0
		}
		PolygonVertexIndex: *3 {
			a: 0,1,-3
		}
		GeometryVersion: 124
	}
	Model: 2, "Model::tri", "Mesh" {
		Version: 232
	}
}
Connections:  {
	C: "OO",2,0
	C: "OO",1,2
}
)";
}

std::string unitScale(const char* factor) {
    return concat(
        "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t\tP: \"UnitScaleFactor\", \"double\", "
        "\"Number\", \"\",",
        factor, "\n\t}\n}\n");
}

double metres(const char* name, const std::string& text) {
    const Scratch scratch;
    const Mesh mesh = loadMesh(scratch.write(name, text));
    CHECK(mesh.high.y == Approx(2 * mesh.high.x));
    return mesh.high.x / 10;
}

}  // namespace

TEST_CASE("lengths of COLLADA and FBX are metres, by the unit that the file says", "[units][model]") {
    CHECK(metres("a.dae", collada("<unit name=\"centimeter\" meter=\"0.01\"/>")) == Approx(0.01));
    CHECK(metres("a.dae", collada("<unit name=\"meter\" meter=\"1\"/>")) == Approx(1));
    CHECK(metres("a.dae", collada("")) == Approx(1));
    CHECK(metres("a.fbx", fbx(unitScale("1"))) == Approx(0.01));
    CHECK(metres("a.fbx", fbx(unitScale("100"))) == Approx(1));
    CHECK(metres("a.fbx", fbx(unitScale("2.54"))) == Approx(0.0254));
    CHECK(metres("a.fbx", fbx("GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t}\n}\n")) ==
          Approx(0.01));
}
