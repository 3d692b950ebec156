// The states of all scenes that ship, after a second on each path that takes them, to the bit: what is only
// moved or renamed changes none of them. tests/gl/state_hashes.txt has them for one driver; elsewhere nothing
// is compared.
//
// SHOAL_UPDATE_HASHES=1 writes that file anew, with the driver here.
#include <cstdlib>
#include <map>
#include <sstream>

#include "core/file.h"
#include "gl/agreement.h"
#include "gl/feature_scenes.h"
#include "support/catch.h"

namespace shoal {

namespace {

constexpr int hashedFrames = 60;
const std::string file = SHOAL_SOURCE_DIR "/tests/gl/state_hashes.txt";

std::string driverHere() {
    const gpu::ContextInfo& info = testContext().info();
    return concat(info.renderer, "; ", info.version);
}

// The file's first line names the driver, each other one a scene, a path and a hash: "Leaves, fused =
// 0123...".
std::map<std::string, std::string> readHashes(std::string& driver) {
    std::map<std::string, std::string> out;
    std::istringstream lines(readFile(file));
    std::getline(lines, driver);
    for (std::string line; std::getline(lines, line);) {
        const size_t middle = line.rfind(" = ");
        REQUIRE(middle != std::string::npos);
        out[line.substr(0, middle)] = line.substr(middle + 3);
    }
    return out;
}

std::map<std::string, std::string> hashesHere() {
    std::map<std::string, std::string> out;
    for (const bool fusedOnly : {false, true}) {
        for (const test::FeatureScene& one : test::shippedScenes(24, fusedOnly)) {
            const Plan plan = compile(one.scene);
            for (const Path path : {Path::fused, Path::fragments, Path::pingPong}) {
                if (!test::takes(plan, path)) continue;
                Simulation simulation(testContext(), plan, {.drawn = false, .path = path});
                test::run(simulation, hashedFrames);
                const std::string hash =
                    formatted("%016llx", static_cast<unsigned long long>(simulation.hash()));
                const bool isNew = out.emplace(concat(one.name, ", ", name(path)), hash).second;
                INFO(one.name);
                CHECK(isNew);  // no two scenes have one name
            }
        }
    }
    return out;
}

}  // namespace

TEST_CASE("the states of all scenes that ship have the bits that they had", "[fused][hashes][long]") {
    if (!test::canFuse()) return;
    if (std::getenv("SHOAL_UPDATE_HASHES") != nullptr) {
        std::string text = driverHere() + "\n";
        for (const auto& [what, hash] : hashesHere())
            text += what + " = " + hash + "\n";
        return writeFile(file, text);
    }
    std::string driver;
    const std::map<std::string, std::string> stored = readHashes(driver);
    if (driver != driverHere()) {
        WARN("skipped: the hashes are of " << driver << ", this is " << driverHere());
        return;
    }
    const std::map<std::string, std::string> found = hashesHere();
    for (const auto& [what, hash] : stored) {
        INFO(what);
        const auto here = found.find(what);
        REQUIRE(here != found.end());
        CHECK(here->second == hash);
    }
    CHECK(found.size() == stored.size());
}

}  // namespace shoal
