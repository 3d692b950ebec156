// Tests limits: `run` takes what `check` takes; what a context cannot hold is refused with its place and the
// limit; and --sandbox.
#include <filesystem>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

namespace {

std::string sceneOf(const std::string& groups) {
    return R"({"format": "shoal-scene-1", "groups": [)" + groups + "]}";
}

std::string boxed(const std::string& keys) {
    return R"({"molecule": "blade.json", )" + keys +
           R"("place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [0.1, 0.1, 0.1]}}})";
}

}  // namespace

TEST_CASE("Names of 245 characters and more run, headless and with pictures", "[cli]") {
    const Scratch scratch;
    scratch.write("blade.json", smallMolecule);
    std::string molecule = smallMolecule;
    molecule.replace(molecule.find("blade"), 5, std::string(245, 'm'));
    scratch.write("long.json", molecule);
    std::string second = boxed(R"("count": 2, )");
    second.replace(second.find("blade.json"), 10, "long.json");
    const std::string scene = scratch.write(
        "a.scene.json",
        sceneOf(boxed(R"("count": 2, "name": ")" + std::string(245, 'g') + "\", ") + ", " + second));
    CHECK(runShoal({"check", scene}).code == 0);
    const Outcome run = runShoal({"run", scene, "--headless", "--frames", "2", "--size", "64x64", "--capture",
                                  scratch.path("out"), "--export", scratch.path("out/a.csv")});
    INFO(run.err);
    CHECK(run.code == 0);
}

TEST_CASE("check tells of molecules with contact that start in one place", "[cli]") {
    const Scratch scratch;
    scratch.write("blade.json", smallMolecule);
    const std::string crowded = scratch.write(
        "a.scene.json", sceneOf(boxed(R"("name": "snow", "count": 2000, "contact": {"radius": 0.5}, )")));
    const Outcome warned = runShoal({"check", crowded});
    CHECK(warned.code == 0);
    CHECK_THAT(warned.out, Catch::Contains("start crowded") && Catch::Contains("snow"));
    const std::string apart = scratch.write(
        "b.scene.json", sceneOf(boxed(R"("name": "snow", "count": 10, "contact": {"radius": 0.05}, )")));
    CHECK_THAT(runShoal({"check", apart}).out, !Catch::Contains("start crowded"));
}

TEST_CASE("A texture that is missing is told at the molecule that names it", "[cli]") {
    const Scratch scratch;
    std::string molecule = smallMolecule;
    molecule.replace(molecule.find("\"color\""), 7, R"("texture": "none.png", "color")");
    const std::string file = scratch.write("blade.json", molecule);
    const std::string scene = scratch.write("a.scene.json", sceneOf(boxed(R"("count": 2, )")));
    for (const std::string& one : {file, scene}) {
        const std::string message = refusal({"check", one}, "none.png");
        CHECK_THAT(message, Catch::Contains("blade.json") && Catch::Contains("$.material.texture") &&
                                Catch::Contains("no such file"));
    }
    CHECK(runShoal({"run", scene, "--headless", "--frames", "1", "--size", "32x32", "--capture",
                    scratch.path("out")})
              .err.find("$.material.texture") != std::string::npos);
}

TEST_CASE("--sandbox keeps commands within the folder of their file", "[cli]") {
    const Scratch scratch;
    scratch.write("blade.json", smallMolecule);
    std::string group = boxed(R"("count": 2, )");
    const std::string inside = scratch.write("own/in.scene.json", sceneOf(group));
    scratch.write("own/blade.json", smallMolecule);
    group.replace(group.find("blade.json"), 10, "../blade.json");
    const std::string outside = scratch.write("own/out.scene.json", sceneOf(group));
    for (const char* command : {"check", "explain"}) {
        CHECK(runShoal({command, outside}).code == 0);
        CHECK(runShoal({command, inside, "--sandbox"}).code == 0);
        refusal({command, outside, "--sandbox"}, "out.scene.json:1:");
    }
    const Words run = {"run",      inside,      "--headless",
                       "--frames", "1",         "--size",
                       "32x32",    "--capture", scratch.path("pictures"),
                       "--sandbox"};
    const Outcome ran = runShoal(run);
    INFO(ran.err);
    CHECK(ran.code == 0);
    CHECK(runShoal({"run", squaresScene(), "--headless", "--frames", "1", "--json", "--sandbox"}).code == 0);
    refusal({"run", outside, "--headless", "--frames", "1", "--json", "--sandbox"}, "--sandbox");
    std::filesystem::create_symlink(scratch / "blade.json", scratch / "own/link.json");
    refusal({"check", scratch.path("own/link.json"), "--sandbox"}, "--sandbox");
    refusal(
        {"molecule", "show", scratch.path("own/link.json"), "--capture", scratch.path("a.png"), "--sandbox"},
        "--sandbox");
}
