// `shoal field`.
#include <filesystem>

#include "cli/shoal_command.h"
#include "core/image.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

const char* const crate =
    "o crate\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

}  // namespace

TEST_CASE("field: reports a model, from the cache the second time", "[cli][field]") {
    const Scratch scratch;
    const std::string model = scratch.write("crate.obj", crate);
    const Surroundings surroundings{.environment = {{"SHOAL_CACHE", scratch.path("cache")}}};
    const Outcome first = runShoal({"field", model, "--resolution", "16", "--json"}, surroundings);
    INFO(first.err);
    REQUIRE(first.code == 0);
    const JsonValue json = first.json(), &field = json.items.at(0);
    CHECK(member(field, "name").text == "crate");
    CHECK(member(field, "triangles").number == 12);
    CHECK(member(field, "closed").boolean);
    CHECK(member(field, "resolution").number == 16);
    CHECK(member(field, "cell").number == 0.0625);
    CHECK_FALSE(member(field, "cached").boolean);
    CHECK(member(member(field, "error"), "most").number < 0.03);
    CHECK(member(member(field, "error"), "rms").number > 0);
    const Outcome again = runShoal({"field", model, "--resolution", "16"}, surroundings);
    CHECK(again.out.find("from the cache") != std::string::npos);
    CHECK(again.out.find("closed") != std::string::npos);
    CHECK(again.err.empty());
}

TEST_CASE("check and run bake no field for a substep that is too long", "[cli][field]") {
    const Scratch scratch;
    scratch.write("crate.obj", crate);
    scratch.write("stiff.json", R"({"format": "shoal-molecule-1", "name": "stiff",
 "defaults": {"mass": 0.01, "stiffness": 10000}, "vertices": [{"position": [0, 0, 0]},
 {"position": [0.1, 0, 0]}], "springs": [{"a": 0, "b": 1}]})");
    const std::string scene = scratch.write("s.scene.json", R"({"format": "shoal-scene-1",
 "solver": {"method": "leapfrog", "substeps": 1}, "models": [{"name": "crate", "file": "crate.obj"}],
 "colliders": [{"type": "distanceField", "model": "crate", "resolution": 8}],
 "groups": [{"molecule": "stiff.json", "place": {"on": "list", "items": [{"position": [0, 3, 0]}]}}]})");
    const Surroundings surroundings{.environment = {{"SHOAL_CACHE", scratch.path("cache")}}};
    const auto isBaked = [&] {
        if (!std::filesystem::exists(scratch / "cache")) return false;
        for (const auto& entry : std::filesystem::directory_iterator(scratch / "cache"))
            if (entry.path().extension() == ".shoal-field") return true;
        return false;
    };
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"check", scene}, {"run", scene, "--headless", "--frames", "1"}}) {
        const Outcome refused = runShoal(command, surroundings);
        INFO(refused.err);
        CHECK(refused.code == 1);
        CHECK(refused.err.find("use at least") != std::string::npos);
        CHECK_FALSE(isBaked());
    }
    const Outcome mended =
        runShoal({"run", scene, "--headless", "--frames", "1", "--substeps", "40"}, surroundings);
    INFO(mended.err);
    CHECK(mended.code == 0);
    CHECK(isBaked());
}

TEST_CASE("field: draws a slice", "[cli][field]") {
    const Scratch scratch;
    const std::string model = scratch.write("crate.obj", crate), picture = scratch.path("slice.png");
    const Outcome outcome = runShoal({"field", model, "--resolution", "24", "--capture", picture, "--slice",
                                      "y=0.25", "--size", "400x300"});
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("the slice y = 0.25 m") != std::string::npos);
    const Image image = readPng(picture);
    CHECK(image.width <= 400);
    CHECK(image.height <= 300);
    const auto pixel = [&](int x, int y, int channel) {
        return int(image.pixels[(size_t(y) * size_t(image.width) + size_t(x)) * 4 + size_t(channel)]);
    };
    const int middleX = image.width / 2, middleY = (12 + image.height - 44) / 2;
    CHECK(pixel(middleX, middleY, 2) > pixel(middleX, middleY, 0) + 50);  // inside: blue
    const int corner = image.width / 2 - 115;
    CHECK(pixel(corner, 16, 0) > pixel(corner, 16, 2) + 50);  // outside: ochre
}

TEST_CASE("field: warns and refuses in one line", "[cli][field]") {
    const Scratch scratch;
    const std::string model = scratch.write("crate.obj", crate);
    std::string open = crate;
    open.resize(open.rfind("f 4"));
    const Outcome outcome = runShoal({"field", scratch.write("open.obj", open), "--resolution", "16"});
    CHECK(outcome.code == 0);
    REQUIRE(outcome.messages().size() == 1);
    CHECK(outcome.messages()[0].find("4 border edges, the first at (") != std::string::npos);
    CHECK(outcome.out.find("a shell 0.125 m thick") != std::string::npos);

    refusal({"field", model, "--resolution", "16", "--error", "0.1"}, "--resolution excludes --error");
    refusal({"field", model, "--resolution", "2"}, "expected a whole number from 4 to 2048, found \"2\"");
    refusal({"field", model, "--resolution", "500"}, "at most resolution 248 fits");
    refusal({"field", model, "--error", "-1"}, "--error");
    refusal({"field", model, "--slice", "w=1", "--capture", "a.png"}, "expected x, y or z and a position");
    refusal({"field", model, "--slice", "x=1"}, "--slice requires --capture");
    refusal({"field", model, "--slice", "x=9", "--capture", scratch.path("a.png"), "--resolution", "8"},
            "outside of the grid");
    refusal({"field", model, "--capture", "a.jpg"}, ".png");
    refusal({"field", scratch.path("no.obj")}, "no such file");
    refusal({"field", squaresScene()}, "has no collider of type \"distanceField\"");
    refusal({"field", squaresScene(), "--resolution", "8"}, "a scene has its own");
}
