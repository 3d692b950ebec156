// Tests files for other programs: written by the command, opened by the real readers where this machine has
// them.
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "cli/shoal_command.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

void runHello(const Words& more, int frames = 6) {
    Words words{"run", squaresScene(), "--headless", "--frames", std::to_string(frames)};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = runShoal(words);
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
}

bool hasVtk() {
    static const bool found = std::system("/usr/bin/python3 -c 'import vtk' >/dev/null 2>&1") == 0;
    if (!found) WARN("skipped: VTK's Python package is not installed (on Debian: apt install python3-vtk9)");
    return found;
}

// Runs a script in the folder; true where it ends well.
bool python(const Scratch& scratch, const std::string& script, const std::string& arguments = {}) {
    scratch.write("script.py", script);
    return std::system(
               ("cd " + scratch.folder().string() + " && /usr/bin/python3 script.py " + arguments + " 1>&2")
                   .c_str()) == 0;
}

// Every file of the index against the table of the same frame. VTK's own reader of .pvd is a part of
// ParaView; it is plain XML.
constexpr const char* compareWithCsv = R"(
import csv, sys, vtk
import xml.etree.ElementTree as xml
errors = []
vtk.vtkObject.GlobalWarningDisplayOff()
entries = xml.parse('out.pvd').getroot().find('Collection').findall('DataSet')
assert [e.get('file') for e in entries] == ['out-00000.vtp', 'out-00003.vtp', 'out-00006.vtp']
for entry, frame in zip(entries, (0, 3, 6)):
    reader = vtk.vtkXMLPolyDataReader()
    reader.AddObserver('ErrorEvent', lambda *_: errors.append('error'))
    reader.SetFileName(entry.get('file'))
    reader.Update()
    data = reader.GetOutput()
    rows = list(csv.DictReader(open('x-%05d.csv' % frame)))
    assert not errors
    assert data.GetNumberOfPoints() == len(rows) == 80, data.GetNumberOfPoints()
    assert data.GetNumberOfPolys() == 40 and data.GetNumberOfVerts() == 0 and data.GetNumberOfLines() == 0
    assert abs(float(entry.get('timestep')) - frame / 60) < 1e-6
    assert abs(data.GetFieldData().GetArray('TimeValue').GetTuple1(0) - frame / 60) < 1e-6
    points = data.GetPointData()
    assert points.GetVectors().GetName() == 'velocity' and points.GetNormals().GetName() == 'normal'
    assert points.GetVectors().GetInformation().Get(vtk.vtkDataArray.UNITS_LABEL()) == 'm/s'
    for i, row in enumerate(rows):
        for array, keys in (('velocity', ('vx', 'vy', 'vz')), ('normal', ('nx', 'ny', 'nz'))):
            for a, key in zip(points.GetArray(array).GetTuple3(i), keys):
                assert abs(a - float(row[key])) < 1e-6
        for a, key in zip(data.GetPoint(i), ('x', 'y', 'z')):
            assert abs(a - float(row[key])) < 1e-6
        for key in ('group', 'molecule', 'vertex'):
            assert points.GetArray(key).GetTuple1(i) == float(row[key])
    for i in range(40):
        corners = [data.GetCell(i).GetPointId(k) for k in range(3)]
        assert {c // 4 for c in corners} == {i // 2} and len(set(corners)) == 3
)";

}  // namespace

TEST_CASE("VTK reads .vtp and what the index names", "[cli][exchange]") {
    const Scratch scratch;
    runHello({"--export", scratch.path("out.pvd"), "--export-every", "3"});
    runHello({"--export", scratch.path("x.csv"), "--export-every", "3"});
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"out-00000.vtp", "out-00003.vtp",
                                                                "out-00006.vtp", "out.pvd", "x-00000.csv",
                                                                "x-00003.csv", "x-00006.csv"});
    if (!hasVtk()) return;
    CHECK(python(scratch, compareWithCsv));
}

TEST_CASE("springs or vertices as the cells of .vtp", "[cli][exchange]") {
    const Scratch scratch;
    runHello({"--export", scratch.path("springs.vtp"), "--export-cells", "springs"}, 1);
    runHello({"--export", scratch.path("vertices.vtp"), "--export-cells", "vertices"}, 1);
    if (!hasVtk()) return;
    CHECK(python(scratch, R"(
import vtk
def cells(name):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.Update()
    data = reader.GetOutput()
    return data.GetNumberOfVerts(), data.GetNumberOfLines(), data.GetNumberOfPolys()
assert cells('springs.vtp') == (0, 120, 0), cells('springs.vtp')
assert cells('vertices.vtp') == (80, 0, 0), cells('vertices.vtp')
)"));
}

TEST_CASE("places far from the origin are written to all their digits", "[cli][exchange]") {
    const Scratch scratch;
    scratch.write("point.json", R"({"format": "shoal-molecule-1", "name": "point",
                                    "vertices": [{"position": [0, 0, 0], "mass": 1}]})");
    const std::string scene = scratch.write("far.scene.json", R"({
        "format": "shoal-scene-1", "gravity": [0, 0, 0],
        "groups": [{"molecule": "point.json",
                    "place": {"on": "list", "items": [{"position": [0.5, 0, 100000.3]}]}}]})");
    const auto exported = [&](const std::string& name) {
        const Outcome outcome =
            runShoal({"run", scene, "--headless", "--frames", "1", "--export", scratch.path(name)});
        INFO(outcome.err);
        REQUIRE(outcome.code == 0);
        return readFile(scratch.path(name));
    };
    for (const auto& [name, before] : {std::pair("far.csv", ",0.5,0,"), std::pair("far.ply", "\n0.5 0 ")}) {
        const std::string text = exported(name);
        const size_t at = text.find(before);
        REQUIRE(at != std::string::npos);
        CHECK(std::abs(std::strtod(text.c_str() + at + std::strlen(before), nullptr) - 100000.3) < 1e-6);
    }
    CHECK_THAT(exported("far.vtp"), Contains("<DataArray type=\"Float64\" Name=\"Points\""));
    runHello({"--export", scratch.path("near.vtp")}, 1);
    CHECK_THAT(readFile(scratch.path("near.vtp")), Contains("<DataArray type=\"Float32\" Name=\"Points\""));
}

TEST_CASE("an index is whole at any moment, and a run that goes on adds to it", "[cli][exchange]") {
    const Scratch scratch;
    // The disk is full at the second file: what the index names is there.
    refusal({"run", squaresScene(), "--headless", "--frames", "4", "--count", "200", "--export",
             scratch.path("out.pvd")},
            "cannot be written", {.largestFile = 20000});
    CHECK(filesIn(scratch.path("")).empty());
    runHello({"--export", scratch.path("out.pvd"), "--save", scratch.path("s.shoal")}, 2);
    runHello({"--export", scratch.path("out.pvd"), "--resume", scratch.path("s.shoal")}, 2);
    const std::string index = readFile(scratch.path("out.pvd"));
    size_t entries = 0, at = 0;
    for (; (at = index.find("<DataSet", at)) != std::string::npos; ++at)
        ++entries;
    CHECK(entries == 5);
    CHECK_THAT(index, Contains("timestep=\"0.0666666667\" part=\"0\" file=\"out-00004.vtp\""));
    CHECK_THAT(index, Contains("</VTKFile>"));
    // a new run begins a new one
    runHello({"--export", scratch.path("out.pvd"), "--export-frames", "1"}, 2);
    CHECK(readFile(scratch.path("out.pvd")).find("out-00000") == std::string::npos);
}

TEST_CASE("Assimp reads a sequence of .ply", "[cli][exchange]") {
    const Scratch scratch;
    runHello({"--export", scratch.path("out.ply"), "--export-every", "3"});
    for (const char* name : {"out-00000.ply", "out-00003.ply", "out-00006.ply"}) {
        Assimp::Importer importer;
        const aiScene* scene = importer.ReadFile(scratch.path(name), aiProcess_ValidateDataStructure);
        INFO(importer.GetErrorString());
        REQUIRE(scene);
        REQUIRE(scene->mNumMeshes == 1);
        CHECK(scene->mMeshes[0]->mNumFaces == 40);
        CHECK(scene->mMeshes[0]->HasNormals());
    }
}

TEST_CASE("wrong words of --export", "[cli][exchange]") {
    const Words words{"run", squaresScene(), "--headless", "--frames", "2"};
    const auto refused = [&](const Words& more, const std::string& part) {
        Words all = words;
        all.insert(all.end(), more.begin(), more.end());
        refusal(all, part);
    };
    refused({"--export", "x.obj"}, "a name ending in .csv or .ply or .vtp or .pvd, found \"x.obj\"");
    refused({"--export-every", "2"}, "--export-every requires --export");
    refused({"--export", "x.vtp", "--export-every", "0"},
            "--export-every: expected a whole number, 1 or more, found \"0\"");
    refused({"--export", "x.vtp", "--export-every", "3"}, "--export-every 3 is beyond the last frame, 2");
    refused({"--export", "x.vtp", "--export-every", "1", "--export-frames", "1"},
            "--export-frames excludes --export-every");
    refused({"--export", "x.vtp", "--export-cells", "spring"}, "did you mean \"springs\"");
    refused({"--export", "x.csv", "--export-cells", "springs"},
            "--export-cells is of --export to .vtp or .pvd");
}

TEST_CASE("export refuses in one line, and leaves nothing behind", "[cli][export]") {
    const Scratch scratch;
    const std::string folder = scratch.path("vat");
    const auto refuses = [&](const Words& more, const std::string& part) {
        Words words{"export", squaresScene()};
        words.insert(words.end(), more.begin(), more.end());
        refusal(words, part);
    };
    refuses({}, "say what to write: --vat FOLDER, --glb FILE or --usd TARGET");
    refuses({"--glb", scratch.path("a.obj")}, "expected a name ending in .glb");
    refuses({"--vat", folder, "--glb", scratch.path("a.glb")}, "excludes");
    refuses({"--vat", folder, "--group", "quads"}, "no group \"quads\" (did you mean \"quad\"?)");
    refuses({"--vat", folder, "--frames", "9000"}, "--frames: textures hold at most 8192, found 9000");
    refuses({"--vat", folder, "--frames", "5", "--loop", "5"},
            "--loop: expected fewer than the 5 frames, found 5");
    refuses({"--vat", folder, "--molecules", "21"}, "--molecules: group \"quad\" has 20, found 21");
    refuses({"--vat", folder, "--texels", "jpg"}, "--texels: unknown word \"jpg\"");
    refuses({"--vat", "/proc/nothing"}, "/proc/nothing");
    refusal({"export", squaresScene(), "--vat", folder, "--frames", "60"}, "vat", {.largestFile = 20000});
    refuses({"--usd", scratch.path("a.usda"), "--rigid-within", "-1"}, "expected a length of at least 0 m");
    refuses({"--usd", scratch.path("a.usda"), "--rigid-within", "nan"}, "expected a length of at least 0 m");
    refuses({"--vat", scratch.path("a"), "--rigid-within", "1"}, "--usd");
    refuses({"--usd", scratch.path("a.usdc")}, "expected a folder, or a name ending in .usda");
    refuses({"--usd", scratch.path("a.usda"), "--glb", scratch.path("a.glb")}, "excludes");
    refusal({"export", "fountain", "--vat", folder, "--frames", "2"}, "choose one");
    refusal({"export", "fire", "--vat", folder, "--frames", "2", "--group", "flames"}, "group \"flames\"");
    CHECK(filesIn(scratch.folder().string()).empty());
}

TEST_CASE("an export that is refused leaves nothing", "[cli][exchange]") {
    const Scratch scratch;
    const auto molecule = [](const char* name) { return sourceFile(concat("molecules/", name)); };
    const std::string scene = scratch.write(
        "refused.scene.json",
        concat(R"({"format": "shoal-scene-1", "groups": [{"name": "a", "molecule": ")",
               molecule("minnow.json"),
               R"(", "count": 1, "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}},
 {"name": "b", "molecule": ")",
               molecule("leaf.json"),
               R"(", "life": {"span": 1}, "emitters": [{"from": "point", "rate": 9}]}]})"));
    refusal({"export", scene, "--usd", scratch.path("o/a.usda"), "--frames", "2", "--rigid"},
            "group \"b\" has births or deaths");
    CHECK(filesIn(scratch.path("")) == std::vector<std::string>{"refused.scene.json"});
    CHECK_FALSE(std::filesystem::exists(scratch.path("o")));
}
