// The pure parts of `shoal bench`: what is measured, how a group is spread over rounds, what the times mean.
#include <algorithm>
#include <numeric>
#include <set>

#include "bench/reports.h"
#include "support/catch.h"

namespace shoal::bench {

namespace {

BenchResult result(const char* group, const char* label, Subject subject, int count, double seconds) {
    BenchResult out;
    out.benchCase.group = group;
    out.benchCase.label = label;
    out.benchCase.molecule = "quad";
    out.benchCase.count = count;
    out.benchCase.subject = subject;
    out.frame = {seconds, seconds * 1.25, 10};
    out.stateBytes = size_t(count) * 208;
    out.movedBytes = size_t(count) * 200;
    return out;
}

std::vector<BenchResult> someResults() {
    const char* group = "131,072 quads";
    return {result(group, "fused", Subject::fused, 131072, 0.006),
            result(group, "ping-pong", Subject::pingPong, 131072, 0.12),
            result(group, "AVX-512", Subject::avx512, 131072, 0.002),
            result(group, "AVX2", Subject::avx2, 131072, 0.003),
            result(group, "copy, buffer", Subject::bufferCopy, 131072, 0.003),
            result(group, "copy, memory", Subject::memoryCopy, 131072, 0.001),
            result("16,384 quads", "fused", Subject::fused, 16384, 0.001)};
}

const Target& named(const std::vector<Target>& all, const std::string& what) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Target& t) { return t.what == what; });
    REQUIRE(found != all.end());
    return *found;
}

}  // namespace

TEST_CASE("minimum and median of times", "[bench]") {
    CHECK(measure::spreadOf({}).samples == 0);
    CHECK(measure::spreadOf({}).median == 0);
    const measure::Spread odd = measure::spreadOf({3, 1, 9});
    CHECK((odd.min == 1 && odd.median == 3 && odd.samples == 3));
    CHECK(measure::spreadOf({4, 1, 2, 9}).median == 3);
}

TEST_CASE("a part is begun only where it ends in time at the pace of those before", "[bench]") {
    CHECK(fitsAtPace(30, 0, 0, 30));
    CHECK_FALSE(fitsAtPace(31, 0, 0, 30));
    CHECK(fitsAtPace(10, 10, 20, 40));  // half as fast as expected
    CHECK_FALSE(fitsAtPace(10, 10, 20, 39));
    CHECK(fitsAtPace(10, 10, 5, 15));  // one that was faster promises nothing
    CHECK_FALSE(fitsAtPace(10, 10, 5, 14));
}

TEST_CASE("what there was no time for stands in the reports", "[bench]") {
    BenchReport report;
    CHECK_THAT(asText(report), !Catch::Contains("Left out"));
    report.leftOut = {"16,384 fish", "errors"};
    CHECK_THAT(asText(report),
               Catch::Contains("the time of --quick was over") && Catch::Contains("16,384 fish; errors.\n"));
    CHECK(asJson(report).find("leftOut")->items.size() == 2);
}

TEST_CASE("the table of contact says what room a density leaves to a quad", "[bench]") {
    CollideReport report;
    for (const ContactCase& one : contactCases(true))
        report.contact.push_back({.benchCase = one, .leftOut = "not measured"});
    CHECK_THAT(asText(report), Catch::Contains("moderate: 0.0277 m³ a quad, dense: 0.00337 m³ a quad"));
}

TEST_CASE("every case has a name of its own and those of a group share molecules", "[bench]") {
    for (const bool quick : {false, true}) {
        const std::vector<BenchCase> all = benchCases(quick);
        std::set<std::string> names;
        for (const BenchCase& one : all)
            CHECK(names.insert(one.name()).second);
        std::set<std::string> groups;
        for (const std::vector<BenchCase>& group : byGroup(all)) {
            CHECK(groups.insert(group.front().group).second);  // a group is all in one place
            for (const BenchCase& one : group)
                CHECK((one.molecule == group.front().molecule && one.count == group.front().count));
        }
    }
    CHECK(grouped(7) == "7");
    CHECK(grouped(1024) == "1,024");
    CHECK(grouped(1048576) == "1,048,576");
}

TEST_CASE("the benchmark's scenes compile at their step", "[bench]") {
    const BenchMolecules molecules(SHOAL_SOURCE_DIR "/molecules");
    CHECK(molecules.cloth.vertices.size() == 64);
    for (BenchCase one : benchCases(false)) {
        one.count = 3;
        const Molecule& molecule = molecules.named(one.molecule);
        CAPTURE(one.name());
        CHECK(fitsBaseline(molecule));
        const Plan plan = compile(benchScene(one, molecule));
        CHECK(plan.substeps == one.substeps);
        CHECK(plan.groups.at(0).start.positions.size() == 3 * molecule.vertices.size());
        CHECK(fusedBytesPerFrame(plan, true) >= fusedBytesPerFrame(plan, false));
    }
}

TEST_CASE("the baseline's step is the scene's", "[bench]") {
    BenchCase one;
    one.substeps = 16;
    const Scene scene = benchScene(one, cloth(2));
    const BaselineStep step = baselineStep(scene);
    CHECK(step.substeps == 16);
    CHECK(step.h == Approx(1.0 / 960));
    CHECK(step.wind == glm::vec3(2, 0, 0.5f));
    CHECK(step.gravity == glm::vec3(scene.gravity));
    CHECK(step.decay == Approx(1 - std::exp(-1.0 / 960)));
    CHECK(step.phi == Approx(step.decay));  // the rate is 1/s
    CHECK(step.restitution == float(scene.colliders[0].restitution));
}

TEST_CASE("all begin in the same place, some of them on the ground", "[bench]") {
    const BenchMolecules molecules(SHOAL_SOURCE_DIR "/molecules");
    BenchCase one;
    one.molecule = "quad";
    one.count = 400;
    const BenchStart start(one, molecules.quad, 1);
    REQUIRE(start.positions.size() == 1600);
    int low = 0;
    for (size_t i = 0; i < start.positions.size(); ++i) {
        CHECK(start.packed.anchors[i / 4] + start.packed.positions[i] == start.positions[i]);
        if (start.positions[i].y < 0.01f) ++low;
    }
    CHECK(start.packed.velocities == start.velocities);
    CHECK(low > 10);
    CHECK(low < 800);
}

TEST_CASE("slow cases sit out rounds, evenly, and never too often", "[bench]") {
    measure::Schedule schedule;
    schedule.seconds = 3;
    schedule.leastSamples = 3;
    schedule.mostSamples = 40;
    const measure::VisitPlan plan = measure::planVisits({0.001, 0.1, 5}, schedule);
    CHECK(plan.samples == std::vector<int>{40, 10, 3});
    CHECK(plan.rounds == 40);
    CHECK(plan.seconds == Approx(0.04 + 1 + 15));
    for (size_t i = 0; i < plan.samples.size(); ++i) {
        int visits = 0, last = -1, widest = 0;
        for (int round = 0; round < plan.rounds; ++round) {
            if (!plan.visits(i, round)) continue;
            ++visits;
            widest = std::max(widest, round - last);
            last = round;
        }
        CHECK(visits == plan.samples[i]);
        CHECK(widest <= (plan.rounds + plan.samples[i] - 1) / plan.samples[i]);
    }
}

TEST_CASE("with patience what is slow is visited less often, or not at all", "[bench]") {
    measure::Schedule schedule;
    schedule.seconds = 0.3;
    schedule.patience = 1;
    const measure::VisitPlan plan = measure::planVisits({0.001, 0.2, 0.4, 5}, schedule);
    CHECK(plan.samples == std::vector<int>{75, 3, 2, 0});
    CHECK(plan.rounds == 75);
    int visits = 0;
    measure::takeTurns(plan, [&](size_t i) { visits += i == 3; });
    CHECK(visits == 0);
}

TEST_CASE("ratios compare a case with its own group", "[bench]") {
    std::vector<BenchResult> all = someResults();
    const Ratios fused = ratiosOf(all[0], all);
    CHECK(fused.avx512.value() == Approx(3));
    CHECK(fused.avx2.value() == Approx(2));
    CHECK(fused.pingPong.value() == Approx(20));
    CHECK(fused.bandwidth.value() == Approx(131072.0 * 200 / 0.006));
    CHECK(fused.shareOfCopy.value() == Approx(0.5));                  // of the device's copy
    CHECK(ratiosOf(all[2], all).shareOfCopy.value() == Approx(0.5));  // of the processor's
    CHECK_FALSE(ratiosOf(all[4], all).avx512);
    CHECK_FALSE(ratiosOf(all[6], all).avx512);  // alone in its group
    all[0].benchCase.wind = Wind::gusts;
    CHECK_FALSE(ratiosOf(all[0], all).avx512);
    all[0].benchCase.wind = Wind::uniform;
    all[0].benchCase.substeps = 16;
    CHECK_FALSE(ratiosOf(all[0], all).avx512);
    CHECK_FALSE(ratiosOf(all[0], all).pingPong);
    BenchResult out = result("131,072 quads", "x", Subject::fused, 131072, 0);
    CHECK_FALSE(ratiosOf(out, all).avx512);
}

TEST_CASE("targets hold, do not hold, or were not measured", "[bench]") {
    std::vector<BenchResult> all = someResults();
    all[2].frame.median = all[0].frame.median / 5;
    const std::vector<Target> found = targets(all, true);
    const Target& avx512 = named(found, "fused over the AVX-512 limit, 131,072 quads");
    CHECK(avx512.holds());
    CHECK(avx512.measured.value() == Approx(3));
    CHECK(avx512.ofMedians.value() == Approx(5));
    const Target& faster = named(found, "fused faster than ping-pong, 131,072 quads");
    CHECK(faster.holds());
    all[1].frame.min = 0.05;
    CHECK_FALSE(named(targets(all, true), faster.what).holds());
    const Target& crosses = named(found, "fused over the AVX-512 limit, 16,384 crosses");
    CHECK_FALSE(crosses.measured);
    CHECK_FALSE(crosses.holds());
    const std::string flat = "fused, slowest over fastest time per quad from 16,384 to 1,048,576";
    CHECK_FALSE(named(found, flat).measured);
    all.push_back(result("1,048,576 quads", "fused", Subject::fused, 1048576, 0.048));
    CHECK(named(targets(all, true), flat).measured.value() == Approx(0.001 / 16384 / (0.006 / 131072)));
    CHECK(named(found, "device memory of a quad, two sides").holds());
    CHECK(named(found, "state over the bus a frame, fused").holds());
    all[0].busStateBytes = 4;
    CHECK_FALSE(named(targets(all, true), "state over the bus a frame, fused").holds());
}

TEST_CASE("the share of the bandwidth is a target of GPUs", "[bench]") {
    std::vector<BenchResult> all = {
        result("1,048,576 quads", "fused", Subject::fused, 1048576, 0.004),
        result("1,048,576 quads", "copy, buffer", Subject::bufferCopy, 1048576, 0.003)};
    const std::string what = "share of the copy bandwidth, fused, 1,048,576 quads";
    const std::vector<Target> gpu = targets(all, false), software = targets(all, true);
    CHECK(named(gpu, what).measured.value() == Approx(0.75));
    CHECK(named(gpu, what).holds());
    CHECK(std::none_of(software.begin(), software.end(), [&](const Target& t) { return t.what == what; }));
}

TEST_CASE("arithmetic is compared with multiply-adds, and disturbances are counted", "[bench]") {
    std::vector<BenchResult> all = someResults();
    CHECK(disturbed(all) == 0);
    CHECK(distances(all).empty());
    all[0].operations = 6e9;
    all.push_back(result("131,072 quads", "multiply-adds", Subject::multiplyAdd, 131072, 0.04));
    all.back().operations = 4e10;
    all.back().movedBytes = 0;
    all.back().frame.median = 1;
    CHECK(disturbed(all) == 1);
    CHECK(ratiosOf(all[0], all).arithmetic.value() == Approx(1e12));
    CHECK(ratiosOf(all[0], all).shareOfPeak.value() == Approx(1));
    CHECK_FALSE(ratiosOf(all[2], all).shareOfPeak);  // the baseline is on another device
    CHECK_FALSE(ratiosOf(all.back(), all).avx512);
    REQUIRE(distances(all).size() == 1);
    CHECK_THAT(distances(all)[0], Catch::Contains("1e+03 Gflop/s, 100% of multiply-adds alone"));
    BenchCase one;
    one.count = 10;
    CHECK(operationsPerFrame(one, cloth(2)) == Approx(10 * 4 * (6 * 35 + 4 * 18)));
    one.wind = Wind::gusts;
    CHECK(operationsPerFrame(one, cloth(2)) == 0);
}

TEST_CASE("an error finds the case that says how fast it is", "[bench]") {
    std::vector<BenchResult> all = someResults();
    BenchError error;
    CHECK(speedOf(error, 131072, all) == &all[0]);
    CHECK(speedOf(error, 16384, all) == &all[6]);
    error.subject = Subject::pingPong;
    CHECK(speedOf(error, 131072, all) == &all[1]);
    error.solver = SolverKind::leapfrog;
    CHECK(speedOf(error, 131072, all) == nullptr);
}

}  // namespace shoal::bench
