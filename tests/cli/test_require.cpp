// What a run tells of itself at its end, and --require.
#include <filesystem>

#include "cli/shoal_command.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Words hello(const Words& more) {
    Words words{
        "run", sourceFile("models/hello/hello.scene.json"), "--headless", "--context", "egl", "--frames",
        "60"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

}  // namespace

TEST_CASE("a run tells strain and error at its end, and changes nothing by it", "[cli]") {
    const Outcome told = runShoal(hello({"--json"})),
                  silent = runShoal(hello({"--json", "--no-diagnostics"}));
    REQUIRE(told.code == 0);
    REQUIRE(silent.code == 0);
    CHECK(silent.json().find("diagnostics") == nullptr);
    CHECK(member(told.json(), "hash").text == member(silent.json(), "hash").text);
    CHECK(member(member(member(told.json(), "busBytes"), "frames"), "state").find("readBack")->number == 0);
    const JsonValue diagnostics = member(told.json(), "diagnostics");
    CHECK(member(diagnostics, "frame").number == 60);
    CHECK(member(diagnostics, "strain").number > member(diagnostics, "rmsStrain").number);
    CHECK(member(diagnostics, "errorMolecules").number > 0);
    CHECK(member(diagnostics, "errorDuration").number == Approx(1));
    CHECK(member(diagnostics, "error").number > 0);
    CHECK(member(diagnostics, "worstError").number >= member(diagnostics, "error").number);
    CHECK(member(diagnostics, "overlap").kind == JsonValue::Kind::null);
    CHECK_FALSE(member(diagnostics, "readings").items.empty());
    const Outcome timed = runShoal(hello({"--json", "--timings"}));
    CHECK(timed.json().find("diagnostics") == nullptr);
}

TEST_CASE("a run that does not hold to what is required ends with code 3 and whole files", "[cli]") {
    const Scratch scratch;
    const Outcome holds = runShoal(hello({"--require", "strain<10", "--require", "rmsStrain<5"}));
    CHECK(holds.code == 0);
    CHECK(holds.messages().empty());
    CHECK(holds.out.find("strain ") != std::string::npos);
    const Outcome broken =
        runShoal(hello({"--require", "strain<1e-9", "--export", scratch.path("end.csv"), "--json"}));
    CHECK(broken.code == 3);
    REQUIRE(broken.messages().size() == 1);
    CHECK(broken.messages()[0].find("shoal: --require strain<1e-9 does not hold: strain is ") == 0);
    CHECK(broken.messages()[0].find("frame 60, molecule ") != std::string::npos);
    CHECK(std::filesystem::exists(scratch.path("end.csv")));
    CHECK(member(broken.json(), "written").items.size() == 1);
}

TEST_CASE("a run ends at the first reading that does not hold", "[cli]") {
    const Outcome outcome = runShoal({"run", "hello", "--headless", "--context", "egl", "--count", "20000",
                                      "--frames", "1000000", "--require", "strain<1e-9", "--json"});
    CHECK(outcome.code == 3);
    CHECK(member(outcome.json(), "frames").number < 1000000);
    CHECK(member(member(outcome.json(), "diagnostics"), "readings").items.size() == 1);
}

TEST_CASE("requirements that a run cannot have are told in a line", "[cli]") {
    refusal(hello({"--require", "eror<1e-3"}),
            "--require: unknown quantity \"eror\" (did you mean \"error\"?)");
    refusal(hello({"--require", "error<abc"}), "expected a number above 0 behind \"error<\", found \"abc\"");
    refusal(hello({"--require", "error"}), "expected a quantity, \"<\" and a number");
    refusal(hello({"--require", "error<1", "--no-diagnostics"}), "--require excludes --no-diagnostics");
    const std::string lacks =
        refusal(hello({"--require", "overlap<1"}),
                "--require overlap<1: no group of the scene has contact between molecules");
    CHECK(lacks.find("hello.scene.json: ") != std::string::npos);
    const Outcome fountain = runShoal({"run", sourceFile("models/fountain/fountain.scene.json"), "--headless",
                                       "--frames", "2", "--count", "600", "--require", "error<1"});
    CHECK(fountain.code == 2);
    REQUIRE(fountain.messages().size() == 1);
    CHECK(fountain.messages()[0].find("fountain.scene.json:") != std::string::npos);
    CHECK(fountain.messages()[0].find("births and deaths") != std::string::npos);
}
