// Files that strangers made: each is read, or refused in one line within limits of time and memory.
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/confined.h"
#include "core/file.h"
#include "core/image.h"
#include "geometry/mesh.h"
#include "scene/json/scene_file.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal;
using namespace shoal::test;
using Catch::Contains;

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr bool memoryIsLimited = false;
#else
constexpr bool memoryIsLimited = true;
#endif

size_t openFiles() {
    size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
        ++count;
    return count;
}

bool hasChildren() {
    return waitpid(-1, nullptr, WNOHANG) >= 0 || errno != ECHILD;
}

ConfinedLimits small() {
    ConfinedLimits limits;
    limits.memory = 64e6;
    limits.seconds = 1;
    return limits;
}

// Returns the message of the Error that the parent throws about a child that does this.
std::string told(const std::function<void(ToParent&)>& work, const ConfinedLimits& limits = small()) {
    return messageOf([&] { Confined(Location{"m", 0, 0, {}}, limits, work).get<int>(); });
}

const std::string plyHead =
    "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";

// 2^28 vertices by its word alone.
const char* const bomb = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "count": 268435456, "type": "VEC3"}]})";

}  // namespace

TEST_CASE("arrays come back from a child as it puts them", "[confined]") {
    std::vector<int> numbers(100'000);
    for (size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = int(i * i);
    {
        Confined child(Location{"m", 0, 0, {}}, {}, [&](ToParent& parent) {
            parent.opened(12);
            parent.put(numbers);
            parent.put(std::vector<double>{});
            parent.put(std::vector<double>{0.5});
        });
        CHECK(child.get<int>() == numbers);
        CHECK(child.get<double>().empty());
        CHECK(child.get<double>() == std::vector<double>{0.5});
    }
    CHECK_FALSE(hasChildren());
}

TEST_CASE("whatever a child does is one error, and nothing of it stays", "[confined]") {
    const size_t before = openFiles();
    CHECK(told([](ToParent&) { throw Error("is not what it says"); }) == "m: is not what it says");
    CHECK(told([](ToParent&) { throw Error(Location{"m", 3, 0, {}}, "is wrong"); }) == "m:3: is wrong");
    CHECK(told([](ToParent&) { throw Error(Location{"n", 3, 0, {}}, "is wrong"); }) == "m: is wrong");
    CHECK_THAT(told([](ToParent&) { std::abort(); }),
               Contains("m: cannot be read: its reader crashed (Abort"));
    CHECK_THAT(told([](ToParent&) { std::raise(SIGSEGV); }), Contains("crashed (Segmentation"));
    CHECK_THAT(told([](ToParent&) { throw 3; }), Contains("m: cannot be read: its reader ended early"));
    CHECK_THAT(told([](ToParent&) { _exit(0); }), Contains("ended early"));
    CHECK_THAT(told([](ToParent&) { throw std::runtime_error("no"); }), Contains("m: cannot be read: no"));
    CHECK_THAT(told([](ToParent& parent) { parent.put(std::vector<char>(3)); }), Contains("went astray"));
    CHECK_THAT(told([](ToParent&) { throw std::bad_alloc(); }),
               Contains("m: cannot be read: takes more than 64 MB of memory, the most for files of 0 bytes"));
    if (memoryIsLimited)
        CHECK_THAT(told([](ToParent& parent) {
                       std::vector<char> all;
                       for (size_t size = 1 << 20;; size *= 2) {
                           all.resize(size);
                           if (all[size / 3] != 0) parent.put(all);
                       }
                   }),
                   Contains("takes more than 64 MB of memory"));
    CHECK_FALSE(hasChildren());
    CHECK(openFiles() == before);
}

TEST_CASE("a child that does not end is ended, at work or asleep", "[confined]") {
    CHECK_THAT(told([](ToParent&) {
                   for (std::atomic<unsigned> turns = 0;;)
                       ++turns;
               }),
               Contains("m: cannot be read: takes more than 1 s of processor time, the most for files of 0"));
    ConfinedLimits limits = small();
    limits.waiting = 0.2;
    limits.waitingBySeconds = 0;
    CHECK_THAT(told([](ToParent&) { std::this_thread::sleep_for(std::chrono::hours(1)); }, limits),
               Contains("m: cannot be read: takes more than 0.2 s, the most for files of 0 bytes"));
    CHECK_FALSE(hasChildren());
}

TEST_CASE("limits are in proportion to the files, with a least and a most", "[confined]") {
    const ConfinedLimits limits;
    CHECK(limits.memoryFor(1e6) == Approx(limits.memory + 1e8));
    CHECK(limits.memoryFor(1e15) == limits.mostMemory);
    CHECK(limits.secondsFor(0) == 2);
    CHECK(limits.secondsFor(1e7) == 32);
    CHECK(limits.secondsFor(1e15) == limits.mostSeconds);
    CHECK(limits.clockFor(0) > 10 * limits.secondsFor(0));
    // The child is told what a file allows as it opens it.
    ConfinedLimits least = small();
    least.memory = 0;
    const auto hundredThousand = [](ToParent& parent) {
        parent.opened(1'000'000);
        parent.put(std::vector<int>(25'000));
        throw Error("comes after");
    };
    CHECK(told(hundredThousand, least).empty());
    least.memoryPerByte = 0.05;
    CHECK_THAT(told(hundredThousand, least), Contains("m: cannot be read: "));
}

TEST_CASE("a handler of crashes and a blocked signal of the program's are not the child's", "[confined]") {
    static volatile std::sig_atomic_t called = 0;
    const auto before = std::signal(SIGSEGV, [](int) { called = 1; });
    CHECK_THAT(told([](ToParent&) {
                   std::raise(SIGSEGV);
                   throw Error("survived");
               }),
               Contains("crashed (Segmentation"));
    std::signal(SIGSEGV, before);
    CHECK(called == 0);
}

TEST_CASE("models that crash, hang or fill memory are refused in one line with their name",
          "[confined][model]") {
    const Scratch scratch;
    const size_t before = openFiles();
    const auto refusal = [&](const char* name, const std::string& bytes) {
        const std::string message = messageOf([&] { loadMesh(scratch.write(name, bytes)); });
        INFO(message);
        CHECK(message.starts_with(scratch.path(name) + ": cannot be read"));
        CHECK(message.find('\n') == std::string::npos);
        CHECK_FALSE(hasChildren());
        return message;
    };
    refusal("cut.ply", plyHead + std::string(20, '\0'));
    refusal("faces.ply", plyHead + std::string(36, '\0') + "\3" + std::string(12, '\0'));
    if (memoryIsLimited) {
        CHECK_THAT(refusal("bomb.gltf", bomb), Contains("more than 512 MB of memory"));
        rusage mine{}, children{};
        getrusage(RUSAGE_SELF, &mine);
        getrusage(RUSAGE_CHILDREN, &children);
        CHECK(children.ru_maxrss < mine.ru_maxrss + 600'000);  // kB
    }
    CHECK(openFiles() == before);
}

TEST_CASE("a model is the same from a child as from this process", "[confined][model]") {
    const std::string file = SHOAL_SOURCE_DIR "/molecules/minnow.obj";
    const Mesh confined = loadMesh(file);
    setenv("SHOAL_TRUST_MODELS", "1", 1);
    const Mesh trusted = loadMesh(file);
    unsetenv("SHOAL_TRUST_MODELS");
    CHECK(confined.positions == trusted.positions);
    CHECK(confined.normals == trusted.normals);
    CHECK(confined.colors == trusted.colors);
    CHECK(confined.uvs == trusted.uvs);
    CHECK(confined.triangles == trusted.triangles);
    REQUIRE(confined.objects.size() == trusted.objects.size());
    REQUIRE(confined.parts.size() == trusted.parts.size());
    for (size_t i = 0; i < trusted.objects.size(); ++i) {
        CHECK(confined.objects[i].name == trusted.objects[i].name);
        CHECK(confined.objects[i].firstTriangle == trusted.objects[i].firstTriangle);
        CHECK(confined.objects[i].triangleCount == trusted.objects[i].triangleCount);
    }
    for (size_t i = 0; i < trusted.parts.size(); ++i) {
        CHECK(confined.parts[i].mesh == trusted.parts[i].mesh);
        CHECK(confined.parts[i].material == trusted.parts[i].material);
        CHECK(confined.parts[i].triangleCount == trusted.parts[i].triangleCount);
    }
}

TEST_CASE("devices and pipes are refused where a file is expected, before they are opened",
          "[confined][file]") {
    const Scratch scratch;
    const std::string pipe = scratch.path("pipe.obj"), device = scratch.path("zero.png");
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    std::filesystem::create_symlink("/dev/zero", device);
    const auto refused = [](const std::string& file, auto&& read) {
        const std::string message = messageOf([&] { read(file); });
        INFO(message);
        CHECK(message.starts_with(file + ": is a "));
        CHECK_THAT(message, Contains(", expected a file"));
    };
    for (const std::string& file : {pipe, device}) {
        refused(file, [](const std::string& name) { loadMesh(name); });
        refused(file, [](const std::string& name) { readFile(name); });
        refused(file, [](const std::string& name) { readPng(name); });
    }
    // Beside a model they are left out, as materials that are missing.
    const std::string named = scratch.write("m.obj", "mtllib pipe.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(loadMesh(named).triangles.size() == 1);
}

TEST_CASE("a scene that names a model which cannot be read fails at its place in the scene",
          "[confined][scene]") {
    const Scratch scratch;
    scratch.write("cut.ply", plyHead + std::string(20, '\0'));
    const std::string scene = scratch.write("a.scene.json", R"({
  "format": "shoal-scene-1",
  "name": "a",
  "models": [
    {"file": "cut.ply"}
  ],
  "groups": []
})");
    const std::string message = messageOf([&] { readScene(scene); });
    CHECK(message.starts_with(scene + ":5:14: " + scratch.path("cut.ply") + ": cannot be read: "));
    CHECK_THAT(message, Contains("(at $.models[0].file)"));
}
