// `shoal molecule`.
#include "cli/shoal_command.h"
#include "core/file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const std::string minnow = sourceFile("molecules/minnow.obj");

// A box of one sheet: no top.
const char* const tray =
    "o tray\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

}  // namespace

TEST_CASE("molecule from-mesh: writes a molecule that check accepts", "[cli][molecule]") {
    const Scratch scratch;
    const std::string out = scratch.path("fish.json");
    const Outcome made =
        runShoal({"molecule", "from-mesh", minnow, "-o", out, "--vertices", "20", "--pin", "z>0.9"});
    INFO(made.err);
    REQUIRE(made.code == 0);
    CHECK(made.err.empty());
    for (const char* part :
         {"890 vertices, 1776 triangles", "a volume of", "molecule \"fish\": ", "pinned)", "flesh", "edges",
          "Hz, damping ratio", "0 zero-stiffness modes", "stable step", "skin: ", "wrote "})
        CHECK(made.out.find(part) != std::string::npos);
    const Outcome checked = runShoal({"check", out, "--json"});
    REQUIRE(checked.code == 0);
    const JsonValue report = checked.json();
    CHECK(member(member(report.items.at(0), "molecule"), "vertices").number <= 20);
    CHECK(member(report.items.at(0), "warnings").items.empty());
    CHECK(filesIn(scratch.folder().string()) == std::vector<std::string>{"fish.json"});
}

TEST_CASE("molecule from-mesh: says which beam it stands for", "[cli][molecule]") {
    const Words words = {"molecule", "from-mesh", minnow, "--rings", "6",    "--modulus",
                         "2e5",      "--density", "1000", "--pin",   "z>0.8"};
    const Outcome made = runShoal(words);
    INFO(made.out);
    REQUIRE(made.code == 0);
    for (const char* part : {"stands for a body, E = 0.2 MPa, 1000 kg/m^3: free, its first frequency is ",
                             " Hz, the beam's ", "; held by its pins, with ", " mm free, it sags by "})
        CHECK(made.out.find(part) != std::string::npos);
    Words json = words;
    json.push_back("--json");
    const JsonValue report = runShoal(json).json(), beam = member(report, "standsFor");
    CHECK(member(beam, "modulus").number == 2e5);
    for (const char* figure : {"free", "sag", "clamped"}) {
        const JsonValue found = member(beam, figure);
        CHECK(member(found, "molecule").number == Approx(member(found, "beam").number).epsilon(0.05));
    }
    json.insert(json.end(), {"--frequency", "5"});
    json.erase(json.begin() + 5, json.begin() + 7);
    CHECK(runShoal(json).json().find("standsFor") == nullptr);
}

TEST_CASE("molecule from-mesh: the shipped minnow is what its command makes", "[cli][molecule]") {
    const Scratch scratch;
    const std::string out = scratch.path("minnow.json");
    std::filesystem::copy(sourceFile("molecules/minnow.png"), scratch / "minnow.png");
    const Outcome made = runShoal({"molecule", "from-mesh", minnow, "-o", out, "--rings", "6", "--texture",
                                   "minnow.png", "--name", "minnow", "--json"});
    INFO(made.err);
    REQUIRE(made.code == 0);
    const JsonValue report = made.json();
    CHECK(member(report, "vertices").number == 24);
    CHECK(member(report, "zeroModes").number == 0);
    CHECK(member(report, "skinError").number < 1e-5);
    CHECK(member(report, "warnings").items.empty());
    const JsonValue fresh = readJson(out), shipped = readJson(sourceFile("molecules/minnow.json"));
    CHECK(writeJson(member(fresh, "vertices")) == writeJson(member(shipped, "vertices")));
    CHECK(writeJson(member(fresh, "springs")) == writeJson(member(shipped, "springs")));
    // weights are least squares: to rounding
    const JsonValue &a = member(member(fresh, "skin"), "weights"),
                    &b = member(member(shipped, "skin"), "weights");
    REQUIRE(a.items.size() == b.items.size());
    REQUIRE(a.items[7].items.size() == b.items[7].items.size());
    for (size_t i = 0; i < a.items[7].items.size(); ++i)
        CHECK(a.items[7].items[i].number == Approx(b.items[7].items[i].number).margin(1e-6));
}

TEST_CASE("molecule from-mesh: a mesh of several materials comes with an image of their colours",
          "[cli][molecule][material]") {
    const Scratch scratch;
    std::string painted = tray;
    painted.insert(painted.find("f 1 4"), "mtllib tray.mtl\nusemtl red\n");
    painted.insert(painted.find("f 2 3"), "usemtl blue\n");
    const std::string file = scratch.write("tray.obj", painted), out = scratch.path("made.json");
    scratch.write("tray.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\nmap_Kd none.png\n");
    const Outcome made = runShoal({"molecule", "from-mesh", file, "-o", out});
    INFO(made.err);
    REQUIRE(made.code == 0);
    CHECK(made.out.find("coloured by an image of") != std::string::npos);
    CHECK(made.out.find("note: material \"blue\": its colour image is left out: there is no \"none.png\"") !=
          std::string::npos);
    CHECK(readFile(out).find("\"texture\": \"made.png\"") != std::string::npos);
    CHECK(runShoal({"check", out}).code == 0);
    // An image that is there already is kept, and so is the molecule.
    std::filesystem::remove(out);
    refusal({"molecule", "from-mesh", file, "-o", out}, "made.png: is there already");
    CHECK_FALSE(std::filesystem::exists(out));
    // A colour that is asked for needs none.
    REQUIRE(runShoal({"molecule", "from-mesh", file, "-o", scratch.path("green.json"), "--color", "green"})
                .code == 0);
    CHECK_FALSE(std::filesystem::exists(scratch.path("green.png")));
}

TEST_CASE("molecule new: every shape is a molecule without a warning, which runs", "[cli][molecule]") {
    const Scratch scratch;
    for (const std::string shape : {"sheet", "rod", "box", "cross", "tetrahedron", "fish"}) {
        INFO(shape);
        const std::string out = scratch.path(shape + ".json");
        const Outcome made = runShoal({"molecule", "new", out, "--shape", shape, "--json"});
        INFO(made.err);
        REQUIRE(made.code == 0);
        const JsonValue report = made.json();
        CHECK(member(report, "zeroModes").number == 0);
        CHECK(member(report, "warnings").items.empty());
        CHECK(runShoal({"check", out}).code == 0);
        CHECK(runShoal({"molecule", "show", out, "--capture", scratch.path("sheet.png")}).code == 0);
    }
    const std::string fine = scratch.path("fine.json");
    const Outcome made =
        runShoal({"molecule", "new", fine, "--divisions", "4", "--size", "0.5", "--pin", "z<0.01", "--json"});
    REQUIRE(made.code == 0);
    CHECK(member(made.json(), "vertices").number == 25);
    const JsonValue file = readJson(fine);
    int pinned = 0;
    for (const JsonValue& vertex : member(file, "vertices").items)
        pinned += vertex.find("pinned") != nullptr;
    CHECK(pinned == 5);
    refusal({"molecule", "new", fine}, "is there already: give --force");
    refusal({"molecule", "new", scratch.path("x.json"), "--shape", "rodd"}, "did you mean \"rod\"?");
    refusal({"molecule", "new", scratch.path("x.json"), "--divisions", "99"},
            "takes 1 to 14 divisions, found 99");
    CHECK_FALSE(std::filesystem::exists(scratch.path("x.json")));
}

TEST_CASE("molecule from-mesh: runs what it writes, and writes nothing that does not run",
          "[cli][molecule]") {
    const Scratch scratch;
    const std::string out = scratch.path("fish.json"), page = scratch.path("fish.html");
    const Outcome made = runShoal({"molecule", "from-mesh", minnow, "-o", out, "--vertices", "12",
                                   "--pin-near", "0.5,0.5,1", "--report", page, "--json"});
    INFO(made.err);
    REQUIRE(made.code == 0);
    const JsonValue report = made.json(), trial = member(report, "trial");
    CHECK(member(trial, "substeps").number == 4);
    CHECK(member(trial, "change").number > 0);
    CHECK(member(trial, "change").number < 0.5);
    CHECK(member(trial, "speed").number < 1);
    const std::string text = readFile(page);
    CHECK(text.find("<!DOCTYPE html>") == 0);
    CHECK(text.find("data:image/png;base64,iVBORw0KGgo") != std::string::npos);
    CHECK(text.find("two seconds above a floor: ") != std::string::npos);
    CHECK(text.find("(1 pinned)") != std::string::npos);
    // The tail is at the far end.
    const JsonValue file = readJson(out);
    double pinned = 0, last = 0;
    for (const JsonValue& vertex : member(file, "vertices").items) {
        const double z = member(vertex, "position").items.at(2).number;
        last = std::max(last, z);
        if (vertex.find("pinned") != nullptr) pinned = z;
    }
    CHECK(pinned == last);

    const std::string stiff = scratch.path("stiff.json");
    // Nothing is wrong with a line of a file that was never there.
    const std::string light = refusal({"molecule", "new", stiff, "--mass", "1e-30"},
                                      "is not written, because the molecule does not run: expected a number");
    CHECK_THAT(light, Catch::Contains("(at $.defaults.stiffness)") && !Catch::Contains("stiff.json:6"));
    refusal({"molecule", "from-mesh", minnow, "--report", scratch.path("page.txt")}, "ending in .html");
    refusal({"molecule", "from-mesh", minnow, "--pin-near", "1,2"}, "--pin-near: expected a point");
    CHECK(filesIn(scratch.folder().string()) == std::vector<std::string>{"fish.html", "fish.json"});
}

TEST_CASE("molecule from-mesh: leaves files alone", "[cli][molecule]") {
    const Scratch scratch;
    const std::string out = scratch.write("there.json", "mine");
    refusal({"molecule", "from-mesh", minnow, "-o", out}, "is there already: give --force");
    CHECK(readFile(out) == "mine");
    CHECK(runShoal({"molecule", "from-mesh", minnow, "-o", out, "--force", "--no-skin"}).code == 0);
    CHECK(readFile(out).find("shoal-molecule-1") != std::string::npos);
    CHECK(readFile(out).find("skin") == std::string::npos);
    // a disk that is full half way
    const std::string full = scratch.path("full.json");
    refusal({"molecule", "from-mesh", minnow, "-o", full}, "full.json", {.largestFile = 5000});
    CHECK(filesIn(scratch.folder().string()) == std::vector<std::string>{"there.json"});
    refusal({"molecule", "from-mesh", minnow, "-o", "/proc/nothing/out.json"}, "/proc/nothing");
    refusal({"molecule", "from-mesh", minnow, "-o", scratch.folder().string()}, "ending in .json");
    refusal({"molecule", "from-mesh", minnow, "-o", scratch.path("out.obj")}, "ending in .json");
    const Outcome shown = runShoal({"molecule", "from-mesh", minnow});
    CHECK(shown.code == 0);
    CHECK(shown.out.find("not written") != std::string::npos);
}

TEST_CASE("molecule from-mesh: refuses in one line", "[cli][molecule]") {
    const Scratch scratch;
    const std::string open = scratch.write("tray.obj", tray);
    const auto refuses = [](Words more, const std::string& part) {
        Words words = {"molecule", "from-mesh"};
        words.insert(words.end(), more.begin(), more.end());
        refusal(words, part);
    };
    refuses({"nowhere.obj"}, "nowhere.obj: no such file");
    refuses({scratch.folder().string()}, "is a folder");
    refuses({scratch.write("text.obj", "nothing here\n")}, "text.obj");
    refuses({scratch.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")}, "has no triangles");
    refuses({open, "--springs", "lattice"}, "this mesh has none: 4 border edges");
    refuses({open, "--springs", "latice"}, "did you mean \"lattice\"");
    refuses({open, "--vertices", "1000"}, "takes too long to make: at most 227");
    refuses({open, "--vertices", "many"}, "expected a whole number");
    refuses({open, "--vertices", "-4"}, "--vertices: expected at least 4, found -4");
    refuses({open, "--size", "0"}, "--size: expected a number above 0");
    refuses({open, "--size", "nan"}, "--size: expected a number above 0");
    refuses({open, "--mass", "heavy"}, "expected a number");
    refuses({open, "--modulus", "-1"}, "--modulus: expected a number above 0");
    refuses({open, "--frequency", "5", "--thickness", "1e-3"},
            "--frequency: expected either a frequency or a thickness, found both");
    refuses({minnow, "--thickness", "1e-3"}, "minnow.obj: a body is as thick as it is");
    refuses({open, "--material", "leef"}, "did you mean \"leaf\"");
    refuses({open, "--pin", "y=1"}, "--pin: expected a rule such as y<0.1");
    refuses({open, "--pin-name", "cup"}, "no object, mesh, material or bone \"cup\"; it has tray");
    refuses({open, "--pin-paint", "rde"}, "--pin-paint: expected a colour");
    refuses({open, "--pin-paint", "red"}, "no vertex colours");
    refuses({open, "-o", scratch.path("a.json"), "--texture", "none.png"}, "none.png");
    refuses({open, "--verices", "4"}, "unknown option --verices (did you mean \"--vertices\"?)");
    refusal({"molecule", "from-mash", open}, "unknown command \"from-mash\" (did you mean \"from-mesh\"?)");
    refusal({"molecule"}, "subcommand is required");
    CHECK(filesIn(scratch.folder().string()).size() == 3);
}
