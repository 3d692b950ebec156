// `shoal bench particles`: what it reports. Times are never judged.
#include <cmath>

#include "cli/shoal_command.h"
#include "support/catch.h"

using namespace shoal;
using namespace shoal::test;

namespace {

Words quick(const std::string& only, const Words& more = {}) {
    Words out = {"bench", "particles", "--quick", "--only", only, "--seconds", "0.05"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

std::vector<JsonValue> casesOf(const JsonValue& report) {
    std::vector<JsonValue> out;
    for (const JsonValue& one : member(report, "cases").items)
        if (!one.find("leftOut")) out.push_back(one);
    return out;
}

}  // namespace

TEST_CASE("bench particles reports motion with its error", "[cli][bench particles]") {
    const Outcome outcome = runShoal(quick("motion, 128", {"--json"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    for (const char* key : {"version", "processor", "cores", "renderer", "openGL", "secondsAGroup"})
        member(report, key);
    double leapfrog = 0, euler = 0, loop = 0;
    for (const JsonValue& one : casesOf(report)) {
        const std::string label = member(one, "case").text;
        CAPTURE(label);
        CHECK(member(one, "group").text == "motion, 128 x 128");
        CHECK(member(one, "side").number == 128);
        CHECK(member(one, "samples").number >= 3);
        CHECK(member(one, "minSeconds").number > 0);
        CHECK(member(one, "medianSeconds").number >= member(one, "minSeconds").number);
        const bool isLoop = label.find("loop") == 0;
        // three floats a particle go up from the loop, nothing from the GPU's
        CHECK(member(one, "busBytesPerFrame").number == (isLoop ? 128 * 128 * 12 : 0));
        if (label == "fused, leapfrog") leapfrog = member(one, "positionError").number;
        if (label == "fused, euler") euler = member(one, "positionError").number;
        if (isLoop) loop = member(one, "positionError").number;
    }
    if (leapfrog == 0) return;  // no compute shaders here
    // order 2, h = 1/60 s: h^2 / 12 of the change of the acceleration, 6.4 m/s^2 in this second
    const double expected = 6.4 / 3600 / 12;
    CHECK(leapfrog == Approx(expected).epsilon(0.1));
    CHECK(loop == Approx(leapfrog).epsilon(0.05));
    CHECK(euler > 100 * leapfrog);
}

TEST_CASE("bench particles reports births of every allocator", "[cli][bench particles]") {
    const Outcome outcome = runShoal(quick("births", {"--json"}));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    const JsonValue report = outcome.json();
    size_t allocators = 0;
    for (const JsonValue& one : casesOf(report)) {
        const JsonValue* allocator = one.find("allocator");
        if (!allocator) continue;
        ++allocators;
        const double turnover = member(one, "turnover").number, all = 128 * 128;
        CAPTURE(allocator->text, turnover);
        CHECK(member(one, "bornPerFrame").number == Approx(turnover * all).epsilon(0.02));
        CHECK(member(one, "living").number == Approx(all).epsilon(0.1));
        CHECK(member(one, "packing").number >= 1);
        const double bus = member(one, "busBytesPerFrame").number;
        if (allocator->text == "gpu" || allocator->text == "ring")
            CHECK(bus == 0);
        else
            CHECK(bus == Approx(4 * turnover * all).epsilon(0.02));
    }
    // of each allocator at two turnovers, with compute shaders and in fragments or without the former
    REQUIRE((allocators == 16 || allocators == 8));
    CHECK(member(report, "birthCosts").items.size() == allocators / 2 + 1);
    int packed = 0;
    for (const JsonValue& target : member(report, "targets").items)
        if (member(target, "target").text.find("heap") == 0) {
            ++packed;
            CHECK(member(target, "measured").number <= member(target, "atMost").number);
        }
    CHECK(packed == int(allocators / 4));
}

TEST_CASE("bench particles prints tables and the papers", "[cli][bench particles]") {
    const Outcome outcome = runShoal(quick("height field, 128 x 128: "));
    INFO(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK_THAT(outcome.out, Catch::Contains("height field, 128 x 128") && Catch::Contains("UberFlow") &&
                                Catch::Contains("Radeon 9800") && Catch::Contains("Latta 2004") &&
                                Catch::Contains("loop on the CPU") &&
                                Catch::Contains("16,384 over a height field"));
}

TEST_CASE("bench particles refuses what it cannot do", "[cli][bench particles]") {
    CHECK_THAT(refusal({"bench", "particles", "--only", "squids"}, "nothing has \"squids\" in its name"),
               Catch::Contains("height field, 1024 x 1024"));
    refusal({"bench", "partcles"}, "did you mean \"particles\"?");
}
