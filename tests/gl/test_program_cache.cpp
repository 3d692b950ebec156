#include "gpu/program_cache.h"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/cache_folder.h"
#include "core/file.h"
#include "gl/gl_test.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "support/catch.h"
#include "support/message_of.h"
#include "support/scratch.h"

using namespace shoal::gpu;
using shoal::test::Scratch;
namespace fs = std::filesystem;

namespace {

bool hasBinaries() {
    const Scratch scratch;
    const bool active = ProgramCache(testContext().info(), scratch.path("cache")).active();
    if (!active) WARN("skipped: this context hands out no program binaries");
    return active;
}

ProgramOptions drawing(const std::string& body) {
    ProgramOptions options;
    options.vertex = "triangle.vert";
    options.fragment = "test.frag";
    options.label = "test";
    options.generated = {
        {"triangle.vert",
         "void main() {\n"
         "    gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0);\n"
         "}\n"},
        {"test.frag", "layout(location = 0) out vec4 color;\n" + body}};
    return options;
}

const char* const body =
    "uniform float scale, unused;\n"
    "uniform vec4 list[2];\n"
    "uniform sampler2D image;\n"
    "layout(std140) uniform Types { vec4 types[2]; };\n"
    "void main() { color = scale * list[1] + texelFetch(image, ivec2(0), 0) + types[1]; }\n";

// The colour it draws; each way to give it something is used.
std::vector<float> draw(const Program& program) {
    const float imageTexel[] = {0, 0, 300, 0}, types[] = {0, 0, 0, 0, 0, 0, 0, 4000};
    Texture image(testContext(), Format::rgba32f, 1, 1, "image"),
        target(testContext(), Format::rgba32f, 1, 1, "target");
    image.upload(Traffic::Kind::control, 0, 0, 1, 1, imageTexel, sizeof imageTexel);
    const Buffer buffer(testContext(), Buffer::Use::uniform, types, sizeof types, "types");
    const Framebuffer framebuffer(testContext(), {&target}, nullptr, "target");
    framebuffer.bind();
    program.use();
    program.set("scale", 2.0f);
    program.set("unused", 1.0f);
    const glm::vec4 list[] = {glm::vec4(0), glm::vec4(0.5f, 10, 0, 0)};
    program.set("list", list);
    program.texture("image", image);
    program.uniformBlock("Types", buffer);
    drawVertices(3);
    std::vector<float> color(4);
    target.download(Traffic::Kind::control, 0, 0, 1, 1, color.data(), 16);
    return color;
}

// The hits, misses and warnings of the cache in one start of a program with this folder.
struct Start {
    int hits = 0, misses = 0;
    std::vector<std::string> warnings;
};

Start start(const std::string& folder) {
    const OtherCache kept(testContext(), folder);
    ProgramCache& cache = testContext().cache();
    const Program program(testContext(), drawing(body));
    CHECK(draw(program) == std::vector<float>{1, 20, 300, 4000});
    CHECK(program.uses("scale"));
    CHECK_FALSE(program.uses("unused"));
    testContext().checkErrors("a program from the cache");
    Start out{cache.hits(), cache.misses(), {}};
    for (const shoal::Warning& warning : cache.takeWarnings())
        out.warnings.push_back(text(warning));
    CHECK(cache.takeWarnings().empty());
    return out;
}

void make(const std::string& folder, const std::string& text) {
    const OtherCache kept(testContext(), folder);
    Program(testContext(), drawing(text));
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::vector<fs::path> out;
    for (const auto& entry : fs::directory_iterator(folder))
        out.push_back(entry.path());
    return out;
}

// The checksum of gpu/program_cache.h, written down a second time.
uint64_t fnv(const std::string& bytes) {
    uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : bytes)
        hash = (hash ^ uint8_t(c)) * 0x100000001b3u;
    return hash;
}

// The file with the checksum that its format and binary must have under a key.
std::string sealed(std::string bytes, const std::string& key) {
    uint32_t format = 0;
    std::memcpy(&format, &bytes[12], 4);
    const uint64_t sum = fnv(key + ":" + std::to_string(format) + bytes.substr(32));
    std::memcpy(&bytes[24], &sum, 8);
    return bytes;
}

// Environment variables for the length of a block; empty: not set.
class Variables {
  public:
    explicit Variables(const std::map<std::string, std::optional<std::string>>& values) {
        for (const auto& [name, value] : values) {
            const char* old = std::getenv(name.c_str());
            before_[name] = old != nullptr ? std::optional<std::string>(old) : std::nullopt;
            put(name, value);
        }
    }
    ~Variables() {
        for (const auto& [name, value] : before_)
            put(name, value);
    }
    Variables(const Variables&) = delete;
    Variables& operator=(const Variables&) = delete;

  private:
    static void put(const std::string& name, const std::optional<std::string>& value) {
        if (value) {
            ::setenv(name.c_str(), value->c_str(), 1);
        } else {
            ::unsetenv(name.c_str());
        }
    }
    std::map<std::string, std::optional<std::string>> before_;
};

}  // namespace

TEST_CASE("the second start takes the program from the cache", "[program-cache]") {
    if (!hasBinaries()) return;
    const Scratch scratch;
    const std::string folder = scratch.path("a/b");  // made on demand
    const Start first = start(folder);
    CHECK(first.hits == 0);
    CHECK(first.misses == 1);
    const std::vector<fs::path> files = filesIn(folder);
    REQUIRE(files.size() == 1);
    CHECK(files.front().extension() == ".shoal-program");
    const std::string bytes = shoal::readFile(files.front());
    CHECK(bytes.substr(0, 8) == "shoalprg");
    const Start second = start(folder);
    CHECK(second.hits == 1);
    CHECK(second.misses == 0);
    CHECK(shoal::readFile(files.front()) == bytes);
    CHECK(filesIn(folder).size() == 1);
    CHECK(first.warnings.size() + second.warnings.size() == 0);
}

TEST_CASE("what runs is the program from the file", "[program-cache]") {
    if (!hasBinaries()) return;
    const Scratch scratch;
    std::string otherBody = body;
    otherBody.replace(otherBody.find("scale * list"), 5, "100.0");
    make(scratch.path("one"), body);
    make(scratch.path("two"), otherBody);
    // One file gets the other's program, and says nothing of it.
    const fs::path path = filesIn(scratch / "one").front();
    const std::string other = shoal::readFile(filesIn(scratch / "two").front());
    shoal::writeFile(path, sealed(other, path.stem().string()));
    const OtherCache kept(testContext(), scratch.path("one"));
    const Program program(testContext(), drawing(body));
    CHECK(testContext().cache().hits() == 1);
    CHECK(draw(program) == std::vector<float>{50, 1000, 300, 4000});
}

TEST_CASE("a compute program comes from the cache as well", "[program-cache]") {
    if (!hasBinaries()) return;
    if (!testContext().info().computeShaders) return;
    const Scratch scratch;
    for (int round = 0; round < 2; ++round) {
        const OtherCache kept(testContext(), scratch.path("cache"));
        ProgramOptions options;
        options.compute = "test.comp";
        options.generated = {{"test.comp",
                              "layout(local_size_x = 4) in;\n"
                              "layout(std430) buffer Numbers { float number[]; };\n"
                              "uniform float factor;\n"
                              "void main() { number[gl_GlobalInvocationID.x] *= factor; }\n"}};
        const Program program(testContext(), options);
        CHECK(testContext().cache().hits() == round);
        const std::vector<float> numbers = {1, 2, 3, 4};
        const Buffer buffer(testContext(), Buffer::Use::storage, std::span<const float>(numbers), "numbers");
        program.use();
        program.set("factor", 3.0f);
        program.storage("Numbers", buffer, 0, 16);
        program.dispatch(1);
        std::vector<float> found(4);
        buffer.download(Traffic::Kind::control, 0, found.data(), 16);
        CHECK(found == std::vector<float>{3, 6, 9, 12});
    }
    testContext().checkErrors("a compute program from the cache");
}

TEST_CASE("a file that is not what was written is replaced, with a warning", "[program-cache]") {
    if (!hasBinaries()) return;
    const Scratch scratch;
    const std::string folder = scratch.path("cache");
    start(folder);
    const std::string path = filesIn(folder).front().string();
    const std::string key = fs::path(path).stem().string(), good = shoal::readFile(path);
    REQUIRE(good.size() > 100);
    const auto flipped = [&](size_t at) {
        std::string bytes = good;
        bytes[at] = char(bytes[at] ^ 1);
        return bytes;
    };
    // The whole file of another program, under this one's name.
    make(scratch.path("other"), "void main() { color = vec4(7.0); }\n");
    const std::string another = shoal::readFile(filesIn(scratch.path("other")).front());

    struct Damage {
        const char* name;
        std::string bytes;
        const char* warning = ": the cached program is damaged; compiled anew";
    };
    const std::vector<Damage> damages = {
        {"magic", flipped(0)},
        {"version of the layout", flipped(8)},
        {"format", flipped(12)},
        {"length", flipped(16)},
        {"checksum", flipped(24)},
        {"first byte of the binary", flipped(32)},
        {"a byte inside", flipped(good.size() / 2)},
        {"last byte", flipped(good.size() - 1)},
        {"cut in the binary", good.substr(0, good.size() - 1)},
        {"cut behind the header", good.substr(0, 32)},
        {"cut in the header", good.substr(0, 20)},
        {"longer", good + "x"},
        {"empty", ""},
        {"a text", "This is no program at all, but it is longer than a header.\n"},
        {"another program", another},
        // a driver may refuse what is whole at any time, without a word
        {"foreign binary", sealed(good.substr(0, 32) + std::string(good.size() - 32, 'x'), key), nullptr},
        {"foreign format", sealed(flipped(12), key), nullptr},
    };
    for (const Damage& damage : damages) {
        INFO(damage.name);
        shoal::writeFile(path, damage.bytes);
        const Start damaged = start(folder);
        CHECK(damaged.hits == 0);
        CHECK(damaged.misses == 1);
        if (damage.warning)
            CHECK(damaged.warnings == std::vector<std::string>{path + damage.warning});
        else
            CHECK(damaged.warnings.empty());
        const Start repaired = start(folder);
        CHECK(repaired.hits == 1);
        CHECK(repaired.warnings.empty());
    }
}

TEST_CASE("a folder that cannot be written is told once", "[program-cache]") {
    if (!hasBinaries()) return;
    const Scratch scratch;
    const std::string file = scratch.write("file", "in the way\n");
    const OtherCache kept(testContext(), file + "/cache");
    ProgramCache& cache = testContext().cache();
    for (const char* color : {"1.0", "2.0", "3.0"}) {
        const std::string text = std::string("void main() { color = vec4(") + color + "); }\n";
        CHECK_NOTHROW(Program(testContext(), drawing(text)));
    }
    CHECK(cache.misses() == 3);
    const std::vector<shoal::Warning> warnings = cache.takeWarnings();
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(text(warnings.front()),
               Catch::Contains(file + "/cache") && Catch::Contains("programs are compiled at every start"));
    CHECK(shoal::readFile(file) == "in the way\n");
    CHECK(start(file + "/cache").warnings.size() == 1);
}

TEST_CASE("a folder in the place of a program is told, and left alone", "[program-cache]") {
    if (!hasBinaries()) return;
    const Scratch scratch;
    start(scratch.path("cache"));
    const fs::path path = filesIn(scratch / "cache").front();
    fs::remove(path);
    fs::create_directory(path);
    const Start blocked = start(scratch.path("cache"));
    CHECK(blocked.misses == 1);
    CHECK(blocked.warnings.size() == 2);  // it cannot be read, nor written
    CHECK(fs::is_directory(path));
}

TEST_CASE("the oldest programs make room", "[program-cache]") {
    if (!hasBinaries()) return;
    const Scratch scratch;
    const fs::path folder = scratch / "cache";
    const auto now = fs::file_time_type::clock::now();
    for (size_t i = 0; i < ProgramCache::keptPrograms; ++i) {
        const std::string name = "cache/" + std::to_string(i) + ".shoal-program";
        scratch.write(name, "old");
        fs::last_write_time(scratch / name, now - std::chrono::hours(1 + (i * 7) % 256));
    }
    scratch.write("cache/notes.txt", "not ours");
    fs::last_write_time(folder / "notes.txt", now - std::chrono::hours(1000));
    start(folder.string());
    CHECK(filesIn(folder).size() == ProgramCache::keptPrograms + 1);
    CHECK(fs::exists(folder / "notes.txt"));
    size_t oldest = 0;
    while ((oldest * 7) % 256 != 255)
        ++oldest;
    CHECK_FALSE(fs::exists(folder / (std::to_string(oldest) + ".shoal-program")));
    CHECK(start(folder.string()).hits == 1);
}

TEST_CASE("a program that does not compile leaves nothing in the cache", "[program-cache]") {
    const Scratch scratch;
    const OtherCache kept(testContext(), scratch.path("cache"));
    CHECK_THAT(messageOf([&] { Program(testContext(), drawing("void main() { x; }\n")); }),
               Catch::Contains("does not compile"));
    CHECK_FALSE(fs::exists(scratch / "cache"));
    CHECK(testContext().cache().takeWarnings().empty());
}

TEST_CASE("a cache without a folder or without binaries does nothing", "[program-cache]") {
    const Scratch scratch;
    const bool active = ProgramCache(testContext().info(), scratch.path("cache")).active();
    if (!testContext().info().atLeast(4, 1)) CHECK_FALSE(active);
    const Start without = start(active ? "" : scratch.path("cache"));
    CHECK(without.hits + without.misses == 0);
    CHECK(without.warnings.empty());
    CHECK_FALSE(fs::exists(scratch / "cache"));
}

TEST_CASE("a program's key is of its texts and its driver", "[program-cache]") {
    const ContextInfo info = testContext().info();
    const std::vector<std::string_view> texts = {"vertex", "fragment"};
    const std::string key = programKey(info, texts);
    CHECK(key.size() == 32);
    CHECK(key.find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(programKey(info, texts) == key);
    const std::vector<std::vector<std::string_view>> others = {
        {"vertex", "fragmenu"},    {"vertey", "fragment"}, {"vertexf", "ragment"},
        {"fragment", "vertex"},    {"vertexfragment"},     {"vertex"},
        {"vertex", "fragment", ""}};
    for (const auto& other : others)
        CHECK(programKey(info, other) != key);
    for (std::string ContextInfo::*driver :
         {&ContextInfo::renderer, &ContextInfo::vendor, &ContextInfo::version}) {
        ContextInfo changed = info;
        changed.*driver += " 2";
        CHECK(programKey(changed, texts) != key);
    }
    ContextInfo changed = info;
    changed.kind = info.kind == ContextKind::egl ? ContextKind::osmesa : ContextKind::egl;
    CHECK(programKey(changed, texts) != key);
}

TEST_CASE("the folder of the cache comes from the environment", "[program-cache]") {
    const auto folder = [](const std::map<std::string, std::optional<std::string>>& values) {
        std::map<std::string, std::optional<std::string>> all = {
            {"SHOAL_CACHE", {}}, {"XDG_CACHE_HOME", {}}, {"HOME", {}}};
        for (const auto& [name, value] : values)
            all[name] = value;
        const Variables variables(all);
        return shoal::cacheFolder();
    };
    CHECK(folder({{"SHOAL_CACHE", "here"}, {"XDG_CACHE_HOME", "/x"}, {"HOME", "/h"}}) == "here");
    CHECK(folder({{"SHOAL_CACHE", ""}, {"XDG_CACHE_HOME", "/x"}, {"HOME", "/h"}}).empty());
    CHECK(folder({{"XDG_CACHE_HOME", "/x"}, {"HOME", "/h"}}) == "/x/shoal");
    CHECK(folder({{"XDG_CACHE_HOME", "x"}, {"HOME", "/h"}}) == "/h/.cache/shoal");
    CHECK(folder({{"XDG_CACHE_HOME", ""}, {"HOME", "/h"}}) == "/h/.cache/shoal");
    CHECK(folder({}).empty());
}
