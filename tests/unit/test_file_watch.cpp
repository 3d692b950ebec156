#include "core/file_watch.h"

#include <filesystem>

#include "core/data_paths.h"
#include "core/file.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

// The time of a file, so many seconds from now: writes of a test follow one another faster than clocks tick.
void touch(const std::string& file, int seconds) {
    namespace fs = std::filesystem;
    fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::seconds(seconds));
}

using Files = std::vector<std::string>;

}  // namespace

TEST_CASE("a changed file is told once, when it has stood still", "[watch]") {
    const Scratch scratch;
    const std::string one = scratch.write("one.json", "1"), two = scratch.write("two.json", "2");
    FileWatch watch;
    watch.watch({one, two});
    CHECK(watch.changed(10).empty());
    scratch.write("one.json", "11");
    CHECK(watch.changed(10.1).empty());  // too soon to look
    CHECK(watch.changed(10.3).empty());  // seen, and may be half written
    scratch.write("one.json", "111");
    CHECK(watch.changed(10.6).empty());  // it was
    CHECK(watch.changed(10.9) == Files{one});
    CHECK(watch.changed(11.2).empty());
    // the same length, another time
    touch(two, 5);
    CHECK(watch.changed(11.5).empty());
    CHECK(watch.changed(11.8) == Files{two});
}

TEST_CASE("a file that is saved by renaming is never seen as gone, one that is gone is", "[watch]") {
    const Scratch scratch;
    const std::string file = scratch.write("one.json", "1"), other = scratch.path("other");
    FileWatch watch;
    watch.watch({file});
    CHECK(watch.changed(10).empty());
    std::filesystem::rename(file, other);
    CHECK(watch.changed(10.3).empty());
    CHECK(watch.changed(10.9).empty());
    scratch.write("one.json", "22");
    CHECK(watch.changed(11.2).empty());
    CHECK(watch.changed(11.5) == Files{file});
    std::filesystem::remove(file);
    CHECK(watch.changed(12).empty());
    CHECK(watch.changed(13).empty());
    CHECK(watch.changed(14.1) == Files{file});
    CHECK(watch.changed(17).empty());
}

TEST_CASE("one's own writing is no change, and watching others forgets none", "[watch]") {
    const Scratch scratch;
    const std::string one = scratch.write("one.json", "1"), two = scratch.write("two.json", "2");
    FileWatch watch;
    watch.watch({one});
    CHECK(watch.changed(10).empty());
    scratch.write("one.json", "own");
    watch.accept(one);
    CHECK(watch.changed(11).empty());
    CHECK(watch.changed(12).empty());
    scratch.write("one.json", "others'");
    watch.watch({one, two});
    CHECK(watch.size() == 2);
    CHECK(watch.changed(13).empty());
    CHECK(watch.changed(14) == Files{one});
}

TEST_CASE("a scene's files are those that it and its molecules name", "[watch]") {
    const Scratch scratch;
    const std::string molecule = scratch.write(
        "leaf.json", R"({"name": "leaf.png", "material": {"texture": "textures/../leaf.png"}})");
    const std::string image = scratch.write("leaf.png", "no image");
    const std::string model = scratch.write("tree.obj", "# a tree\nmtllib tree.mtl\nv 0 0 0\n");
    const std::string materials = scratch.write("tree.mtl", "");
    const std::string scene = scratch.write(
        "wood.scene.json",
        R"({"models": [{"file": "tree.obj"}], "groups": [{"molecule": "leaf.json", "name": "gone.json"}]})");
    CHECK(filesOf(scene) == Files{molecule, image, materials, model, scene});
    // numbered ones
    const std::string first = scratch.write("wind-01.vti", "x"), second = scratch.write("wind-12.vti", "x");
    scratch.write("wind-1.vti", "x");
    const std::string storm = scratch.write("storm.scene.json", R"({"file": "wind-##.vti"})");
    CHECK(filesOf(storm) == Files{storm, first, second});
    // molecules that ship
    const std::string shipped =
        scratch.write("shipped.scene.json", R"({"groups": [{"molecule": "leaf"}, {"molecule": "laef"}]})");
    const std::vector<std::string> named = filesOf(shipped);
    REQUIRE(named.size() > 1);
    CHECK(std::count(named.begin(), named.end(), moleculeFile("leaf", "")) == 1);
    // broken, it is still worth watching
    CHECK(filesOf(scratch.write("broken.scene.json", "{")) == Files{scratch.path("broken.scene.json")});
}
