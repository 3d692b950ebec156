// --sandbox: nothing outside some folders is opened, whatever names it.
#include "core/file.h"

#include <filesystem>
#include <span>

#include "compile/plan.h"
#include "core/image.h"
#include "geometry/mesh.h"
#include "molecule/molecule_file.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/small_scene.h"

using namespace shoal;
using shoal::test::Scratch;
namespace fs = std::filesystem;

namespace {

struct Within {
    explicit Within(const std::vector<fs::path>& folders) { openOnlyWithin(folders); }
    ~Within() { openOnlyWithin({}); }
};

std::string sceneWith(const std::string& parts) {
    return R"({"format": "shoal-scene-1", )" + parts + "}";
}

std::string groupOf(const std::string& molecule) {
    return R"("groups": [{"molecule": ")" + molecule +
           R"(", "count": 1, "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 1, 1]}}}])";
}

// A model whose corners lie in another file.
std::string triangleOf(const std::string& buffer) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": ")" +
           buffer + R"("}]})";
}

}  // namespace

TEST_CASE("A folder's files may be opened, and neither what is beside it nor what its links point to",
          "[sandbox]") {
    const Scratch scratch;
    scratch.write("own/a.json", "{}");
    scratch.write("ownership/b.json", "{}");
    scratch.write("secret.txt", "secret");
    fs::create_symlink(scratch / "secret.txt", scratch / "own/link.txt");
    fs::create_directory_symlink(scratch.folder(), scratch / "own/up");
    CHECK(mayOpen(scratch / "secret.txt"));
    const Within within({scratch / "own/"});
    CHECK(mayOpen(scratch / "own/a.json"));
    CHECK(mayOpen(scratch / "own/not-there/yet.json"));
    CHECK(mayOpen(scratch / "ownership/../own/a.json"));
    for (const char* outside : {"ownership/b.json", "secret.txt", "own/../secret.txt", "own/link.txt",
                                "own/up/secret.txt", "own/up/not-there.txt", ""})
        CHECK_FALSE(mayOpen(outside == std::string() ? fs::path() : scratch / outside));
    CHECK(messageOf([&] { readFile(scratch.path("own/link.txt")); }).find("--sandbox") != std::string::npos);
    CHECK(readFile(scratch.path("own/a.json")) == "{}");
}

TEST_CASE("Whatever a scene names outside its folder is refused, at the key that names it", "[sandbox]") {
    const Scratch scratch;
    scratch.write("blade.json", test::smallMolecule);
    scratch.write("wind.fga", test::smallField);
    scratch.write("wind-01.fga", test::smallField);
    scratch.write("wind-02.fga", test::smallField);
    scratch.write("hill.obj", test::smallModel);
    scratch.write("own/blade.json", test::smallMolecule);
    writePng(scratch / "image.png", Image{2, 2, 1, std::vector<uint8_t>(4, 255)});
    const auto refused = [&](const std::string& parts) {
        const std::string file = scratch.write("own/a.scene.json", sceneWith(parts));
        CHECK(messageOf([&] { readScene(file); }).empty());
        const Within within({scratch / "own"});
        const std::string message = messageOf([&] { readScene(file); });
        INFO(parts);
        CHECK_THAT(message, Catch::Contains("--sandbox"));
        CHECK_THAT(message, Catch::Contains("a.scene.json:1:"));
    };
    const std::string group = groupOf("blade.json");
    refused(groupOf("../blade.json"));
    refused(groupOf(scratch.path("blade.json")));
    refused(R"("fields": [{"type": "grid", "file": "../wind.fga"}], )" + group);
    refused(R"("models": [{"file": "../hill.obj"}], )" + group);
    refused(
        R"("colliders": [{"type": "heightField", "image": "../image.png", "low": [0, 0], "high": [1, 1],
           "heights": [0, 1]}], )" +
        group);
    refused(R"("groups": [{"particle": {"image": {"file": "../image.png"}}, "life": {"span": 1},
               "emitters": [{"from": "point", "rate": 1}]}])");
    fs::create_symlink(scratch / "blade.json", scratch / "own/link.json");
    refused(groupOf("link.json"));
}

TEST_CASE("Side files of models and molecules outside the folder are not opened", "[sandbox]") {
    const Scratch scratch;
    writePng(scratch / "image.png", Image{2, 2, 1, std::vector<uint8_t>(4, 255)});
    std::string textured = test::smallMolecule;
    textured.replace(textured.find("\"color\""), 7, R"("texture": "../image.png", "color")");
    const std::string molecule = scratch.write("own/blade.json", textured);
    const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    writeFile(scratch / "secret.bin", std::as_bytes(std::span(corners)));
    const std::string model = scratch.write("own/a.gltf", triangleOf("../secret.bin"));
    scratch.write("wind-01.fga", test::smallField);
    scratch.write("wind-02.fga", test::smallField);
    const std::string sequence = scratch.write(
        "own/a.scene.json",
        sceneWith(
            R"("fields": [{"type": "grid", "file": "../wind-##.fga", "sequence": {"frameRate": 1}}], )" +
            groupOf("blade.json")));
    CHECK(loadMesh(model).triangles.size() == 1);
    CHECK(readTexture(readMolecule(molecule)).width == 2);
    CHECK(messageOf([&] { readScene(sequence); }).empty());

    const Within within({scratch / "own"});
    CHECK_THAT(messageOf([&] { loadMesh(model); }), Catch::Contains("a.gltf"));
    const std::string message = messageOf([&] { readTexture(readMolecule(molecule)); });
    CHECK_THAT(message, Catch::Contains("--sandbox"));
    CHECK_THAT(message, Catch::Contains("$.material.texture"));
    CHECK_FALSE(messageOf([&] { readScene(sequence); }).empty());
    CHECK_FALSE(messageOf([&] { loadMesh(scratch.path("outside.obj")); }).empty());
}
