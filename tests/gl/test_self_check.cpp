#include "simulate/self_check.h"

#include <filesystem>

#include "compile/path.h"
#include "core/file.h"
#include "feature_scenes.h"
#include "gl_test.h"
#include "gpu/program_cache.h"
#include "numerics.h"
#include "simulate/simulation.h"
#include "support/catch.h"
#include "support/scratch.h"

using namespace shoal;

namespace {

std::vector<Path> paths() {
    if (testContext().info().computeShaders) return {Path::fused, Path::fragments, Path::pingPong};
    return {Path::fragments, Path::pingPong};
}

}  // namespace

TEST_CASE("each path holds its self-check", "[self-check]") {
    for (const Path path : paths())
        for (const CheckedPart part : {CheckedPart::step, CheckedPart::contact}) {
            CAPTURE(name(path), int(part));
            CHECK(selfCheckError(testContext(), path, part) < selfCheckTolerance);
            CHECK(selfCheck(testContext(), path, part) == "");
        }
}

TEST_CASE("a path that computes wrongly is told of, kept by driver and shaders, and not taken by itself",
          "[self-check]") {
    test::Scratch scratch;
    const std::string usual = testContext().shaders();
    std::filesystem::copy(usual, scratch.path("shaders"), std::filesystem::copy_options::recursive);
    const std::string file = scratch.path("shaders/contact/response/prepare.pass.glsl");
    std::string text = readFile(file);
    const std::string kept = "putNextImpulses(slot, e, firstPart(known));";
    REQUIRE(text.find(kept) != std::string::npos);
    writeFile(file, text.replace(text.find(kept), kept.size(), "putNextImpulses(slot, e, vec4(0.0));"));
    testContext().setShaders(scratch.path("shaders"));
    const gpu::OtherCache cache(testContext(), scratch.path("cache"));
    const auto wrong = [](Path path) { return selfCheck(testContext(), path, CheckedPart::contact); };
    CHECK_THAT(wrong(Path::fragments), Catch::StartsWith("contact is off by "));
    CHECK(selfCheck(testContext(), Path::fragments, CheckedPart::step) == "");
    if (testContext().info().computeShaders) CHECK(wrong(Path::fused) == "");
    const auto files = std::distance(std::filesystem::directory_iterator(scratch.path("cache")), {});
    CHECK(files == (testContext().info().computeShaders ? 3 : 2));
    testContext().setShaders(usual);
    CHECK(wrong(Path::fragments) == "");
}

TEST_CASE("what a self-check finds wrong is passed over", "[self-check]") {
    const Plan plan = compile(test::sceneOf(test::shippedMolecule("quad"), SolverKind::leapfrog));
    PathLimits limits;
    limits.wrong[size_t(Path::fused)] = "the step is off by 8 mm";
    CHECK(choosePath(plan, Path::automatic, limits).path == Path::fragments);
    CHECK(choosePath(plan, Path::automatic, limits).why == "the step is off by 8 mm");
    CHECK(choosePath(plan, Path::fused, limits).path == Path::fused);
    limits.wrong[size_t(Path::fragments)] = "fragments too";
    CHECK(choosePath(plan, Path::automatic, limits).path == Path::pingPong);
    limits.wrong[size_t(Path::pingPong)] = "all of them";
    CHECK_THROWS_WITH(choosePath(plan, Path::automatic, limits),
                      "no path can run this scene: the step is off by 8 mm; all of them");
}
