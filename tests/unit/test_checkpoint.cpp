// Checkpoint files without a GPU: what is written comes back, and nothing else is taken for one.
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

#include <sys/resource.h>

#include "core/file.h"
#include "scene/json/scene_file.h"
#include "simulate/checkpoint.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"
#include "support/small_scene.h"

using namespace shoal;

namespace {

Plan planOf(const test::Scratch& scratch, const std::function<void(Scene&)>& change = {}) {
    Scene scene = readScene(test::writeSmallScene(scratch));
    if (change) change(scene);
    return compile(scene);
}

Checkpoint startOf(const Plan& plan) {
    Checkpoint out;
    out.parameters = parametersOf(plan);
    out.state.time = 1.0 / 3;
    out.state.frames = 71;
    for (const GroupPlan& group : plan.groups)
        out.state.groups.push_back(group.start);
    return out;
}

void change(const std::string& file, size_t at, char by) {
    std::string bytes = readFile(file);
    bytes[at] = char(bytes[at] ^ by);
    writeFile(file, bytes);
}

}  // namespace

TEST_CASE("a checkpoint comes back exactly", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("deep/x.shoal");
    Checkpoint saved = startOf(plan);
    saved.state.groups[0].released[1] = 1;
    saved.state.groups[1].positions[3] = {-0.0f, std::numeric_limits<float>::denorm_min(), 3e38f};
    writeCheckpoint(file, plan, saved);
    const Checkpoint back = readCheckpoint(file, plan);
    CHECK(back.state.time == saved.state.time);
    CHECK(back.state.frames == 71);
    CHECK(back.state.groups == saved.state.groups);
    CHECK(std::signbit(back.state.groups[1].positions[3].x));
}

TEST_CASE("a solver's history comes back where there was one", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    Checkpoint saved = startOf(plan);
    GroupState& group = saved.state.groups[1];
    group.displacements.assign(group.positions.size(), glm::vec3(1, noHistory, 3));
    group.velocityChanges.assign(group.positions.size(), glm::vec3(4, 5, 6));
    saved.state.step = 1.0 / 7;
    writeCheckpoint(file, plan, saved);
    const Checkpoint back = readCheckpoint(file, plan);
    CHECK(back.state.groups == saved.state.groups);
    CHECK(back.state.step == saved.state.step);
}

TEST_CASE("a slider that was moved stays, what the scene says now goes before it", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    Checkpoint saved = startOf(plan);
    saved.parameters.wind = 2.5;
    saved.parameters.gravity = {0, -1, 0};
    writeCheckpoint(file, plan, saved);
    const Parameters same = readCheckpoint(file, plan).parameters;
    CHECK(same.wind == 2.5);
    CHECK(same.gravity == glm::dvec3(0, -1, 0));
    CHECK(same.substeps == plan.substeps);
    CHECK(same.frameTime == 1 / plan.frameRate);

    const Plan closer = planOf(scratch, [](Scene& scene) {
        scene.solver.substeps = 24;
        scene.frameRate = 120;
        scene.gravity = {0, -3, 0};
    });
    const Parameters changed = readCheckpoint(file, closer).parameters;
    CHECK(changed.wind == 2.5);
    CHECK(changed.gravity == glm::dvec3(0, -3, 0));
    CHECK(changed.substeps == 24);
    CHECK(changed.frameTime == 1.0 / 120);

    saved.parameters.stiffness = 900;  // as the slider does, with substeps enough
    saved.parameters.substeps = substepsNeeded(plan, 1 / plan.frameRate, 900, 1, 1, plan.substeps);
    REQUIRE(saved.parameters.substeps > plan.substeps);
    writeCheckpoint(file, plan, saved);
    CHECK(readCheckpoint(file, plan).parameters.substeps == saved.parameters.substeps);
}

TEST_CASE("a checkpoint of another scene names what differs", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    writeCheckpoint(file, plan, startOf(plan));
    struct Case {
        const char* expected;
        std::function<void(Scene&)> change;
    };
    const Case cases[] = {
        {"it had 7 groups, this one has 6", [](Scene& s) { s.groups.pop_back(); }},
        {"its group 1 was \"on it\", here it is \"twigs\"",
         [](Scene& s) { s.groups[0].name = s.forces[0].groups[0] = "twigs"; }},
        {"its group \"on it\" had 3 molecules, here it has 2", [](Scene& s) { s.groups[0].count = 2; }},
        {"its group \"on it\" had molecules of 3 vertices, here they have 4",
         [](Scene& s) { s.groups[0].molecule.vertices.push_back(s.groups[0].molecule.vertices[2]); }},
        {"its group \"on it\" had molecules of 3 springs, here they have 2",
         [](Scene& s) { s.groups[0].molecule.springs.pop_back(); }},
        {"springs between other vertices or of other rest lengths",
         [](Scene& s) { s.groups[0].molecule.springs[2].restLength = 0.24; }},
        {"springs between other vertices or of other rest lengths",
         [](Scene& s) { std::swap(s.groups[0].molecule.springs[0], s.groups[0].molecule.springs[1]); }},
        {"other seeds, sizes or muscle phases", [](Scene& s) { s.seed = 2; }},
        {"other seeds, sizes or muscle phases",
         [](Scene& s) {
             s.groups[0].place.scale = {0.5, 1.9};
         }},
    };
    for (const auto& [expected, change] : cases) {
        const Plan other = planOf(scratch, change);
        const std::string message = messageOf([&] { readCheckpoint(file, other); });
        CHECK_THAT(message, Catch::StartsWith(file + ": is of another scene: ") && Catch::Contains(expected));
    }
    // to look closer at a run
    const Plan closer = planOf(scratch, [](Scene& s) {
        s.solver.kind = SolverKind::leapfrog;
        s.solver.substeps = 30;
        s.fields.clear();
        s.colliders.clear();
        s.groups[0].drag = {};
        s.groups[0].release.reset();
        for (Spring& spring : s.groups[0].molecule.springs)
            spring.stiffness *= 1.5, spring.damping = 0;
        s.groups[0].molecule.vertices[1].mass *= 2;
    });
    CHECK_NOTHROW(readCheckpoint(file, closer));
}

TEST_CASE("every byte that changes is noticed", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    writeCheckpoint(file, plan, startOf(plan));
    const std::string whole = readFile(file);
    size_t taken = 0;
    std::fstream kept(file, std::ios::binary | std::ios::in | std::ios::out);
    const auto put = [&](size_t at, char byte) {
        kept.seekp(std::streamoff(at));
        kept.put(byte);
        kept.flush();
    };
    for (size_t at = 0; at < whole.size(); ++at) {
        for (const char by : {'\x01', '\x80', '\xff'}) {
            put(at, char(whole[at] ^ by));
            const std::string message = messageOf([&] { readCheckpoint(file, plan); });
            taken += message.empty() ? 1 : 0;
            if (!message.empty() && message.find("another scene") == std::string::npos) continue;
            UNSCOPED_INFO("byte " << at << ": " << message);
            FAIL_CHECK();
        }
        put(at, whole[at]);
    }
    kept.close();
    CHECK(taken == 0);
    for (size_t length = 0; length < whole.size(); length += length < 600 ? 1 : 97) {
        std::ofstream(file, std::ios::binary) << whole.substr(0, length);
        const std::string message = messageOf([&] { readCheckpoint(file, plan); });
        INFO(length);
        CHECK_THAT(message, Catch::Contains(length < 8 ? "is not a checkpoint" : "is cut short"));
    }
    writeFile(file, whole + "x");
    CHECK_THAT(messageOf([&] { readCheckpoint(file, plan); }), Catch::Contains("something follows its end"));
    writeFile(file, whole);
    CHECK_NOTHROW(readCheckpoint(file, plan));
}

TEST_CASE("what is no checkpoint says so", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    const auto message = [&] { return messageOf([&] { readCheckpoint(file, plan); }); };
    CHECK(message() == file + ": no such file");
    writeFile(file, std::string("frame,time,group\n"));
    CHECK(message() == file + ": is not a checkpoint of Shoal");
    CHECK_THAT(messageOf([&] { readCheckpoint(scratch.folder(), plan); }),
               Catch::Contains("is a folder, expected a file"));

    writeCheckpoint(file, plan, startOf(plan));
    change(file, 12, 1);
    CHECK(message() == file + ": is a checkpoint of version 4, this program reads version 5");
    change(file, 12, 1);
    for (const size_t at : {size_t(8), size_t(11)})
        change(file, at, 5);
    for (const size_t at : {size_t(9), size_t(10)})
        change(file, at, 1);
    CHECK(message() == file + ": was written by a machine with another byte order");
}

TEST_CASE("a file that claims a huge head takes no memory", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    writeCheckpoint(file, plan, startOf(plan));
    std::string bytes = readFile(file);
    const uint64_t huge = uint64_t(1) << 60;
    std::memcpy(bytes.data() + 16, &huge, sizeof huge);
    writeFile(file, bytes);
    CHECK_THAT(messageOf([&] { readCheckpoint(file, plan); }), Catch::Contains("no sensible length"));
}

TEST_CASE("nothing goes on from a state that is not finite", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    const auto refused = [&](const std::function<void(Checkpoint&)>& spoil, const std::string& expected) {
        Checkpoint saved = startOf(plan);
        spoil(saved);
        writeCheckpoint(file, plan, saved);
        CHECK_THAT(messageOf([&] { readCheckpoint(file, plan); }),
                   Catch::Contains(": nothing can go on from it: ") && Catch::Contains(expected));
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinite = std::numeric_limits<float>::infinity();
    refused([](Checkpoint& c) { c.state.groups[0].velocities[7].y = nan; },
            "group \"on it\", molecule 2, vertex 1 is not finite");
    refused([](Checkpoint& c) { c.state.groups[1].positions[3].z = -infinite; },
            "group \"blade\", molecule 1, vertex 0 is not finite");
    refused([](Checkpoint& c) { c.state.groups[0].anchors[2].x = nan; },
            "group \"on it\", molecule 2 is not finite");
    refused([](Checkpoint& c) { c.state.groups[0].released[0] = 2; }, "pins that neither hold nor let go");
    refused([](Checkpoint& c) { c.state.time = double(nan); }, "make no sense");
    refused([](Checkpoint& c) { c.state.frames = -1; }, "make no sense");
    refused([](Checkpoint& c) { c.parameters.substeps = 0; }, "make no sense");
    refused([](Checkpoint& c) { c.parameters.gravity.x = double(infinite); }, "make no sense");
}

TEST_CASE("a checkpoint that cannot be written leaves the old one", "[checkpoint]") {
    const test::Scratch scratch;
    const Plan plan = planOf(scratch);
    const std::string file = scratch.path("x.shoal");
    writeFile(file, std::string("old"));
    {
        rlimit before{};
        getrlimit(RLIMIT_FSIZE, &before);
        const auto handler = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit tight{1000, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &tight);
        CHECK_THAT(messageOf([&] { writeCheckpoint(file, plan, startOf(plan)); }),
                   Catch::StartsWith(file + ": cannot be written: "));
        setrlimit(RLIMIT_FSIZE, &before);
        std::signal(SIGXFSZ, handler);
    }
    CHECK(readFile(file) == "old");
    CHECK(std::distance(std::filesystem::directory_iterator(scratch.folder()), {}) == 5);
    CHECK_THAT(messageOf([&] { writeCheckpoint(scratch.folder(), plan, startOf(plan)); }),
               Catch::Contains("is a folder"));
}
